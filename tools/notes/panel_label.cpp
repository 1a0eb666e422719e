#include "tools/notes/panel_label.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

/// Returns the last `parts` parts of a path.
std::string tail(const std::string& path, std::size_t parts) {
  std::size_t begin = path.size();
  for (; parts > 0 && begin > 0; --parts) {
    const std::size_t slash = begin >= 2 ? path.rfind('/', begin - 2) : std::string::npos;
    begin = slash == std::string::npos ? 0 : slash + 1;
  }
  return path.substr(begin);
}

std::string name_among(const std::string& path, const std::vector<std::string>& paths) {
  for (std::size_t parts = 1;; ++parts) {
    const std::string name = tail(path, parts);
    const auto clashes = [&](const std::string& other) { return other != path && tail(other, parts) == name; };
    if (name == path || std::none_of(paths.begin(), paths.end(), clashes)) return name;
  }
}

}  // namespace

std::vector<std::string> panel_names(const std::vector<std::string>& paths) {
  std::vector<std::string> names;
  for (const std::string& path : paths) names.push_back(path == "-" ? "stdin" : name_among(path, paths));
  return names;
}

std::string bounds_text(const Bounds3d& bounds) {
  if (bounds.empty()) return "";
  // Digits tell a thousandth of the diagonal, and no more than doubles have.
  const double step = bounds.diagonal() / 1000;
  const int after_point = step > 0 && std::isfinite(step) ? int(std::ceil(-std::log10(step))) : 6;
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = [&](double x) {
      if (x == 0 || !std::isfinite(x)) return fmt::format("{}", x);
      const int before_point = int(std::floor(std::log10(std::abs(x)))) + 1;
      return fmt::format("{:.{}g}", x, std::clamp(before_point + std::max(0, after_point), 1, 17));
    };
    text += fmt::format("{}{} {} to {}", i == 0 ? "" : ", ", "xyz"[i], number(bounds.min[i]), number(bounds.max[i]));
  }
  return text;
}

std::string note_on_font(const Typeface* typeface) {
  return typeface != nullptr ? ""
                             : "no font was found, so the picture has no labels; install DejaVu Sans "
                               "(Debian and Ubuntu: fonts-dejavu-core)";
}

}  // namespace bp
