#include "lib/atlas/atlas.h"

#include <algorithm>
#include <cmath>

#include "lib/atlas/charts.h"
#include "lib/atlas/pack.h"
#include "lib/core/error.h"

namespace bp {

namespace {

constexpr int kPadding = 2;  // texels around a chart
constexpr int kStep = 4;     // rectangles begin and end at multiples: halved twice, no texel has two charts
constexpr int kLeastSide = 32;

int texels(double length, double texel) {
  const double n = std::ceil(length / texel) + 2 * kPadding;
  return int(std::min(n, 1e8) + kStep - 1) / kStep * kStep;
}

/// Returns the rectangles of charts; none if they have more texels than an image.
std::vector<PackedRect> rectangles(const std::vector<Chart>& charts, double texel, int most_side) {
  std::vector<PackedRect> rects;
  double area = 0;
  for (const Chart& chart : charts) {
    rects.push_back({texels(chart.size[0], texel), texels(chart.size[1], texel)});
    area += double(rects.back().width) * rects.back().height;
    if (rects.back().width > most_side || rects.back().height > most_side) return {};
  }
  if (area > double(most_side) * most_side) return {};
  return rects;
}

/// Finds the narrowest image that is not higher than wide. Returns false if there is none.
bool place(std::vector<PackedRect>& rects, int most_side, Atlas& atlas) {
  double area = 0;
  int width = kLeastSide;
  for (const PackedRect& r : rects) {
    area += double(r.width) * r.height;
    while (width < std::max(r.width, r.height) && width < most_side) width *= 2;
  }
  for (; width < most_side && double(width) * width < area;) width *= 2;
  for (width = std::min(width, most_side);; width = std::min(2 * width, most_side)) {
    if (const std::optional<int> height = pack(rects, width, width)) {
      atlas.width = width;
      atlas.height = *height;
      return true;
    }
    if (width == most_side) return false;
  }
}

}  // namespace

Atlas unwrap(const LatticeMesh& mesh, const AtlasParams& params) {
  if (mesh.triangles.empty()) fail(ErrorCode::bad_argument, "the mesh has no triangle; it cannot be unwrapped");
  const std::vector<Chart> charts = cut_charts(mesh);
  const auto most = std::uint64_t(params.most_side / (2 * kStep)) * std::uint64_t(params.most_side / (2 * kStep));
  if (charts.size() > most)
    fail(ErrorCode::bad_argument, "{} charts do not fit in an image of {} x {} texels", charts.size(), params.most_side,
         params.most_side);
  constexpr double kLarger = 1.0625;
  Atlas atlas;
  std::vector<PackedRect> rects;
  for (atlas.texel = params.texel;; atlas.texel *= kLarger) {
    rects = rectangles(charts, atlas.texel, params.most_side);
    if (!rects.empty() && place(rects, params.most_side, atlas)) break;
  }
  atlas.corners.resize(mesh.triangles.size());
  atlas.chart.resize(mesh.triangles.size());
  for (std::uint32_t c = 0; c < charts.size(); ++c) {
    for (std::size_t i = 0; i < charts[c].faces.size(); ++i) {
      const std::uint32_t face = charts[c].faces[i];
      atlas.chart[face] = c;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::array<double, 2>& p = charts[c].corners[i][k];
        atlas.corners[face][k] = {float(rects[c].x + kPadding + p[0] / atlas.texel),
                                  float(rects[c].y + kPadding + p[1] / atlas.texel)};
      }
    }
  }
  return atlas;
}

}  // namespace bp
