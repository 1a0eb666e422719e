#pragma once
#include <charconv>
#include <cstring>
#include <string_view>
#include <vector>

#include "io/scene/scene_file.h"

/// A text file in blocks, so that all cores read its lines at once. Only plain text is read this way: a line that may
/// mean more than it seems to is left to the reader of the whole file.
namespace bp {

inline bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

/// Moves the begin of a line behind its first blanks.
inline void drop_blanks(std::string_view& line) {
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
}

/// Reads a number at the begin of a line, and moves the begin behind it. Returns false unless the number is plain: it
/// ends at a blank or with the line, and the type holds it.
template <class Number>
bool take_number(std::string_view& line, Number& number) {
  drop_blanks(line);
  const char* const end = line.data() + line.size();
  const auto [last, error] = std::from_chars(line.data(), end, number);
  if (error != std::errc() || (last != end && !is_blank(*last))) return false;
  line.remove_prefix(std::size_t(last - line.data()));
  return true;
}

/// Returns the word at the begin of a line, and moves the begin behind it. A control character ends a word.
inline std::string_view take_word(std::string_view& line) {
  drop_blanks(line);
  std::size_t size = 0;
  while (size < line.size() && static_cast<unsigned char>(line[size]) > ' ') ++size;
  const std::string_view word = line.substr(0, size);
  line.remove_prefix(size);
  return word;
}

/// Reads the lines of one block of a file, one after the other. Holds the text of the block, and as much of the next
/// one as a line may take.
class BlockLines {
 public:
  static constexpr std::uint64_t kBlock = std::uint64_t(1) << 18;
  static constexpr std::uint64_t kLongest = 4096;  ///< characters that may be read behind the block

  /// `begin`: of the block. `first`: where the file's lines begin.
  BlockLines(const SceneFile& file, std::uint64_t begin, std::uint64_t first = 0);

  /// Moves to the next line that begins in the block. Returns false if there is none, or if is_plain() is false.
  bool next_here() { return at_ < last_ && next(); }
  /// Moves to the next line, which may begin behind the block.
  bool next();
  /// Returns whether OddCharacters stand in the lines that are left, or a little behind them.
  [[nodiscard]] bool has_odd_characters() const;
  /// Returns false if a line has a lone CR, or goes on behind the text that is held.
  [[nodiscard]] bool is_plain() const { return plain_; }

  [[nodiscard]] std::string_view line() const { return line_; }  ///< without its end
  [[nodiscard]] bool is_ended() const { return ended_; }         ///< false for a last line without a line end
  [[nodiscard]] std::uint64_t line_begin() const { return begin_ + std::uint64_t(line_.data() - text_.data()); }
  [[nodiscard]] std::uint64_t next_begin() const { return begin_ + std::uint64_t(at_ - text_.data()); }

 private:
  std::uint64_t begin_;  // of text_ in the file
  std::vector<char> text_;
  const char *at_, *last_, *end_;  // the next line; the end of the block; the end of the text
  bool whole_;                     // the file ends with the text
  std::string_view line_;
  bool ended_ = false, plain_ = true;
};

}  // namespace bp
