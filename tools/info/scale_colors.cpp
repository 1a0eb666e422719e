#include "tools/info/scale_colors.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/parallel.h"

namespace bp {

namespace {

LinearColor color_of(double t) {
  const Color c = color_on_bar(t);
  return color_from_srgb({c.r / 255.0, c.g / 255.0, c.b / 255.0});
}

}  // namespace

ColorBar color_by_scale(const ScaleField& scale, const std::vector<TriangleD>& triangles,
                        std::vector<TriangleColors>& colors) {
  std::vector<std::array<double, 3>> scales(triangles.size());
  parallel_for(std::int64_t(triangles.size()), [&](std::int64_t i) {
    for (std::size_t k = 0; k < 3; ++k) scales[std::size_t(i)][k] = scale.evaluate(triangles[std::size_t(i)][k]);
  });
  double least = triangles.empty() ? scale.base : scales[0][0], most = least;
  for (const auto& s : scales) {
    least = std::min({least, s[0], s[1], s[2]});
    most = std::max({most, s[0], s[1], s[2]});
  }
  colors.resize(triangles.size());
  const double span = most > least ? most - least : 1;
  parallel_for(std::int64_t(triangles.size()), [&](std::int64_t i) {
    for (std::size_t k = 0; k < 3; ++k)
      colors[std::size_t(i)][k] = color_of((scales[std::size_t(i)][k] - least) / span);
  });
  return {fmt::format("{:.3g}", least), fmt::format("{:.3g}", most)};
}

}  // namespace bp
