#include "tools/lod/scene/tileset_memory.h"

#include <algorithm>
#include <utility>

#include "io/scene/scene_reader.h"
#include "lib/geometry/triangle_bvh.h"
#include "tools/lod/bake_levels.h"
#include "tools/lod/choices.h"
#include "tools/lod/leaves.h"

namespace bp {

std::uint64_t bytes_beside_tiles(std::uint64_t triangles) {
  return triangles * sizeof(TriangleD) + TriangleBvh::bytes_needed(triangles);
}

namespace {

/// Reads the scene once more, without holding it. Returns nothing if it cannot be read again.
std::vector<CellCounts> near_cells(const Build& build, const TilesetPlan& plan, const Cells& cells) {
  if (!can_read_again(build.options)) return {};
  std::vector<CellCounts> near(plan.cut.size());
  const auto source = open_scenes(build.options.voxels.scenes, build.scene_options(true));
  for (std::vector<TriangleD> chunk; source->read(chunk);) {
    for (const TriangleD& triangle : chunk) {
      for (std::size_t i = 0; i < near.size(); ++i) add_near(plan.cut[i], cells, bounds_of(triangle), near[i]);
    }
  }
  return near;
}

}  // namespace

TilesetMemory::TilesetMemory(Parts parts) : parts_(std::move(parts)) {
  if (!parts_.build.options.leaves) return;
  for (const BrickCoord c : parts_.scene.voxels.solid->coords())
    leaf_cells_.push_back(parts_.cut.cells.of(first_voxel(c)));
  std::sort(leaf_cells_.begin(), leaf_cells_.end());
  leaf_cells_.erase(std::unique(leaf_cells_.begin(), leaf_cells_.end()), leaf_cells_.end());
}

std::uint64_t TilesetMemory::operator()(const LodOptions& whole, BrickShelf& solid) const {
  return std::max(tileset_limit(count(whole), parts_.scene.voxels.header, solid), of_looks());
}

std::uint64_t TilesetMemory::operator()(const LodOptions& whole, TilePyramid& pyramid) const {
  return std::max(tileset_limit(count(whole), pyramid), of_looks());
}

TilesetCount TilesetMemory::count(const LodOptions& whole) const {
  const bool takes_scene = whole.mode == MeshMode::fit || whole.enclose == Enclose::scene;
  const std::uint64_t triangles = takes_scene ? parts_.scene.size.triangles : 0;
  const PassContext context = parts_.build.context(nullptr, parts_.share);
  TilesetCount count{parts_.plan, parts_.cut, whole, context, bytes_beside_tiles(triangles), triangles};
  if (triangles > 0 && !parts_.plan.cut.empty()) count.near = near_cells(parts_.build, parts_.plan, parts_.cut.cells);
  return count;
}

/// Returns the limit for the images and the leaves.
std::uint64_t TilesetMemory::of_looks() const {
  const std::uint64_t images = looks_limit(parts_.build, parts_.scene, kLooksBeside);
  if (leaf_cells_.empty()) return images;
  const LeafTask leaves{parts_.scene.voxels.header.frame, *parts_.looks, leaf_cells_, nullptr, nullptr};
  return std::max(images, leaves_limit(parts_.build, leaves));
}

}  // namespace bp
