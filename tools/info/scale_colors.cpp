#include "tools/info/scale_colors.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

/// Cuts triangles across their longest edges until no edge is too long.
std::vector<TriangleD> cut(std::vector<TriangleD> left, double longest) {
  std::vector<TriangleD> done;
  while (!left.empty()) {
    const TriangleD t = left.back();
    left.pop_back();
    std::size_t k = 0;
    const auto edge = [&](std::size_t i) { return length(t[(i + 1) % 3] - t[i]); };
    for (std::size_t i = 1; i < 3; ++i) {
      if (edge(i) > edge(k)) k = i;
    }
    if (!(edge(k) > longest)) {
      done.push_back(t);
      continue;
    }
    const Vec3d middle = 0.5 * (t[k] + t[(k + 1) % 3]);
    left.push_back({t[k], middle, t[(k + 2) % 3]});
    left.push_back({middle, t[(k + 1) % 3], t[(k + 2) % 3]});
  }
  return done;
}

LinearColor color_of(double t) {
  const Color c = color_on_bar(t);
  return color_from_srgb({c.r / 255.0, c.g / 255.0, c.b / 255.0});
}

}  // namespace

ColorBar color_by_scale(const ScaleField& scale, double longest, std::vector<TriangleD>& triangles,
                        std::vector<TriangleColors>& colors) {
  triangles = cut(std::move(triangles), longest);
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
