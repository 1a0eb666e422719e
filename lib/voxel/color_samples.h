#pragma once
#include <algorithm>

#include "lib/core/vec3.h"

namespace bp {

/// Returns the point of a triangle with these weights of its corners.
[[nodiscard]] inline Vec3d point_of(const TriangleD& t, const std::array<double, 3>& w) {
  return w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
}

/// Points spread evenly over a triangle, no farther than `spacing` from the next: body(weights of the corners, share of
/// the area). Rows along the longest edge, so that a needle costs its length and not its square. Shares add up to 1.
/// Cost: a few samples, or the area over spacing squared.
template <class Body>
void for_each_sample(const TriangleD& t, double spacing, int least_rows, const Body& body) {
  const double edges[3] = {length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])};
  std::size_t a = 0;  // the longest edge goes from a to b
  for (std::size_t k = 1; k < 3; ++k)
    if (edges[k] > edges[a]) a = k;
  const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
  const double base = edges[a];
  const double height = base > 0 ? 2 * area_of(t) / base : 0;
  const double rows = std::max(double(least_rows), std::ceil(height / spacing));
  // A row stands for a strip of the unit triangle, and lies at the centroid of that strip: one sample is the triangle's
  // centroid, and linear functions are summed up exactly. `area_to`, `moment_to`: area and first moment of the part
  // from 0 to t.
  const auto area_to = [](double x) { return x - x * x / 2; };
  const auto moment_to = [](double x) { return x * x / 2 - x * x * x / 3; };
  for (double j = 0; j < rows; ++j) {
    const double from = j / rows, to = (j + 1) / rows, area = area_to(to) - area_to(from);
    const double towards_c = (moment_to(to) - moment_to(from)) / area, left = 1 - towards_c;
    const double columns = std::max(double(least_rows), std::ceil(base * left / spacing));
    const double share = 2 * area / columns;
    for (double i = 0; i < columns; ++i) {
      const double along = left * (i + 0.5) / columns;
      std::array<double, 3> w{};
      w[a] = left - along, w[b] = along, w[c] = towards_c;
      body(w, share);
    }
  }
}

}  // namespace bp
