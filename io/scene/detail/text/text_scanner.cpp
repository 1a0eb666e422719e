#include "io/scene/detail/text/text_scanner.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "io/scene/detail/text/plain_integer.h"

namespace bp {

namespace {

bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}
/// Returns whether c is a vertical tab, a form feed, or the mark that DOS set behind the last line.
bool is_odd_blank(char c) {
  return c == '\v' || c == '\f' || c == '\x1A';
}
/// Returns whether c ends a word: a blank, a line end, or another ASCII control character.
bool ends_word(char c) {
  return static_cast<unsigned char>(c) <= ' ';
}
bool ends_number(char c) {
  return ends_word(c) || c == '#' || c == '\\';
}

}  // namespace

TextScanner::TextScanner(SceneFilePtr file, Mark from)
    : file_(std::move(file)), buffer_(new char[kBuffer + 2]), text_(buffer_.get() + 1) {
  seek(from);
}

void TextScanner::seek(Mark mark) {
  begin_ = mark.offset;
  line_ = mark.line;
  cur_ = end_ = text_;
  *end_ = cur_[-1] = '\n';
  eof_ = false;
}

bool TextScanner::refill() {
  if (eof_) return false;
  const auto kept = std::size_t(end_ - cur_);
  begin_ += std::uint64_t(cur_ - text_);
  text_[-1] = cur_[-1];
  std::memmove(text_, cur_, kept);
  cur_ = text_;
  const std::size_t got = file_->read_at(begin_ + kept, std::as_writable_bytes(std::span(cur_ + kept, kBuffer - kept)));
  end_ = cur_ + kept + got;
  eof_ = kept + got < kBuffer;
  *end_ = '\n';
  if (begin_ == 0 && kept == 0) cur_ += starts_with_mark({cur_, got}) ? 3 : 0;
  const std::uint64_t behind = begin_ + std::uint64_t(end_ - text_);
  const std::uint64_t first = std::max({begin_ + std::uint64_t(kept), looked_to_, offset()});
  if (behind > first) characters_.add({text_ + (first - begin_), std::size_t(behind - first)});
  looked_to_ = std::max(looked_to_, behind);
  return got > 0;
}

void TextScanner::line_end() {
  if (*cur_ == '\r' && cur_ + 1 == end_) refill();  // an LF may follow
  const bool has_return = *cur_ == '\r', is_last = cur_ + 1 == end_;
  const bool has_feed = !has_return || (!is_last && cur_[1] == '\n');
  cur_ += has_return && has_feed ? 2 : 1;
  ++line_;
  if (offset() <= counted_to_ || (has_return && is_last)) return;
  counted_to_ = offset();
  ++(has_feed ? ends_.line_feeds : ends_.lone_returns);
}

void TextScanner::go_on() {
  const bool is_new = offset() >= counted_to_, touches_word = !ends_word(cur_[-1]);
  ++cur_;
  line_end();
  if (is_new && touches_word && !at_end() && !ends_word(*cur_)) ++ends_.joints;
}

// Looks further where a run of blanks ended at a line end, a backslash, a control character or the end of the buffer.
TextScanner::Next TextScanner::look_ahead() {
  if (cur_ == end_) return refill() ? Next::blank : Next::line_end;
  if (is_line_end(*cur_)) return Next::line_end;
  if (*cur_ == '\\') {
    if (cur_ + 1 == end_) refill();
    if (cur_ + 1 == end_ || !is_line_end(cur_[1])) return Next::word;
    go_on();
    return Next::blank;
  }
  if (is_odd_blank(*cur_)) {
    ++cur_;
    return Next::blank;
  }
  fail_here("byte {} is a control character ({}); this is not a text file of the expected format", offset(),
            int(static_cast<unsigned char>(*cur_)));
}

bool TextScanner::word_anywhere(char comment) {
  for (;;) {
    if (at_end()) return false;
    if (is_line_end(*cur_)) {
      line_end();
    } else if (comment != 0 && *cur_ == comment) {
      next_line();
    } else if (*cur_ == ' ' || *cur_ == '\t' || is_odd_blank(*cur_)) {
      ++cur_;
    } else {
      return true;
    }
  }
}

bool TextScanner::next_line() {
  do {
    while (!is_line_end(*cur_)) ++cur_;
    if (cur_ != end_) {
      const bool continued = cur_[-1] == '\\';
      line_end();
      return continued;
    }
  } while (refill());
  return false;
}

std::string_view TextScanner::word() {
  need_word();
  const char* last = cur_;
  while (!ends_word(*last)) ++last;
  if (std::size_t(last - cur_) >= kMaxWord)
    fail_here("a word of more than {} characters; is this a text file?", kMaxWord);
  const std::string_view found(cur_, std::size_t(last - cur_));
  cur_ += found.size();
  return found;
}

std::string TextScanner::rest_of_line() {
  std::string line;
  while (has_more() && !goes_on() && word_on_line()) {
    if (!line.empty()) line.push_back(' ');
    const std::string_view next = word();
    line.append(next.begin(), next.end());
  }
  return line;
}

bool TextScanner::has_more() {
  do {
    while (*cur_ == ' ' || *cur_ == '\t' || is_odd_blank(*cur_)) ++cur_;
  } while (cur_ == end_ && refill());
  return cur_ != end_ && !is_line_end(*cur_);
}

bool TextScanner::goes_on() {
  if (cur_ + 1 == end_) refill();
  return *cur_ == '\\' && cur_ + 1 != end_ && is_line_end(cur_[1]);
}

void TextScanner::skip_word() {
  do {
    while (!ends_word(*cur_)) ++cur_;
  } while (cur_ == end_ && refill());
}

// Returns the value of a number that has no double, which from_chars leaves alone: too large, or nearer to 0 than any
// double.
double TextScanner::real_out_of_range(const char* last) const {
  bool large = false;  // without an exponent: large if a digit other than 0 stands before the point
  const char* c = cur_;
  for (; c != last && *c != '.' && *c != 'e' && *c != 'E'; ++c) large |= *c >= '1' && *c <= '9';
  for (; c != last; ++c) {
    if (*c == 'e' || *c == 'E') large = c[1] != '-';
  }
  return large ? std::numeric_limits<double>::infinity() : 0.0;
}

// Skips 1.#INF 1.#IND 1.#QNAN 1.#SNAN; the '#' after any other number starts a comment.
bool TextScanner::skip_microsoft_nan(double& value) {
  if (cur_[1] != 'I' && cur_[1] != 'Q' && cur_[1] != 'S') return false;
  value = std::numeric_limits<double>::quiet_NaN();
  skip_word();
  return true;
}

bool TextScanner::plain_integer(std::int64_t& value) {
  need_word();
  const char* const last = take_digits(cur_, end_, value);
  if (last == nullptr || !ends_word(*last)) return false;
  cur_ += last - cur_;
  return true;
}

bool TextScanner::real(double& value) {
  need_word();
  if (*cur_ == '+' && cur_[1] != '-') ++cur_;
  const auto [last, error] = std::from_chars(cur_, end_, value);
  if (error == std::errc::invalid_argument) return false;
  if (error == std::errc::result_out_of_range) value = real_out_of_range(last);
  cur_ += last - cur_;
  if (cur_ == end_) refill();  // a word of thousands of digits may go on in the file
  if (*cur_ == '#' && skip_microsoft_nan(value)) return true;
  return ends_number(*cur_);
}

bool TextScanner::integer(std::int64_t& value) {
  need_word();
  if (*cur_ == '+' && cur_[1] != '-') ++cur_;
  const auto [last, error] = std::from_chars(cur_, end_, value);
  if (error == std::errc::invalid_argument) return false;
  if (error == std::errc::result_out_of_range)
    value = *cur_ == '-' ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max();
  cur_ += last - cur_;
  return true;
}

bool TextScanner::count(std::int64_t& value) {
  need_word();
  char* const start = cur_;
  if (integer(value) && ends_number(*cur_)) return true;
  cur_ = start;  // nothing was refilled: need_word() has left enough
  double number = 0;
  if (!real(number) || !(std::abs(number) < 9e15) || number != std::floor(number)) return false;
  value = std::int64_t(number);
  return true;
}

}  // namespace bp
