#include "tools/cli/length.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "lib/core/error.h"

namespace bp {

void for_each_item(std::string_view text, const std::function<void(std::string_view)>& f) {
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    f(text.substr(begin, end - begin));
    begin = end + 1;
  }
}

std::int64_t parse_integer(std::string_view text, std::int64_t lo, std::int64_t hi) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = end == text.data() + text.size() && error != std::errc::invalid_argument;
  if (whole && error == std::errc() && value >= lo && value <= hi) return value;
  if (hi < INT64_MAX) fail(ErrorCode::bad_argument, "'{}' is not a whole number from {} to {}", text, lo, hi);
  if (whole && text[0] != '-') fail(ErrorCode::bad_argument, "'{}' is too large a number", text);
  fail(ErrorCode::bad_argument, "'{}' is not a whole number of at least {}", text, lo);
}

std::int64_t parse_count(std::string_view text, std::int64_t lo, std::int64_t hi) {
  constexpr std::string_view kUnits = "kMG";
  constexpr double kFactors[] = {1e3, 1e6, 1e9};
  const std::string_view last = text.substr(text.size() - std::min<std::size_t>(text.size(), 1));
  const std::size_t unit = last == "K" ? 0 : last.empty() ? std::string_view::npos : kUnits.find(last);
  if (unit == std::string_view::npos) return parse_integer(text, lo, hi);
  double value = 0;
  const std::string_view digits = text.substr(0, text.size() - 1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_number = end == digits.data() + digits.size() && error == std::errc();
  value = std::round(value * kFactors[unit] * 1e3) / 1e3;  // 4.35k is 4350
  if (is_number && value == std::floor(value) && value >= double(lo) && value <= std::min(double(hi), 9e15))
    return std::int64_t(value);
  return parse_integer(text, lo, hi);  // throws: not in range
}

Vec3d parse_point(std::string_view text) {
  Vec3d p{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? rest.find(',') : rest.size();
    if (end == std::string_view::npos) fail(ErrorCode::bad_argument, "'{}' is not three numbers X,Y,Z", text);
    p[i] = parse_number(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return p;
}

std::uint64_t parse_size(std::string_view text) {
  constexpr std::string_view kWhat = "a size such as 512M or 4G";
  double value = 0;
  std::string_view unit = take_number(text, value, kWhat);
  int shift = 0;
  if (!unit.empty()) {
    const std::size_t prefix = std::string_view("KMGT").find(unit[0]);
    if (prefix != std::string_view::npos) {
      shift = 10 * (int(prefix) + 1);
      unit.remove_prefix(1);
      if (unit == "iB") unit = {};
    }
    if (unit == "B") unit = {};
  }
  value = std::floor(std::ldexp(value, shift));
  if (!unit.empty() || value < 0 || value >= 4611686018427387904.0)
    fail(ErrorCode::bad_argument, "'{}' is not {}", text, kWhat);
  return std::uint64_t(value);
}

std::string size_text(std::uint64_t bytes) {
  constexpr std::array<const char*, 5> kUnits{"B", "KiB", "MiB", "GiB", "TiB"};
  double value = double(bytes);
  std::size_t unit = 0;
  while (value >= 1024 && unit + 1 < kUnits.size()) value /= 1024, ++unit;
  return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.3g} {}", value, kUnits[unit]);
}

}  // namespace bp
