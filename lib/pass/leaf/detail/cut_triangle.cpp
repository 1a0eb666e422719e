#include "lib/pass/leaf/detail/cut_triangle.h"

// Sutherland and Hodgman's clipping: x, y, z, the lower face before the upper one. Boxes on both sides of a face have
// the same other faces, or halves of them, so an edge is cut by the same faces in the same order.

namespace bp {

namespace {

template <std::size_t N>
std::array<double, N> between(const std::array<double, N>& a, const std::array<double, N>& b, double part) {
  std::array<double, N> out;
  for (std::size_t i = 0; i < N; ++i) out[i] = a[i] + part * (b[i] - a[i]);
  return out;
}

/// The same point, whichever end comes first.
CutPoint crossing(const CutPoint& a, const CutPoint& b, std::size_t axis, double face) {
  if (b.at < a.at) return crossing(b, a, axis, face);
  const double part = (face - a.at[axis]) / (b.at[axis] - a.at[axis]);
  CutPoint p{between(a.at, b.at, part), between(a.normal, b.normal, part), between(a.uv, b.uv, part),
             between(a.color, b.color, part)};
  p.at[axis] = face;
  return p;
}

/// Keeps what lies on the upper side of a face, or on the lower one.
void cut(std::vector<CutPoint>& polygon, std::size_t axis, double face, bool upper) {
  const auto is_in = [&](const CutPoint& p) { return upper ? p.at[axis] >= face : p.at[axis] <= face; };
  std::vector<CutPoint> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const CutPoint &p = polygon[i], &next = polygon[(i + 1) % polygon.size()];
    if (is_in(p)) kept.push_back(p);
    if (is_in(p) != is_in(next) && p.at[axis] != face && next.at[axis] != face)
      kept.push_back(crossing(p, next, axis, face));
  }
  polygon = std::move(kept);
}

}  // namespace

std::vector<CutPoint> cut_triangle(const std::array<CutPoint, 3>& triangle, const Bounds3d& box) {
  std::vector<CutPoint> polygon(triangle.begin(), triangle.end());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cut(polygon, axis, box.min[axis], true);
    cut(polygon, axis, box.max[axis], false);
  }
  if (polygon.size() < 3) polygon.clear();
  return polygon;
}

}  // namespace bp
