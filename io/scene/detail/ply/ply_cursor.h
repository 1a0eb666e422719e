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
        odd_lines_(header.ends.odd()) {}

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
  void check_end() const { check_ply_end(bytes_.file(), bytes_.offset()); }
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
  PlyAsciiCursor(SceneFilePtr file, const PlyHeader& header) : text_(std::move(file), header.data) {
    text_.add_ends(header.ends);
  }

  double real(PlyType) {
    need_word();
    double value = 0;
    if (!text_.real(value)) text_.fail_here("a number was expected; is the file damaged?");
    return value;
  }
  std::int64_t integer(PlyType) {
    need_word();
    std::int64_t value = 0;
    if (!text_.count(value)) text_.fail_here("an integer was expected; is the file damaged?");
    return value;
  }
  void skip(PlyType, std::uint64_t n) {
    for (; n > 0; --n) {
      need_word();
      text_.skip_word();
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
    longer_ += text_.has_more() ? 1 : 0;
    text_.next_line();
  }
  /// Returns how many lines other programs read in another way, so far: lines with another end, and lines with more
  /// words. Programs that read words take these for the next record.
  [[nodiscard]] std::uint64_t odd_lines() const { return longer_ + text_.ends().odd(); }
  void check_end() {
    if (text_.word_anywhere()) text_.fail_here("data begin that the header does not promise; is the file damaged?");
  }
  [[noreturn]] void fail_here(const std::string& what) const { text_.fail_here("{}", what); }
  [[nodiscard]] Mark mark() const { return text_.mark(); }
  void seek(Mark mark) { text_.seek(mark); }
  /// Moves behind records that PlyBlocks has read. Their lines end with LF.
  void seek_behind_blocks(Mark mark) {
    text_.add_ends({.line_feeds = 1});
    text_.seek(mark);
  }

 private:
  void need_word() {
    if (!text_.word_anywhere()) text_.fail_here("the file ends in the middle of its data; it is truncated");
  }
  TextScanner text_;
  std::uint64_t longer_ = 0;
};

}  // namespace bp
