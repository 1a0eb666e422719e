#include "tools/lod/scene/tileset_memory.h"

#include <algorithm>
#include <utility>

#include "lib/geometry/triangle_bvh.h"
#include "tools/lod/leaves.h"

namespace bp {

std::uint64_t bytes_beside_tiles(std::uint64_t triangles) {
  return triangles * sizeof(TriangleD) + TriangleBvh::bytes_needed(triangles);
}

TilesetMemory::TilesetMemory(Parts parts) : parts_(std::move(parts)) {
  if (!parts_.build.options.leaves) return;
  for (const BrickCoord c : parts_.scene.voxels.solid->coords())
    leaf_cells_.push_back(parts_.cut.cells.of(first_voxel(c)));
  std::sort(leaf_cells_.begin(), leaf_cells_.end());
  leaf_cells_.erase(std::unique(leaf_cells_.begin(), leaf_cells_.end()), leaf_cells_.end());
}

std::uint64_t TilesetMemory::operator()(const LodOptions& whole, BrickShelf& solid) const {
  return std::max(tileset_limit(count(whole), parts_.scene.voxels.header, solid), of_leaves());
}

std::uint64_t TilesetMemory::operator()(const LodOptions& whole, TilePyramid& pyramid) const {
  return std::max(tileset_limit(count(whole), pyramid), of_leaves());
}

TilesetCount TilesetMemory::count(const LodOptions& whole) const {
  const bool takes_scene = whole.mode == MeshMode::fit || whole.enclose == Enclose::scene;
  const std::uint64_t triangles = takes_scene ? parts_.scene.size.triangles : 0;
  const PassContext context = parts_.build.context(nullptr, parts_.share);
  return {parts_.plan, parts_.cut, whole, context, bytes_beside_tiles(triangles), triangles};
}

std::uint64_t TilesetMemory::of_leaves() const {
  if (leaf_cells_.empty()) return 0;
  return leaves_limit(parts_.build, {parts_.scene.voxels.header.frame, *parts_.looks, leaf_cells_, nullptr, nullptr});
}

}  // namespace bp
