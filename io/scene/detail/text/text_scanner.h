#pragma once
#include <charconv>
#include <string_view>

#include "io/scene/detail/text/odd_characters.h"
#include "io/scene/scene_file.h"
#include "lib/core/error.h"

/// Reads words and numbers of a text file of any size, one buffer at a time. A line ends with LF, CRLF or CR; a byte
/// order mark of UTF-8 is skipped.
namespace bp {

struct TextMark {
  std::uint64_t offset = 0, line = 1;
};

/// Line ends of a text, and the backslashes before them that join two words.
struct LineEnds {
  std::uint64_t line_feeds = 0;    ///< with or without a CR before them
  std::uint64_t lone_returns = 0;  ///< CR without LF, but for one at the end of the file
  std::uint64_t joints = 0;        ///< no blank stands before the backslash, and none at the begin of the next line

  /// Returns how many of them other programs read in another way. A CR that is no line end for them is a blank, or a
  /// part of a comment.
  [[nodiscard]] std::uint64_t odd() const { return joints + (line_feeds > 0 ? lone_returns : 0); }
  void add(const LineEnds& e) { line_feeds += e.line_feeds, lone_returns += e.lone_returns, joints += e.joints; }
};

class TextScanner {
 public:
  using Mark = TextMark;

  explicit TextScanner(SceneFilePtr file, Mark from = {});

  void seek(Mark mark);
  [[nodiscard]] Mark mark() const { return {offset(), line_}; }
  [[nodiscard]] std::uint64_t line() const { return line_; }
  [[nodiscard]] std::uint64_t offset() const { return begin_ + std::uint64_t(cur_ - text_); }
  [[nodiscard]] std::uint64_t remaining() const { return file_->size() - std::min(file_->size(), offset()); }

  /// Skips blanks, and line ends after a backslash. Returns true if a word follows on this line.
  bool word_on_line() {
    for (;;) {
      while (*cur_ == ' ' || *cur_ == '\t') ++cur_;
      if (static_cast<unsigned char>(*cur_) > ' ' && *cur_ != '\\') return true;
      const Next next = look_ahead();
      if (next != Next::blank) return next == Next::word;
    }
  }
  /// Skips blanks, line ends and, if `comment` is not 0, from that character to the end of the line. Returns false at
  /// the end.
  bool word_anywhere(char comment = 0);
  /// Moves behind the end of this line. Returns whether a backslash stands before it.
  bool next_line();

  /// Returns the word at the cursor (word_on_line() or word_anywhere() has returned true); valid until the next call.
  /// Throws if it has more than 4096 characters.
  std::string_view word();
  /// Returns the words from here to the end of the line, or to a backslash before it, with one blank between them.
  /// Throws as word().
  std::string rest_of_line();
  /// Returns whether anything but blanks follows on this line. Skips these blanks.
  bool has_more();
  [[nodiscard]] char peek() const { return *cur_; }
  /// Returns whether a blank, a line end or a backslash is next.
  [[nodiscard]] bool at_word_end() const { return static_cast<unsigned char>(*cur_) <= ' ' || *cur_ == '\\'; }
  void step() { cur_ += cur_ != end_; }  ///< moves over the character that peek() returned
  void skip_word();                      ///< a word of any length

  /// Reads a number, which must end at a blank, a line end or a comment. Values out of range of a double become 0 or
  /// infinite; "nan", "inf" and Microsoft's "1.#INF" are read. Returns false if there is no number.
  bool real(double& value);
  /// Reads an integer, which may end at anything ("3/4"). Out of range it becomes the nearest that fits. Returns false
  /// if there is no integer.
  bool integer(std::int64_t& value);
  /// Reads an integer that may be written as a real ("3.0") and must end as one.
  bool count(std::int64_t& value);
  /// Reads an integer of up to 18 digits, with "-" before them at most. Returns false, and reads nothing, if the word
  /// is another.
  bool plain_integer(std::int64_t& value);

  [[nodiscard]] bool at_end() { return cur_ == end_ && (eof_ || !refill()); }

  /// Notes that other programs read a line in another way: this one, or one behind the last that was noted. A line
  /// counts once, and not if it is read again.
  void doubt() { doubt(line_); }
  void doubt(std::uint64_t line) {
    if (line <= doubted_to_ || offset() < counted_to_) return;
    ++doubted_;
    doubted_to_ = line;
  }
  [[nodiscard]] std::uint64_t doubted() const { return doubted_; }  ///< lines that doubt() has noted
  /// Returns how many lines of the text that was read so far, or of that behind it in the buffer, other programs read
  /// in another way: those of doubt(), with odd line ends, and with odd characters.
  [[nodiscard]] std::uint64_t odd_lines() const { return doubted_ + ends_.odd() + characters_.lines(); }
  /// Returns the line ends that were met so far. One that is read again after seek() counts once.
  [[nodiscard]] const LineEnds& ends() const { return ends_; }
  /// Adds line ends of a part of the file that this scanner does not read.
  void add_ends(const LineEnds& elsewhere) { ends_.add(elsewhere); }

  /// Throws bad_input "file: line N: ...".
  template <class... Args>
  [[noreturn]] void fail_here(fmt::format_string<Args...> format, Args&&... args) const {
    fail(ErrorCode::bad_input, "{}: line {}: {}", file_->name(), line_,
         fmt::format(format, std::forward<Args>(args)...));
  }

 private:
  static constexpr std::size_t kBuffer = std::size_t(1) << 18, kMaxWord = 4096;

  [[nodiscard]] bool goes_on();  // a backslash is here, and the line ends behind it
  enum class Next { blank, word, line_end };
  Next look_ahead();
  void go_on();     // moves behind the backslash at cur_ and the line end behind it
  void line_end();  // moves behind the line end at cur_
  bool refill();    // keeps unread characters and the last one that was read; returns false if nothing was added
  void need_word() {
    if (!eof_ && std::size_t(end_ - cur_) < kMaxWord) refill();
  }
  [[nodiscard]] double real_out_of_range(const char* last) const;
  bool skip_microsoft_nan(double& value);

  SceneFilePtr file_;
  std::unique_ptr<char[]> buffer_;  // the character before text_, kBuffer characters and a sentinel '\n'
  char* const text_;
  char *cur_, *end_;
  std::uint64_t begin_ = 0;  // offset of text_[0] in the file
  std::uint64_t line_ = 1;
  bool eof_ = false;  // the buffer reaches the end of the file
  LineEnds ends_;
  std::uint64_t counted_to_ = 0;  // line ends before this offset are in ends_
  OddCharacters characters_;
  std::uint64_t looked_to_ = 0;                 // characters before this offset are in characters_
  std::uint64_t doubted_ = 0, doubted_to_ = 0;  // lines of doubt(), and the last one
};

}  // namespace bp
