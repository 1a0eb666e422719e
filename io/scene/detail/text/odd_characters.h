#pragma once
#include <cstdint>
#include <string_view>

namespace bp {

/// Returns whether a file begins with the byte order mark of UTF-8.
[[nodiscard]] inline bool starts_with_mark(std::string_view file) {
  return file.starts_with("\xEF\xBB\xBF");
}

/// Counts the lines of a text with characters that end a word, a line or the text for some programs, and not for
/// others: control characters but for tab, LF and CR, and the blanks and line ends of Unicode beyond ASCII. The mark
/// that DOS set behind the last line may be the last character.
class OddCharacters {
 public:
  /// Adds the next part of the text.
  void add(std::string_view part);
  [[nodiscard]] std::uint64_t lines() const { return lines_; }

 private:
  void add(unsigned char c);
  void note();

  std::uint64_t lines_ = 0;
  bool noted_ = false;            // this line
  bool ends_ = false;             // the last character was the mark of DOS
  std::uint32_t last_bytes_ = 0;  // 3 of them; 0 in place of those of a part without odd characters
};

}  // namespace bp
