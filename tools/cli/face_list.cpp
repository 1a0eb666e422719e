#include "tools/cli/face_list.h"

#include <algorithm>

#include "lib/core/error.h"
#include "tools/cli/length.h"

namespace bp {

namespace {

/// Returns whether the text is one number in groups of three digits: "1,000" or "20,500". A list of falling numbers
/// never looks so.
bool is_grouped(const std::string& text) {
  const std::size_t first = text.find(',');
  if (first == 0 || first > 3) return false;
  if (text.find_first_not_of("0123456789,") != std::string::npos) return false;
  for (std::size_t at = first; at < text.size(); at += 4) {
    if (text[at] != ',' || text.size() - at < 4 || text.find(',', at + 1) < at + 4) return false;
  }
  return true;
}

[[noreturn]] void refuse(const std::string& text, const char* why) {
  if (!is_grouped(text)) fail(ErrorCode::bad_argument, "{}: {}", text, why);
  std::string digits = text;
  digits.erase(std::remove(digits.begin(), digits.end(), ','), digits.end());
  fail(ErrorCode::bad_argument, "{}: {}; commas part levels, so if it is one number, write {}", text, why, digits);
}

}  // namespace

std::vector<std::uint64_t> parse_face_list(const std::string& text) {
  std::vector<std::uint64_t> all;
  for_each_item(text, [&](std::string_view item) {
    all.push_back(std::uint64_t(parse_count(item, 0, INT64_MAX)));
    if (all.back() == 0) refuse(text, "a level must have faces");
    if (all.size() > 1 && all.back() >= all[all.size() - 2])
      refuse(text, "each level must have fewer than the one before");
  });
  return all;
}

std::vector<double> parse_face_shares(const std::string& text) {
  std::vector<double> all;
  for_each_item(text, [&](std::string_view item) {
    if (item.empty() || item.back() != '%')
      fail(ErrorCode::bad_argument, "{}: mixes numbers and percentages of the scene's triangles; use one of them",
           text);
    item.remove_suffix(1);
    all.push_back(parse_number(item));
    if (!(all.back() > 0 && all.back() <= 100))
      fail(ErrorCode::bad_argument, "{}: a share of the scene's triangles must be above 0% and at most 100%", text);
    if (all.size() > 1 && all.back() >= all[all.size() - 2])
      refuse(text, "each level must have fewer than the one before");
  });
  return all;
}

}  // namespace bp
