#include "lib/voxel/color_sums.h"

#include "lib/voxel/color_samples.h"

namespace bp {

namespace {

constexpr double kUnitArea = 1 << 20;  // ColorSum::weight of one side of a cell
constexpr double kSpacing = 0.5;       // cells

std::uint64_t channel(const TriangleColors& c, std::uint16_t LinearColor::*of, const std::array<double, 3>& w) {
  return std::uint64_t(w[0] * (c[0].*of) + w[1] * (c[1].*of) + w[2] * (c[2].*of) + 0.5);
}

}  // namespace

std::uint16_t color_side_of(const Vec3d& normal) {
  std::uint16_t best = 0;
  double most = 0;
  for (std::uint16_t side = 0; side < kColorSides.size(); ++side) {
    const auto& [x, y, z] = kColorSides[side];
    const double along = x * normal[0] + y * normal[1] + z * normal[2];
    const double squared = along * along / (x * x + y * y + z * z);
    if (!(squared > most)) continue;  // the first of equals stays
    most = squared;
    best = side;
  }
  return best;
}

void add_colors(const TriangleD& triangle_vox, const TriangleColors& colors, std::vector<ColorCellSum>& out) {
  TriangleD t = triangle_vox;
  for (Vec3d& p : t)
    for (double& x : p) x /= kColorCellVox;
  const double area = area_of(t) * kUnitArea;
  const std::uint16_t side = color_side_of(cross(t[1] - t[0], t[2] - t[0]));
  const std::size_t first = out.size();
  for_each_sample(t, kSpacing, 1, [&](const std::array<double, 3>& w, double share) {
    const Vec3d p = point_of(t, w);
    const ColorCell cell{std::int32_t(std::floor(p[0])), std::int32_t(std::floor(p[1])),
                         std::int32_t(std::floor(p[2]))};
    const std::uint64_t weight = std::max<std::uint64_t>(1, std::uint64_t(area * share + 0.5));
    const ColorSum sum{weight, weight * channel(colors, &LinearColor::r, w),
                       weight * channel(colors, &LinearColor::g, w), weight * channel(colors, &LinearColor::b, w)};
    const auto layer = std::uint16_t(side < kColorAxes ? (p[side] - cell[side]) * kColorCellVox : 0);
    if (out.size() > first && out.back().cell == cell &&
        out.back().layer == layer) {  // neighbouring samples mostly lie in one cell
      out.back().sum.add(sum);
    } else {
      out.push_back({cell, side, layer, sum});
    }
  });
}

}  // namespace bp
