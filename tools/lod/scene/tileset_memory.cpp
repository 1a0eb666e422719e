#include "tools/lod/scene/tileset_memory.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
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

/// The number of triangles near each cell of the cut levels, by the bounds of the triangles.
class NearCells {
 public:
  NearCells(const TilesetPlan& plan, const Cells& cells) : plan_(plan), cells_(cells), counts_(plan.cut.size()) {}

  void add(const TriangleD& triangle) {
    const Bounds3d bounds = bounds_of(triangle);
    for (std::size_t level = 0; level < counts_.size(); ++level) add(bounds, plan_.cut[level], counts_[level]);
  }
  [[nodiscard]] std::uint64_t operator()(std::size_t level, CellCoord cell) const {
    const Counts& counts = counts_[level];
    const auto found = counts.of_cell.find(cell);
    return counts.everywhere + (found != counts.of_cell.end() ? found->second : 0);
  }

 private:
  struct Counts {
    std::map<CellCoord, std::uint64_t> of_cell;
    std::uint64_t everywhere = 0;  // triangles that lie near very many cells
  };

  void add(const Bounds3d& bounds, const CutLevel& level, Counts& counts) const {
    constexpr std::int64_t kVeryMany = 512;
    const double voxel = level.frame.voxel;
    const Vec3d origin = level.frame.world_origin();
    const std::int32_t reach = tile_reach(level.scale_world, voxel) + 1;  // and a voxel for rounding
    const auto cell_of = [&](const Vec3d& p, std::int32_t by) {
      VoxelCoord v;
      for (int i = 0; i < 3; ++i)
        v[i] =
            std::int32_t(std::clamp(std::floor((p[std::size_t(i)] - origin[std::size_t(i)]) / voxel), -1e9, 1e9)) + by;
      return cells_.of(v);
    };
    const CellCoord first = cell_of(bounds.min, -reach), last = cell_of(bounds.max, reach);
    const std::int64_t many = (std::int64_t(last.x) - first.x + 1) * (std::int64_t(last.y) - first.y + 1) *
                              (std::int64_t(last.z) - first.z + 1);
    if (many > kVeryMany) {
      ++counts.everywhere;
      return;
    }
    for (std::int32_t z = first.z; z <= last.z; ++z)
      for (std::int32_t y = first.y; y <= last.y; ++y)
        for (std::int32_t x = first.x; x <= last.x; ++x) ++counts.of_cell[{x, y, z}];
  }

  const TilesetPlan& plan_;
  const Cells cells_;
  std::vector<Counts> counts_;
};

/// Reads the scene once more, without holding it. Returns nothing if it cannot be read again.
std::function<std::uint64_t(std::size_t, CellCoord)> near_cells(const Build& build, const TilesetPlan& plan,
                                                                const Cells& cells) {
  if (!can_read_again(build.options)) return {};
  const auto near = std::make_shared<NearCells>(plan, cells);
  const auto source = open_scenes(build.options.voxels.scenes, build.scene_options(true));
  for (std::vector<TriangleD> chunk; source->read(chunk);)
    for (const TriangleD& triangle : chunk) near->add(triangle);
  return [near](std::size_t level, CellCoord cell) { return (*near)(level, cell); };
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
