#include "lib/pass/color/scene_colors.h"

#include <algorithm>
#include <bitset>
#include <cmath>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/pass/color/detail/color_grid.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

constexpr std::int64_t kCellLattice = std::int64_t(kColorCellVox) * kLatticePerVoxel;
constexpr std::size_t kSumsInHand = 1 << 16;  // a large triangle alone may cover millions of cells

static_assert(ColorGrid::kEdge * kColorCellVox == kBrickEdge, "a brick of cells is a brick of voxels");

/// Cells of a brick that hold a voxel of `shelf`, or have one right below them along some axes: a face that lies
/// between two layers of voxels fills both, its samples fall into the upper one, and the lower one may be all that is
/// outermost.
ColorGrid::Mask mask_of(const BrickShelf& shelf, ColorBrick coord) {
  constexpr std::int32_t e = ColorGrid::kEdge;
  const VoxelCoord first = first_voxel(BrickCoord{coord.x, coord.y, coord.z}), one{1, 1, 1};
  BitBox bits(VoxelBox{first - one, first + VoxelCoord{kBrickEdge, kBrickEdge, kBrickEdge}});
  load_voxels(shelf, bits);
  auto mask = std::make_shared<std::bitset<std::size_t(e) * e * e>>();
  const auto mark = [&](std::int32_t y, std::int32_t z, std::uint64_t row) {
    for (std::int32_t x = 0; y < e && z < e && x < e; ++x)
      if ((row >> (kColorCellVox * x) & ((1 << kColorCellVox) - 1)) != 0) mask->set(std::size_t(x + e * (y + e * z)));
  };
  for (std::int32_t z = -1; z < kBrickEdge; ++z) {
    for (std::int32_t y = -1; y < kBrickEdge; ++y) {
      const std::uint64_t* const words = bits.row(first.y + y, first.z + z);
      const std::uint64_t row = words[1] | words[1] << 1 | words[0] >> 63;
      if (row == 0) continue;
      const std::int32_t y0 = floor_div(y, kColorCellVox), z0 = floor_div(z, kColorCellVox);
      const std::int32_t y1 = floor_div(y + 1, kColorCellVox), z1 = floor_div(z + 1, kColorCellVox);
      for (std::int32_t cz = std::max(0, z0); cz <= z1; ++cz)
        for (std::int32_t cy = std::max(0, y0); cy <= y1; ++cy) mark(cy, cz, row);
    }
  }
  return [mask, coord](ColorCell c) { return mask->test(ColorGrid::index_in(coord, c)); };
}

/// Cells that belong to one of a box of voxels grown by a margin.
std::pair<ColorCell, ColorCell> cells_of(const VoxelBox& box, std::int32_t margin, const Vec3d& origin) {
  ColorCell lo, hi;
  for (int i = 0; i < 3; ++i) {
    const double shift = origin[std::size_t(i)];
    lo[i] = std::int32_t(std::floor((double(box.min[i] - margin) * kLatticePerVoxel - shift) / double(kCellLattice)));
    hi[i] = std::int32_t(std::ceil((double(box.max[i] + margin) * kLatticePerVoxel - shift) / double(kCellLattice)));
  }
  return {lo, hi};
}

}  // namespace

NearbyColors::NearbyColors(std::vector<CellColor> cells, ColorCell min, const Vec3d& origin)
    : cells_(std::move(cells)), min_(min), origin_(origin) {
  if (cells_.empty()) return;
  coarser_.emplace_back();
  for (const CellColor& c : cells_) coarser_[0][c.cell - min_] = {1, c.color.r, c.color.g, c.color.b};
  while (coarser_.back().size() > 1) {
    Cells next;
    for (const auto& [cell, sum] : coarser_.back()) next[ColorGrid::half_of(cell)].add(sum);
    coarser_.push_back(std::move(next));
  }
}

const ColorSum* NearbyColors::nearest(const Cells& cells, const Vec3d& p) {
  const ColorCell own{std::int32_t(std::floor(p[0])), std::int32_t(std::floor(p[1])), std::int32_t(std::floor(p[2]))};
  if (const auto at = cells.find(own); at != cells.end()) return &at->second;
  const ColorSum* best = nullptr;
  double least = 0;
  for (std::int32_t z = own.z - 1; z <= own.z + 1; ++z) {
    for (std::int32_t y = own.y - 1; y <= own.y + 1; ++y) {
      for (std::int32_t x = own.x - 1; x <= own.x + 1; ++x) {
        const auto at = cells.find({x, y, z});
        if (at == cells.end()) continue;
        const Vec3d d{x + 0.5 - p[0], y + 0.5 - p[1], z + 0.5 - p[2]};
        const double distance = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        if (best != nullptr && distance >= least) continue;  // among equals the first
        best = &at->second;
        least = distance;
      }
    }
  }
  return best;
}

LinearColor NearbyColors::at(const Vec3d& lattice) const {
  if (cells_.empty()) return kWhite;
  Vec3d p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = (lattice[i] - origin_[i]) / double(kCellLattice) - min_[int(i)];
  for (const Cells& cells : coarser_) {
    if (const ColorSum* found = nearest(cells, p)) return found->mean();
    for (double& x : p) x /= 2;
  }
  return coarser_.back().begin()->second.mean();
}

void NearbyColors::add_to(KeyHash& hash) const {
  hash.add(cells_.size());
  for (const CellColor& c : cells_) hash.add(CellColor{c.cell - min_, c.color});
}

SceneColors::SceneColors(const GridFrame& frame, std::unique_ptr<ColorGrid> finest) : frame_(frame) {
  levels_.push_back(std::move(finest));
}

SceneColors::~SceneColors() = default;

std::uint64_t SceneColors::cells() const {
  return levels_.front()->cells();
}

void SceneColors::prepare(const GridFrame& level) {
  const std::size_t n = number_of(level);
  while (levels_.size() <= n) levels_.push_back(levels_.back()->reduced());
}

NearbyColors SceneColors::around(const GridFrame& level, const VoxelBox& box, std::int32_t margin_vox) const {
  const Vec3d origin = origin_in(level);
  const auto [lo, hi] = cells_of(box, margin_vox, origin);
  return NearbyColors(levels_.at(number_of(level))->load(lo, hi), lo, origin);
}

NearbyColors SceneColors::all(const GridFrame& level) const {
  const ColorGrid& grid = *levels_.at(number_of(level));
  const auto [lo, hi] = grid.bounds();
  return NearbyColors(grid.load(lo, hi), lo, origin_in(level));
}

std::size_t SceneColors::number_of(const GridFrame& level) const {
  const double times = level.voxel / frame_.voxel;
  const int n = std::ilogb(times);
  if (n < 0 || std::ldexp(1.0, n) != times) fail(ErrorCode::failed, "colours of voxels that are no reduction");
  return std::size_t(n);
}

/// Corner of cell (0,0,0): that of the finest level's voxel (0,0,0), in lattice units of `level`.
Vec3d SceneColors::origin_in(const GridFrame& level) const {
  const double times = level.voxel / frame_.voxel;
  Vec3d origin;
  for (std::size_t i = 0; i < 3; ++i)
    origin[i] = (double(frame_.origin[i]) / times - double(level.origin[i])) * kLatticePerVoxel;
  return origin;
}

std::unique_ptr<SceneColors> gather_colors(TriangleSource& source, const GridFrame& frame, const BrickShelf& solid,
                                           const PassContext& context) {
  struct Item {
    std::vector<TriangleD> triangles;
    std::vector<TriangleColors> colors;
  };
  auto grid = std::make_unique<ColorGrid>(context.make_scratch(), context.memory.bytes);
  std::uint64_t done = 0;
  source.rewind();
  pipeline<Item>(
      thread_count() + 2, [&](Item& item) { return source.read_colored(item.triangles, item.colors); },
      [&](Item& item) {
        std::vector<ColorCellSum> sums;
        for (std::size_t i = 0; i < item.triangles.size(); ++i) {
          TriangleD t = item.triangles[i];
          for (Vec3d& p : t) p = frame.to_voxels(p);
          add_colors(t, item.colors[i], sums);
          if (sums.size() > kSumsInHand) grid->add(sums);
        }
        grid->add(sums);
      },
      [&](Item& item) { context.report("colours", "triangles", done += item.triangles.size(), 0); });
  const auto boundary = context.make_shelf();
  boundary_layer(solid, *boundary);
  grid->finish([&](ColorBrick b) { return mask_of(*boundary, b); });
  if (grid->all_white()) return nullptr;
  return std::make_unique<SceneColors>(frame, std::move(grid));
}

}  // namespace bp
