#pragma once
#include "lib/check/detail/mesh_topology.h"
#include "lib/geometry/triangle_bvh.h"

/// The proxy as a surface in space: tells which triangles cross, and on which side a point lies. Exact.
namespace bp {

class Surface {
 public:
  /// Leaves out triangles of zero area, which bound nothing. Keeps a reference to `mesh`.
  explicit Surface(const WeldedMesh& mesh);

  [[nodiscard]] const TriangleBvh& bvh() const { return bvh_; }
  /// Returns the number in WeldedMesh::triangles of a triangle of bvh().
  [[nodiscard]] std::uint32_t triangle(std::uint32_t bvh_id) const { return triangle_[bvh_id]; }
  [[nodiscard]] Bounds3d bounds() const { return bounds_; }

  /// Finds every pair of triangles (of one component if `within_parts`) that meet beyond the corner or edge they share.
  /// O((n + pairs) log n) in practice, parallel. If too many boxes overlap, nothing is counted, and `at_least` is set.
  [[nodiscard]] Finding self_intersections(std::size_t max_examples, bool within_parts = false) const;

  static constexpr std::int64_t kNone = -1;
  /// Returns a triangle (of WeldedMesh) that `t` touches or crosses, or kNone. Beyond the domain of the predicates,
  /// lib/exact/wide_predicates.h decides exactly: all finite coordinates are allowed.
  [[nodiscard]] std::int64_t touched_by(const TriangleD& t) const;

  /// Returns the winding number of the surface around p, which must not lie on it (the side is arbitrary but fixed
  /// there). Triangles of component `ignored` do not count. Meaningful only if every edge is used equally often in both
  /// directions.
  [[nodiscard]] int winding(const Vec3d& p, std::uint32_t ignored = kNoComponent) const;
  static constexpr std::uint32_t kNoComponent = std::uint32_t(-2);

 private:
  const WeldedMesh& mesh_;
  std::vector<std::uint32_t> triangle_;
  Bounds3d bounds_;
  TriangleBvh bvh_;
};

/// Finds closed components that nothing surrounds and whose signed volume is not positive, exactly. The mesh must be
/// closed and oriented.
[[nodiscard]] Finding inverted_components(const WeldedMesh& mesh, const Surface& surface, std::size_t max_examples);

}  // namespace bp
