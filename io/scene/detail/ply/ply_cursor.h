#pragma once
#include <bit>
#include <string>
#include <utility>

#include "io/scene/byte_stream.h"
#include "io/scene/detail/ply/ply_values.h"
#include "lib/core/error.h"

/// Cursors that read a PLY file: one for each kind of file, with the same functions.
namespace bp {

class PlyBinaryCursor {
 public:
  struct Mark {
    std::uint64_t offset = 0;
  };
  PlyBinaryCursor(SceneFilePtr file, const PlyHeader& header)
      : bytes_(std::move(file), header.data.offset),
        swap_((header.format == PlyHeader::Format::big_endian) != (std::endian::native == std::endian::big)),
        odd_lines_(header.ends.odd() + header.odd_lines) {}

  double real(PlyType type) { return decode_real(bytes_.take(bytes_of(type)), type, swap_); }
  std::int64_t integer(PlyType type) { return decode_integer(bytes_.take(bytes_of(type)), type, swap_); }
  void skip(PlyType type, std::uint64_t n) {
    if (n > bytes_.remaining() / bytes_of(type)) bytes_.fail_truncated();
    bytes_.skip(n * bytes_of(type));
  }
  /// Skips records; returns false for a record with lists, whose size is not known.
  bool skip_records(const PlyElement& element) {
    if (element.has_lists()) return false;
    const std::uint64_t size = element.fixed_bytes();
    check_count(element, size);
    bytes_.skip(size * element.count);
    return true;
  }
  /// Throws if the file cannot hold that many records.
  void check_count(const PlyElement& element, std::uint64_t record_bytes) const {
    if (record_bytes == 0 || element.count <= bytes_.remaining() / record_bytes) return;
    fail(ErrorCode::bad_input,
         "{}: promises {} records '{}' of at least {} bytes at byte {}, but has {} bytes left; the file is truncated",
         bytes_.file().name(), element.count, element.name, record_bytes, bytes_.offset(), bytes_.remaining());
  }
  void check_count(const PlyElement& element) const {
    std::uint64_t size = element.fixed_bytes();
    for (const PlyProperty& p : element.properties) size += p.is_list ? bytes_of(p.count_type) : 0;
    check_count(element, size);
  }
  void end_record() {}
  [[nodiscard]] std::uint64_t odd_lines() const { return odd_lines_; }  ///< of the header
  void check_end() const { check_data_end(bytes_.file(), bytes_.offset()); }
  [[noreturn]] void fail_here(const std::string& what) const {
    fail(ErrorCode::bad_input, "{}: byte {}: {}", bytes_.file().name(), bytes_.offset(), what);
  }
  [[nodiscard]] Mark mark() const { return {bytes_.offset()}; }
  void seek(Mark mark) { bytes_.seek(mark.offset); }
  [[nodiscard]] bool swap() const { return swap_; }

 private:
  ByteStream bytes_;
  bool swap_;
  std::uint64_t odd_lines_;
};

class PlyAsciiCursor {
 public:
  using Mark = TextScanner::Mark;
  PlyAsciiCursor(SceneFilePtr file, const PlyHeader& header)
      : text_(std::move(file), header.data), odd_lines_(header.odd_lines) {
    text_.add_ends(header.ends);
  }

  double real(PlyType type) {
    need_word();
    std::int64_t integer = 0;
    if (is_integer(type) && plain_integer(type, integer)) return double(integer);
    double value = 0;
    if (!text_.real(value)) text_.fail_here("a number was expected; is the file damaged?");
    return value;
  }
  std::int64_t integer(PlyType type) {
    need_word();
    std::int64_t value = 0;
    if (is_integer(type) && plain_integer(type, value)) return value;
    if (!text_.count(value)) text_.fail_here("an integer was expected; is the file damaged?");
    return value;
  }
  void skip(PlyType type, std::uint64_t n) {
    for (std::int64_t value = 0; n > 0; --n) {
      need_word();
      if (!is_integer(type) || !plain_integer(type, value)) text_.skip_word();
    }
  }
  bool skip_records(const PlyElement&) { return false; }
  /// Throws if the file cannot hold that many records: a number takes at least two characters; the last one may lack
  /// its line end.
  void check_count(const PlyElement& element) const {
    const std::uint64_t size = 2 * element.properties.size();
    if (size == 0 || element.count <= (text_.remaining() + 1) / size) return;
    text_.fail_here("promises {} records '{}', but has {} bytes left; the file is truncated", element.count,
                    element.name, text_.remaining());
  }
  /// Ends a record, which ends with its line. Words beyond those that the header declares occur, and are skipped.
  void end_record() {
    if (text_.has_more()) text_.doubt();
    text_.next_line();
    in_record_ = false;
  }
  /// Returns how many lines other programs read in another way, so far: lines with another end or odd characters; lines
  /// with more words, which programs that read words take for the next record; records of two lines; and numbers that
  /// their type cannot hold.
  [[nodiscard]] std::uint64_t odd_lines() const { return odd_lines_ + text_.odd_lines(); }
  void check_end() {
    if (text_.word_anywhere()) text_.fail_here("data begin that the header does not promise; is the file damaged?");
  }
  [[noreturn]] void fail_here(const std::string& what) const { text_.fail_here("{}", what); }
  [[nodiscard]] Mark mark() const { return text_.mark(); }
  void seek(Mark mark) {
    text_.seek(mark);
    in_record_ = false;
  }
  /// Moves behind records that PlyBlocks has read. Their lines end with LF.
  void seek_behind_blocks(Mark mark) {
    text_.add_ends({.line_feeds = 1});
    seek(mark);
  }

 private:
  /// Moves to the next word of a record.
  void need_word() {
    if (!in_record_ || !text_.has_more()) begin_line();
  }
  /// Reads an integer if its form is plain. Notes any other, and one that its type cannot hold.
  bool plain_integer(PlyType type, std::int64_t& value) {
    const bool is_plain = text_.plain_integer(value);
    if (!is_plain || !range_of(type).holds(value)) text_.doubt();
    return is_plain;
  }
  void begin_line() {
    if (in_record_) text_.doubt();
    if (!text_.word_anywhere()) text_.fail_here("the file ends in the middle of its data; it is truncated");
    in_record_ = true;
  }

  TextScanner text_;
  bool in_record_ = false;   // behind its first number
  std::uint64_t odd_lines_;  // of the header, but for their ends
};

}  // namespace bp
