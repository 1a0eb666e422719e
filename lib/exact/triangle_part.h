#pragma once
#include <vector>

#include "lib/core/box.h"
#include "lib/core/indexed_mesh.h"

/// The common part of a scene's triangle and a proxy inside a box. Doubles with bounds of their errors decide, so
/// only one of the two answers is sure.
namespace bp {

/// Returns true unless the common part of two triangles surely misses the box. That part is the hull of the points
/// where an edge of one meets the other.
[[nodiscard]] bool may_meet_within(const TriangleD& a, const TriangleD& b, const Bounds3d& box);

/// Returns how far a point in doubles may lie from the point of the triangle that it stands for.
[[nodiscard]] double rounding_of(const Bounds3d& cell, const TriangleD& t);
/// Returns by how much a cell is grown before the triangle is cut: far more than rounding, wherever the origin is.
[[nodiscard]] double growth_for(const Bounds3d& cell, const TriangleD& t);
[[nodiscard]] Bounds3d grown(const Bounds3d& box, double by);
[[nodiscard]] bool lies_in(const Bounds3d& inner, const Bounds3d& outer);

/// The intersection of a triangle and a box, a convex polygon. Doubles are relative to the box's corner, so that errors
/// are small compared with the box.
class TrianglePart {
 public:
  TrianglePart(const TriangleD& t, const Bounds3d& box);
  [[nodiscard]] bool empty() const { return points_.empty(); }
  [[nodiscard]] std::vector<Vec3d> corners() const;  ///< in order: 3 to 9 corners, or none if it is empty
  [[nodiscard]] Vec3d middle() const;                ///< mean of the corners; the part must not be empty
  /// Returns the middle, and points between it and the corners.
  [[nodiscard]] std::vector<Vec3d> points_within() const;

 private:
  [[nodiscard]] Vec3d relative_middle() const;
  [[nodiscard]] Vec3d at(const Vec3d& p) const { return {origin_[0] + p[0], origin_[1] + p[1], origin_[2] + p[2]}; }
  /// Keeps the part where height() is not negative (Sutherland and Hodgman).
  template <class Height>
  void cut(const Height& height);
  std::vector<Vec3d> points_;
  Vec3d origin_{};
};

}  // namespace bp
