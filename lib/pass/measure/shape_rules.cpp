#include "lib/pass/measure/shape_rules.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <set>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/tile_grid.h"
#include "lib/volume/cell_boxes.h"
#include "lib/volume/openings.h"

namespace bp {

namespace {

constexpr std::size_t kMostBoxes = 4096;
constexpr double kMostCells = 1 << 28;          // bits of all levels: 32 MiB
constexpr double kBoxesAtWork = 10;             // boxes at work in openings(), each of a tile and its halo
constexpr double kLargestBelow = 15. / 16;      // the largest scale with a reach of r is r and this
constexpr std::int32_t kMostScaleReach = 4094;  // voxels; the largest reach of a scale

std::int32_t longest_side(const VoxelBox& box) {
  const VoxelCoord size = box.size();
  return std::max({size.x, size.y, size.z});
}

/// A rule in voxels.
struct Reaches {
  std::int32_t thin = 0;             ///< h of thin_parts(); 0: all parts count
  std::int32_t closes = -1;          ///< reach of the free cubes that keep a place open; -1: no place closes
  std::vector<std::int32_t> levels;  ///< for openings(); empty: no opening is kept
  std::vector<std::int32_t> scales;  ///< scale of each level, voxels, without kLargestBelow
  /// Returns how many voxels around a tile decide about it.
  [[nodiscard]] std::int32_t halo() const {
    const std::int32_t widest = levels.empty() ? 0 : levels[0];
    return std::max({4 * widest + 1, thin > 0 ? 2 * widest + 1 + 4 * thin : 0, 2 * closes, 1});
  }
  /// Returns how far a voxel may lie from the solid and still be marked.
  [[nodiscard]] std::int32_t farthest() const { return std::max(2 * (levels.empty() ? 0 : levels[0]), closes) + 1; }
  /// Returns how far beyond the solid's bounding box marks may lie: farther out, cubes of every reach are free.
  [[nodiscard]] std::int32_t outermost() const { return std::max(levels.empty() ? 0 : levels[0], closes) + 1; }
};

/// Returns a rule in voxels. `longest_side` is that of the scene.
Reaches reaches_of(const ShapeRule& rule, const ScaleField& before, const GridFrame& frame, std::int32_t longest_side) {
  Reaches r;
  const double length_vox = std::min(rule.length / frame.voxel, 4. * kMostScaleReach);
  std::int32_t least = 0, most = cube_radius(before.upper_bound(frame));
  if (rule.kind == ShapeRule::Kind::thickness) {
    // A part touches two voxels more than it is thick, and none is thicker than all.
    r.thin = std::min(std::int32_t(std::ceil(length_vox / 2)) + 1, longest_side);
    least = cube_radius(scale_of(rule.least, frame));
  } else {
    least = std::int32_t(std::max(length_vox - 1, 0.0) / 2);  // a gap leaves one free voxel less than it is wide
    const bool closed_anyway = before.constant() && before.base >= (least + kLargestBelow) * frame.voxel;
    if (rule.mode != ScaleMode::decrease && !closed_anyway) {
      if (least >= kMostScaleReach)
        fail(ErrorCode::bad_argument, {Remedy::larger_voxels}, "a gap of {} is more than {} voxels", rule.length,
             2 * kMostScaleReach);
      r.closes = least;
      most = std::max(most, least);
    }
    if (rule.mode == ScaleMode::increase) return r;
  }
  if (least >= most) return r;
  for (std::int32_t scale = least; r.levels.empty() || 2 * scale < most; scale = std::max(scale + 1, scale * 3 / 2)) {
    r.levels.push_back(r.levels.empty() ? least : 2 * scale);
    r.scales.push_back(scale);
  }
  r.levels.push_back(most);
  r.scales.push_back(most);
  std::reverse(r.levels.begin(), r.levels.end());
  std::reverse(r.scales.begin(), r.scales.end());
  return r;
}

/// Returns the tiles with a voxel that lies within `reach_vox` of a solid brick.
std::vector<TileCoord> tiles_in_reach(const BrickShelf& solid, const TileGrid& grid, std::int32_t reach_vox) {
  std::set<TileCoord> tiles;
  for (const BrickCoord brick : solid.coords()) {
    const VoxelBox reach = intersect(voxels_of(brick).grown(reach_vox), grid.voxels);
    for_each(grid.tiles_of(reach), [&](TileCoord t) { tiles.insert(t); });
  }
  return {tiles.begin(), tiles.end()};
}

/// Returns whether the part of a cell in a tile holds a voxel. `step`: edge of the cells, voxels.
bool any_in_cell(VoxelCoord cell, std::int32_t step, const BitBox& voxels, const VoxelBox& tile) {
  const VoxelCoord first = cell * step;
  const VoxelBox box = intersect(VoxelBox{first, {first.x + step, first.y + step, first.z + step}}, tile);
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t y = box.min.y; y < box.max.y; ++y) {
      const std::uint64_t* row = voxels.row(y, z);
      for (std::int32_t x = box.min.x; x < box.max.x; x += 8) {  // a byte of a row lies in one cell
        const std::int32_t at = x - voxels.box().min.x;
        if ((row[at >> 6] >> (at & 63) & 0xff) != 0) return true;
      }
    }
  }
  return false;
}

VoxelBox cells_of(const VoxelBox& voxels, std::int32_t step) {
  VoxelBox cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.min[axis] = floor_div(voxels.min[axis], step);
    cells.max[axis] = ceil_div(voxels.max[axis], step);
  }
  return cells;
}

class ShapeMeasurer {
 public:
  ShapeMeasurer(const StreamHeader& header, const BrickShelf& solid, const ShapeRule& rule, const Reaches& reaches,
                const MeasureOptions& options)
      : header_(header),
        solid_(solid),
        rule_(rule),
        reaches_(reaches),
        options_(options),
        space_(voxels_of(bricks_of(voxels_of(header.bricks).grown(reaches.outermost())))) {}

  std::vector<ScaleRule> operator()() {
    lay_cells();
    const int at_work = lay_tiles();
    const std::vector<TileCoord> tiles = tiles_in_reach(solid_, tiles_, reaches_.farthest());
    std::size_t next = 0, done = 0;
    options_.context.report("measuring", "tiles", 0, tiles.size());
    pipeline<TileCoord>(
        at_work,
        [&](TileCoord& tile) {
          if (next == tiles.size()) return false;
          tile = tiles[next++];
          return true;
        },
        [&](const TileCoord& tile) { measure(tiles_.box(tile)); },
        [&](const TileCoord&) { options_.context.report("measuring", "tiles", ++done, tiles.size()); });
    return rules();
  }

 private:
  /// Lays the cells of the samples, or larger ones if there would be too many.
  void lay_cells() {
    const std::size_t levels = std::max<std::size_t>(reaches_.levels.size(), 1);
    while (double(space_.volume()) / std::pow(step_, 3) * double(levels) > kMostCells) step_ *= 2;
    cells_.assign(levels, BitBox(cells_of(space_, step_)));
  }
  /// Returns the bytes of all levels, and of few_boxes_of() for one level.
  [[nodiscard]] double cell_bytes() const {
    return 8 * double(cells_[0].word_count()) * double(cells_.size() + 2) + 2 * kMostBoxes * sizeof(VoxelBox);
  }

  /// Returns how many tiles are at work at once.
  int lay_tiles() {
    const double cells = cell_bytes(), memory = double(options_.context.memory.bytes);
    const auto bytes_of = [&](std::int32_t tile) { return kBoxesAtWork * box_volume(tile) / 8; };
    std::int32_t edge = kBrickEdge;
    double best = 0;
    for (std::int32_t tile = kBrickEdge; tile < 2 * longest_side(space_); tile *= 2) {
      const double tiles = TileGrid(space_, tile).total(), fit = std::floor((memory - cells) / bytes_of(tile));
      const double speed = std::min({fit, double(thread_count()), tiles}) / (tiles * box_volume(tile));
      if (speed > best) edge = tile;
      best = std::max(best, speed);
    }
    if (options_.tile_vox > 0) edge = options_.tile_vox;
    const double bytes = bytes_of(edge);
    if (cells + bytes > memory) {
      const MemoryShare& share = options_.context.memory;
      const auto needed = std::uint64_t(cells + bytes);
      throw NeedsMemory(fmt::format("measuring a tile of {} voxels with a halo of {}", edge, reaches_.halo()), needed,
                        share.bytes, share.limit_with(needed - share.bytes),
                        {Remedy::larger_voxels, Remedy::smaller_scale});
    }
    tiles_ = TileGrid(space_, edge);
    return int(std::clamp((memory - cells) / bytes, 1.0, double(thread_count())));
  }
  /// Returns the voxels of the largest box of a tile and its halo, in whole words.
  [[nodiscard]] double box_volume(std::int32_t tile) const {
    const auto side = [&](int axis) { return std::min(tile + 2.0 * reaches_.halo(), double(space_.size()[axis])); };
    return (side(0) + 64) * side(1) * side(2);
  }

  void measure(const VoxelBox& tile) {
    BitBox solid(intersect(tile.grown(reaches_.halo()), space_));
    load_voxels(solid_, solid);
    if (reaches_.closes > 0) mark(0, narrow_places(solid, reaches_.closes), tile);
    if (reaches_.levels.empty()) return;
    BitBox thin;
    if (reaches_.thin > 0) thin = thin_parts(solid, reaches_.thin);
    if (reaches_.thin > 0 && thin.count() == 0) return;
    openings(solid, reaches_.thin > 0 ? &thin : nullptr, reaches_.levels, tile,
             [&](std::size_t level, const BitBox& voxels) { mark(level, voxels, tile); });
  }

  /// Marks the cells of the voxels in the tile.
  void mark(std::size_t level, const BitBox& voxels, const VoxelBox& tile) {
    std::vector<VoxelCoord> cells;
    for_each(cells_of(tile, step_), [&](VoxelCoord c) {
      if (any_in_cell(c, step_, voxels, tile)) cells.push_back(c);
    });
    const std::lock_guard lock(mutex_);
    for (const VoxelCoord& c : cells) cells_[level].set(c);
  }

  [[nodiscard]] std::vector<ScaleRule> rules() const {
    std::vector<ScaleRule> rules;
    const std::size_t most = kMostBoxes / cells_.size();
    for (std::size_t level = 0; level < cells_.size(); ++level) {
      const bool closes = level == 0;
      const std::int32_t reach = closes ? reaches_.closes : reaches_.scales[level];
      const FewBoxes few = few_boxes_of(cells_[level], most);
      for (const VoxelBox& box : few.boxes) {
        ScaleRule& rule = rules.emplace_back();
        rule.shape = ScaleShape::box;
        rule.mode = closes ? ScaleMode::increase : ScaleMode::decrease;
        rule.points = {sample_at(box.min, few.unit), sample_at(box.max, few.unit)};
        rule.scale = (reach + kLargestBelow) * header_.frame.voxel;
        rule.name = rule_.name;
      }
    }
    return rules;
  }

  /// Returns the sample at the least corner of a cell. Everything between the samples of a box has its scale.
  [[nodiscard]] Vec3d sample_at(VoxelCoord cell, std::int32_t unit) const {
    const auto along = [&](std::int32_t c) {
      return std::int64_t(c) * unit * step_ * kLatticePerVoxel + kLatticePerVoxel / 2;
    };
    return header_.frame.world({along(cell.x), along(cell.y), along(cell.z)});
  }

  const StreamHeader& header_;
  const BrickShelf& solid_;
  const ShapeRule& rule_;
  const Reaches& reaches_;
  const MeasureOptions& options_;
  const VoxelBox space_;            // whole bricks
  TileGrid tiles_;                  // tiles of `space_`
  std::int32_t step_ = kScaleStep;  // edge of the cells, voxels
  std::vector<BitBox> cells_;       // of each level; level 0 holds the places that close
  std::mutex mutex_;
};

}  // namespace

std::vector<ScaleRule> shape_rules(const StreamHeader& header, const BrickShelf& solid, const ShapeRule& rule,
                                   const ScaleField& before, const MeasureOptions& options) {
  if (header.bricks.empty()) return {};
  const Reaches reaches = reaches_of(rule, before, header.frame, longest_side(voxels_of(header.bricks)));
  if (reaches.levels.empty() && reaches.closes <= 0) return {};
  return ShapeMeasurer(header, solid, rule, reaches, options)();
}

ScalePlan measured(const ScalePlan& plan, const StreamHeader& header, const BrickShelf& solid,
                   const MeasureOptions& options) {
  ScalePlan out = plan;
  std::vector<ScaleRule>& rules = out.field.rules;
  rules.clear();
  auto next = plan.field.rules.begin();
  for (RuleEntry& entry : out.entries) {
    std::vector<ScaleRule> more;
    if (entry.shape) {
      more = shape_rules(header, solid, *entry.shape, out.field, options);
    } else {
      more.assign(next, next + std::ptrdiff_t(entry.rules));
    }
    next += std::ptrdiff_t(entry.rules);
    entry.rules = more.size();
    rules.insert(rules.end(), more.begin(), more.end());
  }
  return out;
}

}  // namespace bp
