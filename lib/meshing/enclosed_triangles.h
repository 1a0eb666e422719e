#pragma once
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/meshing/enclosed.h"

namespace bp {

/// The triangles of a scene, in scene units and exactly as read: the proxy must not even touch them. All in memory: 72
/// bytes each and about 80 for the tree. `frame` is the proxy's; its vertices are exact doubles, so the predicates on
/// doubles are exact too.
class EnclosedTriangles : public Enclosed {
 public:
  EnclosedTriangles(std::vector<TriangleD> triangles, const GridFrame& frame);
  [[nodiscard]] bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                            Blocker* blocker) const override;
  [[nodiscard]] std::vector<Vec3d> contact_points(const LatticeCoord& origin) const override;
  [[nodiscard]] std::uint64_t bytes() const override;

 private:
  [[nodiscard]] bool blocks(std::uint32_t triangle, Blocker* blocker) const;
  std::vector<TriangleD> triangles_;
  GridFrame frame_;
  BoxTree tree_;
};

}  // namespace bp
