#include "lib/pass/leaf/detail/cut_triangle.h"

#include <algorithm>

// Sutherland and Hodgman's clipping: x, y, z, the lower face before the upper one. An edge of the polygon is a piece of
// a segment: an edge of the triangle, or the whole section of the triangle with the plane of a face. Every point is
// computed from the ends of the whole segment, the lesser end first. So triangles on both sides of an edge, and boxes
// on both sides of a face, have the same points, bit for bit, whatever else cuts them.

namespace bp {

namespace {

/// The ends of a segment, the lesser first.
struct Segment {
  CutPoint a, b;
};

/// A corner of the polygon, and the segment that the edge from here to the next corner is a piece of.
struct CutCorner {
  CutPoint point;
  std::size_t segment;
};

/// Returns a point between a and b, never beyond them by rounding.
template <std::size_t N>
std::array<double, N> between(const std::array<double, N>& a, const std::array<double, N>& b, double part) {
  std::array<double, N> out;
  for (std::size_t i = 0; i < N; ++i)
    out[i] = std::clamp(a[i] + part * (b[i] - a[i]), std::min(a[i], b[i]), std::max(a[i], b[i]));
  return out;
}

CutPoint crossing(const Segment& s, std::size_t axis, double face) {
  const double run = s.b.at[axis] - s.a.at[axis];
  const double part = run != 0 ? std::clamp((face - s.a.at[axis]) / run, 0.0, 1.0) : 0;
  CutPoint p{between(s.a.at, s.b.at, part), between(s.a.normal, s.b.normal, part), between(s.a.uv, s.b.uv, part),
             between(s.a.second_uv, s.b.second_uv, part), between(s.a.color, s.b.color, part)};
  p.at[axis] = face;
  return p;
}

class TriangleCutter {
 public:
  explicit TriangleCutter(const std::array<CutPoint, 3>& triangle) : triangle_(triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
      const CutPoint &p = triangle[k], &q = triangle[(k + 1) % 3];
      segments_.push_back(q.at < p.at ? Segment{q, p} : Segment{p, q});
      polygon_.push_back({p, k});
    }
  }

  /// Keeps the part on the upper side of a face, or on the lower one.
  void cut(std::size_t axis, double face, bool upper) {
    const auto is_in = [&](const CutPoint& p) { return upper ? p.at[axis] >= face : p.at[axis] <= face; };
    std::vector<CutCorner> kept;
    std::size_t in_face = kNone;
    for (std::size_t i = 0; i < polygon_.size(); ++i) {
      const CutCorner &p = polygon_[i], &next = polygon_[(i + 1) % polygon_.size()];
      if (is_in(p.point)) kept.push_back(p);
      if (is_in(p.point) == is_in(next.point)) continue;
      if (p.point.at[axis] != face && next.point.at[axis] != face)
        kept.push_back({crossing(segments_[p.segment], axis, face), p.segment});
      if (!is_in(p.point)) continue;
      if (in_face == kNone)
        in_face = add_segment(axis, face);  // where the outline leaves the polygon, its edge in the face begins
      kept.back().segment = in_face;
    }
    polygon_ = std::move(kept);
  }

  [[nodiscard]] std::vector<CutPoint> points() const {
    std::vector<CutPoint> all;
    if (polygon_.size() < 3) return all;
    for (const CutCorner& c : polygon_) all.push_back(c.point);
    return all;
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t(0);

  /// Adds the segment in which the triangle meets the plane of the face. The triangle has corners on both sides of it,
  /// or on it.
  std::size_t add_segment(std::size_t axis, double face) {
    std::vector<CutPoint> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      const double here = triangle_[k].at[axis], next = triangle_[(k + 1) % 3].at[axis];
      if (here == face) ends.push_back(triangle_[k]);
      if ((here < face && next > face) || (here > face && next < face))
        ends.push_back(crossing(segments_[k], axis, face));
    }
    std::sort(ends.begin(), ends.end(), [](const CutPoint& a, const CutPoint& b) { return a.at < b.at; });
    segments_.push_back({ends.front(), ends.back()});
    return segments_.size() - 1;
  }

  const std::array<CutPoint, 3>& triangle_;
  std::vector<Segment> segments_;  ///< the first three: edges of the triangle
  std::vector<CutCorner> polygon_;
};

}  // namespace

std::vector<CutPoint> cut_triangle(const std::array<CutPoint, 3>& triangle, const Bounds3d& box) {
  TriangleCutter cutter(triangle);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cutter.cut(axis, box.min[axis], true);
    cutter.cut(axis, box.max[axis], false);
  }
  return cutter.points();
}

}  // namespace bp
