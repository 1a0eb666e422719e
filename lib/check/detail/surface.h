#pragma once
#include "lib/check/detail/mesh_topology.h"
#include "lib/geometry/triangle_bvh.h"

/// The proxy as a surface in space: which triangles cross, which side a point is on. Exact.
namespace bp {

class Surface {
 public:
  /// Triangles of zero area are left out: they bound nothing. Keeps a reference to `mesh`.
  explicit Surface(const WeldedMesh& mesh);

  [[nodiscard]] const TriangleBvh& bvh() const { return bvh_; }
  /// Number in WeldedMesh::triangles of a triangle of bvh().
  [[nodiscard]] std::uint32_t triangle(std::uint32_t bvh_id) const { return triangle_[bvh_id]; }
  [[nodiscard]] Bounds3d bounds() const { return bounds_; }

  /// Every pair of triangles, of one component if `within_parts`, that meet beyond the corner or edge they share.
  /// O((n + pairs) log n) in practice, parallel.
  [[nodiscard]] Finding self_intersections(std::size_t max_examples, bool within_parts = false) const;

  static constexpr std::int64_t kNone = -1;
  /// A triangle (of WeldedMesh) that `t` touches or crosses, or kNone. Beyond the domain of the predicates the exact
  /// ones of lib/exact/wide_predicates.h decide: finite coordinates will do.
  [[nodiscard]] std::int64_t touched_by(const TriangleD& t) const;

  /// Winding number of the surface around p, which must not lie on it (there, an arbitrary but fixed side). Triangles
  /// of component `ignored` do not count. Means something only if every edge is used equally often in both directions.
  [[nodiscard]] int winding(const Vec3d& p, std::uint32_t ignored = kNoComponent) const;
  static constexpr std::uint32_t kNoComponent = std::uint32_t(-2);

 private:
  const WeldedMesh& mesh_;
  std::vector<std::uint32_t> triangle_;
  Bounds3d bounds_;
  TriangleBvh bvh_;
};

/// Closed components that nothing surrounds must have a positive signed volume, decided exactly. Needs a closed,
/// oriented mesh.
[[nodiscard]] Finding inverted_components(const WeldedMesh& mesh, const Surface& surface, std::size_t max_examples);

}  // namespace bp
