#include "lib/core/length.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "lib/core/error.h"

namespace bp {

namespace {

Length length_of(std::string_view text, std::string_view what, bool may_be_pixels) {
  Length length;
  const std::string_view unit = take_number(text, length.value, what);
  if (unit == "%") {
    length.unit = Length::Unit::percent;
  } else if (unit == "vx") {
    length.unit = Length::Unit::voxels;
  } else if (unit == "px" && may_be_pixels) {
    length.unit = Length::Unit::pixels;
  } else if (!unit.empty()) {
    refuse_unit(text, unit, what);
  }
  if (length.value < 0) fail(ErrorCode::bad_argument, "'{}' is negative; a length is at least 0", text);
  length.value += 0.0;  // -0 is 0, also as text
  return length;
}

}  // namespace

std::string_view take_number(std::string_view text, double& value, std::string_view what) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) fail(ErrorCode::bad_argument, "'{}' is not {}", text, what);
  return text.substr(std::size_t(end - text.data()));
}

void refuse_unit(std::string_view text, std::string_view unit, std::string_view what) {
  const bool is_name = unit != "vx" && unit != "px" && std::all_of(unit.begin(), unit.end(), [](char c) {
                         return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
                       });
  fail(ErrorCode::bad_argument, "'{}' is not {}{}", text, what,
       is_name ? "; a scene does not name its unit, so give a number without one" : "");
}

double parse_number(std::string_view text) {
  double value = 0;
  if (!take_number(text, value, "a number").empty()) fail(ErrorCode::bad_argument, "'{}' is not a number", text);
  return value;
}

double Length::in_world(double diagonal, double voxel) const {
  if (unit == Unit::scene) return value;
  if (unit == Unit::percent || unit == Unit::pixels) {
    if (!(diagonal > 0)) fail(ErrorCode::bad_argument, "{}: the bounding box has no diagonal here", text());
    return unit == Unit::pixels ? diagonal / value : value / 100 * diagonal;
  }
  if (!(voxel > 0)) fail(ErrorCode::bad_argument, "{}: no voxel size is known here", text());
  return value * voxel;
}

std::string Length::text() const {
  constexpr const char* kUnits[] = {"", "%", "vx", "px"};
  return fmt::format("{}{}", value, kUnits[std::size_t(unit)]);
}

Length parse_length(std::string_view text) {
  return length_of(text, "a length such as 0.5, 2% or 20vx", false);
}

Length parse_error_length(std::string_view text) {
  const Length error = length_of(text, "a length such as 0.5, 2%, 20vx or 800px", true);
  if (!(error.value > 0)) fail(ErrorCode::bad_argument, "{}: an error must be above 0", text);
  return error;
}

}  // namespace bp
