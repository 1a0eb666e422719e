#pragma once
#include <vector>

#include "lib/core/disjoint_sets.h"
#include "lib/volume/detail/empty_runs.h"

/// Connected components of the empty voxels of one tile.
namespace bp::detail {

/// The components of one tile. Components that touch a face are numbered 0, 1, ... by first appearance in the scan. The
/// others are enclosed already.
struct Components {
  DisjointSets forest;
  std::vector<std::uint8_t> at_face;   ///< by provisional label
  std::vector<std::uint32_t> face_id;  ///< by provisional label; kNoLabel for enclosed ones
  std::uint32_t face_count = 0;
  bool any_inside = false;

  /// Numbers the components, after the scan.
  void number() {
    forest.flatten();
    for (std::uint32_t i = 0; i < forest.size(); ++i) at_face[forest.parent(i)] |= at_face[i];
    face_id.assign(forest.size(), kNoLabel);
    for (std::uint32_t i = 0; i < forest.size(); ++i) {
      const std::uint32_t root = forest.parent(i);
      if (root == i && at_face[i] != 0) face_id[i] = face_count++;
      if (root == i && at_face[i] == 0) any_inside = true;
      face_id[i] = face_id[root];
    }
  }
};

/// Makes the first scan; visit() as in scan().
template <class Visit>
void find_components(const BitBox& solid, const VoxelBox& tile, Components& c, const Visit& visit) {
  const VoxelCoord size = tile.size();
  scan(
      solid, tile,
      [&] {
        c.at_face.push_back(0);
        return c.forest.add();
      },
      [&](std::uint32_t a, std::uint32_t b) { c.forest.unite(a, b); },
      [&](const Run& run, std::int32_t y, std::int32_t z) {
        const bool face = run.begin == 0 || run.end == size.x || y == 0 || y == size.y - 1 || z == 0 || z == size.z - 1;
        if (face) {
          c.at_face[run.label] = 1;
          visit(run, y, z);
        }
      });
  c.number();
}

}  // namespace bp::detail
