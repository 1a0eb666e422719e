#pragma once
#include <vector>

#include "lib/core/box.h"
#include "lib/core/indexed_mesh.h"

/// What a triangle of a scene and a proxy have in common inside a box. In doubles, with bounds of their errors: answers
/// are sure one way.
namespace bp {

/// True unless what two triangles have in common, the hull of where edges of one meet the other, surely misses the box.
[[nodiscard]] bool may_meet_within(const TriangleD& a, const TriangleD& b, const Bounds3d& box);

/// How far a point in doubles may lie from the point of the triangle that it stands for.
[[nodiscard]] double rounding_of(const Bounds3d& cell, const TriangleD& t);
/// By how much a cell is grown where the triangle is looked at: far more than rounding, wherever the origin is.
[[nodiscard]] double growth_for(const Bounds3d& cell, const TriangleD& t);
[[nodiscard]] Bounds3d grown(const Bounds3d& box, double by);
[[nodiscard]] bool lies_in(const Bounds3d& inner, const Bounds3d& outer);

/// Triangle ∩ box, a convex polygon; in doubles, relative to the box's corner, so that errors are small beside it.
class TrianglePart {
 public:
  TrianglePart(const TriangleD& t, const Bounds3d& box);
  [[nodiscard]] bool empty() const { return points_.empty(); }
  [[nodiscard]] std::vector<Vec3d> corners() const;  ///< in order, 3 to 9; none if it is empty
  [[nodiscard]] Vec3d middle() const;                ///< of the corners; not empty
  /// The middle, and points between it and the corners.
  [[nodiscard]] std::vector<Vec3d> points_within() const;

 private:
  [[nodiscard]] Vec3d relative_middle() const;
  [[nodiscard]] Vec3d at(const Vec3d& p) const { return {origin_[0] + p[0], origin_[1] + p[1], origin_[2] + p[2]}; }
  /// Keeps where height() is not negative (Sutherland and Hodgman).
  template <class Height>
  void cut(const Height& height);
  std::vector<Vec3d> points_;
  Vec3d origin_{};
};

}  // namespace bp
