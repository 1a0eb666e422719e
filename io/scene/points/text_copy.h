#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "io/files/file.h"
#include "io/scene/scene_file.h"
#include "lib/core/error.h"

namespace bp {

/// The position of a number in a text, and its value.
struct NumberPlace {
  std::uint64_t begin = 0, end = 0;
  double value = 0;
};

/// A copy of a file in which some bytes are replaced, front to back.
class TextCopy {
 public:
  TextCopy(SceneFilePtr file, OutputFile& out) : file_(std::move(file)), out_(out) {}

  /// Copies up to `begin`, and leaves out the bytes up to `end`.
  void replace(std::uint64_t begin, std::uint64_t end, const std::string& text) {
    copy_to(begin);
    out_.write(text);
    at_ = end;
  }
  /// Replaces a number. A number whose value stays keeps its text. `digits_of_float`: the digits of a float suffice.
  void replace(const NumberPlace& place, double value, bool digits_of_float) {
    if (value != place.value) replace(place.begin, place.end, number_text(value, digits_of_float));
  }
  void finish() { copy_to(file_->size()); }

 private:
  static std::string number_text(double value, bool digits_of_float);
  void copy_to(std::uint64_t end) {
    std::vector<std::byte> block(std::min<std::uint64_t>(end - std::min(end, at_), std::uint64_t(1) << 18));
    while (at_ < end) {
      const std::size_t want = std::size_t(std::min<std::uint64_t>(block.size(), end - at_));
      const std::size_t n = file_->read_at(at_, std::span(block).first(want));
      if (n == 0) fail(ErrorCode::bad_input, "{}: ends at byte {}; it changed while it was read", file_->name(), at_);
      out_.write(std::span<const std::byte>(block).first(n));
      at_ += n;
    }
  }
  SceneFilePtr file_;
  OutputFile& out_;
  std::uint64_t at_ = 0;
};

inline std::string TextCopy::number_text(double value, bool digits_of_float) {
  return digits_of_float ? fmt::format("{}", float(value)) : fmt::format("{}", value);
}

}  // namespace bp
