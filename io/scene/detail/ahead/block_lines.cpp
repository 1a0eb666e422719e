#include "io/scene/detail/ahead/block_lines.h"

#include <algorithm>

#include "io/scene/detail/text/odd_characters.h"

namespace bp {

BlockLines::BlockLines(const SceneFile& file, std::uint64_t begin, std::uint64_t first) {
  const std::uint64_t before = begin > first ? 1 : 0;  // the character that tells whether a line begins here
  begin_ = begin - before;
  text_.resize(std::size_t(before + kBlock + kLongest));
  text_.resize(file.read_at(begin_, std::as_writable_bytes(std::span(text_))));
  at_ = text_.data();
  end_ = at_ + text_.size();
  last_ = at_ + std::min<std::size_t>(std::size_t(before + kBlock), text_.size());
  whole_ = begin_ + text_.size() >= file.size();
  if (begin == 0 && starts_with_mark({at_, text_.size()})) at_ += 3;
  if (before == 0) return;
  at_ = std::find(at_, end_, '\n');  // the line before ends here, or later
  at_ += at_ != end_ ? 1 : 0;
}

bool BlockLines::has_odd_characters() const {
  OddCharacters odd;
  odd.add({at_, std::size_t(end_ - at_)});
  return odd.lines() > 0;
}

bool BlockLines::next() {
  if (at_ >= end_) {
    plain_ = plain_ && whole_;
    return false;
  }
  const char* line_end = static_cast<const char*>(std::memchr(at_, '\n', std::size_t(end_ - at_)));
  ended_ = line_end != nullptr;
  if (!ended_) line_end = end_;
  const char* const next = ended_ ? line_end + 1 : end_;
  if (line_end != at_ && line_end[-1] == '\r') --line_end;
  line_ = std::string_view(at_, std::size_t(line_end - at_));
  at_ = next;
  plain_ = (ended_ || whole_) && line_.find('\r') == std::string_view::npos;
  return plain_;
}

}  // namespace bp
