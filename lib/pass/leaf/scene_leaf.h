#pragma once
#include <string>
#include <vector>

#include "lib/pass/bake/scene_looks.h"
#include "lib/pass/leaf/leaf_part.h"

/// Pieces of the scene itself: its own triangles, cut by the faces of boxes (docs/decisions/0025-leaves.md).
namespace bp {

struct SceneLeaf {
  Vec3d origin{};
  double unit = 0;  ///< scene units
  std::vector<LeafPart> parts;
  Bounds3d bounds;  ///< of the vertices, scene units
  [[nodiscard]] std::uint64_t triangles() const;
};

/// Returns the triangles of all parts, scene units.
[[nodiscard]] std::vector<TriangleD> world_triangles(const SceneLeaf& leaf);

/// A box, and its octants from the cell down to it, one digit each (octant_of()).
struct LeafBox {
  Bounds3d box;
  std::string path;
  std::uint64_t triangles = 0;  ///< triangles of the scene that meet it, by their bounds
};

/// The triangles that meet a leaf, at most, unless smaller boxes do not help.
constexpr std::uint64_t kMostLeafTriangles = std::uint64_t(1) << 16;

/// Memory while a leaf is cut and written. Triangles around it count, too.
constexpr std::uint64_t kLeafBytesPerTriangle = 1000;

/// A box, and those of its octants that have triangles, if it has too many itself.
struct LeafTree {
  LeafBox box;
  std::vector<LeafTree> octants;
};
/// Divides a box into octants, and these again, until none has more than `most` triangles or it does not help: if too
/// many of them reach into several octants.
[[nodiscard]] LeafTree leaf_tree(const SceneLooks& looks, const Bounds3d& cell, std::uint64_t most);
/// Returns a cell, or octants of it that have few enough triangles; nothing if there are no triangles.
[[nodiscard]] std::vector<LeafBox> leaf_boxes(const SceneLooks& looks, const Bounds3d& cell);

/// Returns the unit of the lattice of all leaves of cells with `edge_vox` voxels of `voxel`: float32 holds half a cell
/// in it.
[[nodiscard]] double leaf_unit(double voxel, std::int32_t edge_vox);
/// Returns a bound on how far a vertex of a leaf lies from its place in the scene.
[[nodiscard]] double leaf_error(double unit);

/// Adds everything that decides cut_leaf().
void add_leaf_to(KeyHash& hash, const SceneLooks& looks, const Bounds3d& box);

/// Returns the scene in the closed box. Where the scene has no normals, those of faces that meet at less than
/// kCreaseDegrees are joined. The result does not depend on the order of the scene's triangles. Memory:
/// kLeafBytesPerTriangle for each of LeafBox::triangles.
[[nodiscard]] SceneLeaf cut_leaf(const SceneLooks& looks, const Bounds3d& box, double unit);

}  // namespace bp
