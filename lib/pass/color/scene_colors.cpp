#include "lib/pass/color/scene_colors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/pass/color/detail/color_grid.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

constexpr std::int64_t kCellLattice = std::int64_t(kColorCellVox) * kLatticePerVoxel;
constexpr double kEnough = 1.0 / 16;          // of a cell's area; a ninth of a ball's surface looks any one way
constexpr std::size_t kSumsInHand = 1 << 16;  // a large triangle alone may cover millions of cells

static_assert(ColorGrid::kEdge * kColorCellVox == kBrickEdge, "a brick of cells is a brick of voxels");

/// Returns what is seen of the cells of a brick. `shelf` has the outermost voxels. A face that lies between two layers
/// of voxels fills both, and its samples fall into the upper one; but the lower one alone may be outermost. So a cell
/// is seen if it holds a voxel, or has one right below it along some axis.
ColorGrid::Mask mask_of(const BrickShelf& shelf, ColorBrick coord) {
  constexpr std::int32_t e = ColorGrid::kEdge, n = kColorCellVox;
  const VoxelCoord first = first_voxel(BrickCoord{coord.x, coord.y, coord.z}), one{1, 1, 1};
  BitBox bits(VoxelBox{first - one, first + VoxelCoord{kBrickEdge, kBrickEdge, kBrickEdge}});
  load_voxels(shelf, bits);
  auto mask = std::make_shared<std::vector<std::uint32_t>>(std::size_t(e) * e * e);
  // Marks the cells at the voxels (y, z) that hold a voxel of the row with `seen`, and with so many times the row's
  // voxels in them.
  const auto mark = [&](std::int32_t y, std::int32_t z, std::uint64_t row, std::uint32_t seen, std::uint32_t times) {
    if (y < 0 || z < 0 || y >= kBrickEdge || z >= kBrickEdge) return;
    for (std::int32_t x = 0; x < e; ++x)
      if (const auto here = std::uint32_t(row >> (n * x) & ((1 << n) - 1)); here != 0)
        (*mask)[std::size_t(x + e * (y / n + e * (z / n)))] |= seen | times * here;
  };
  const auto layer = [](int axis, std::int32_t i) { return std::uint32_t(1) << (n * axis + (i + n) % n); };
  for (std::int32_t z = -1; z < kBrickEdge; ++z) {
    for (std::int32_t y = -1; y < kBrickEdge; ++y) {
      const std::uint64_t* const words = bits.row(first.y + y, first.z + z);
      const std::uint64_t above = words[1] << 1 | words[0] >> 63, row = words[1] | above;
      if (row == 0) continue;
      for (const auto& [dy, dz] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}})
        mark(y + dy, z + dz, row, ColorGrid::kSeen, 0);
      mark(y, z, words[1], layer(1, y) | layer(2, z), 1);
      mark(y, z, above, 0, ColorGrid::kAbove);
      mark(y + 1, z, words[1], ColorGrid::kAbove * layer(1, y + 1), 0);
      mark(y, z + 1, words[1], ColorGrid::kAbove * layer(2, z + 1), 0);
    }
  }
  return [mask, coord](ColorCell c) { return (*mask)[ColorGrid::index_in(coord, c)]; };
}

/// Returns the cells that belong to a box of voxels grown by a margin.
std::pair<ColorCell, ColorCell> cells_of(const VoxelBox& box, std::int32_t margin, const Vec3d& origin) {
  ColorCell lo, hi;
  for (int i = 0; i < 3; ++i) {
    const double shift = origin[std::size_t(i)];
    lo[i] = std::int32_t(std::floor((double(box.min[i] - margin) * kLatticePerVoxel - shift) / double(kCellLattice)));
    hi[i] = std::int32_t(std::ceil((double(box.max[i] + margin) * kLatticePerVoxel - shift) / double(kCellLattice)));
  }
  return {lo, hi};
}

std::uint32_t weight_of(const ColorSum& sum) {
  return std::uint32_t(std::min<std::uint64_t>(sum.weight, std::numeric_limits<std::uint32_t>::max()));
}

/// Returns the mean of the sides of a cell, by their shares. If that is less area than kEnough of the cell's, all sides
/// count for the rest: among shares that are nearly 0, rounding or a tree's twig would choose one side.
template <class Shares>
LinearColor mean_of(std::span<const CellColor> sides, const Shares& shares) {
  std::array<double, 4> sum{}, plain{};
  for (const CellColor& c : sides) {
    const std::array<double, 4> one{double(c.color.r), double(c.color.g), double(c.color.b), 1};
    for (std::size_t i = 0; i < 4; ++i) {
      sum[i] += shares[c.side] * c.weight * one[i];
      plain[i] += c.weight * one[i];
    }
  }
  const double lack = plain[3] > 0 ? std::max(0.0, kEnough - sum[3] / plain[3]) : 0;
  for (std::size_t i = 0; i < 4; ++i) sum[i] += lack * plain[i];
  return {std::uint16_t(sum[0] / sum[3] + 0.5), std::uint16_t(sum[1] / sum[3] + 0.5),
          std::uint16_t(sum[2] / sum[3] + 0.5)};
}

}  // namespace

NearbyColors::Cells::Cells(std::vector<CellColor> all) : sides(std::move(all)) {
  std::sort(sides.begin(), sides.end(),
            [](const CellColor& a, const CellColor& b) { return std::tie(a.cell, a.side) < std::tie(b.cell, b.side); });
  for (std::size_t i = 0; i < sides.size(); ++i) first.try_emplace(sides[i].cell, std::uint32_t(i));
}

NearbyColors::Cells NearbyColors::Cells::halved() const {
  std::map<std::pair<ColorCell, std::uint16_t>, ColorSum> sums;
  for (const CellColor& c : sides) {
    const std::uint64_t w = c.weight;
    sums[{ColorGrid::half_of(c.cell), c.side}].add({w, w * c.color.r, w * c.color.g, w * c.color.b});
  }
  std::vector<CellColor> all;
  for (const auto& [key, sum] : sums) all.push_back({key.first, sum.mean(), key.second, weight_of(sum)});
  return Cells(std::move(all));
}

std::span<const CellColor> NearbyColors::Cells::at(ColorCell cell) const {
  const auto found = first.find(cell);
  if (found == first.end()) return {};
  std::size_t end = found->second;
  while (end < sides.size() && sides[end].cell == cell) ++end;
  return std::span(sides).subspan(found->second, end - found->second);
}

NearbyColors::NearbyColors(std::vector<CellColor> cells, ColorCell min, const Vec3d& origin)
    : min_(min), origin_(origin) {
  if (cells.empty()) return;
  for (CellColor& c : cells) c.cell = c.cell - min_;
  levels_.emplace_back(std::move(cells));
  while (levels_.back().first.size() > 1) levels_.push_back(levels_.back().halved());
}

/// Returns how much each side counts for a normal: 1 along it, 0 across it, little at an angle of 60 degrees.
NearbyColors::Shares NearbyColors::shares_along(const Vec3d& normal) {
  Shares shares{};
  const double squared = dot(normal, normal);
  for (std::size_t i = 0; i < shares.size() && squared > 0; ++i) {
    const auto& [x, y, z] = kColorSides[i];
    const double along = x * normal[0] + y * normal[1] + z * normal[2];
    const double cosine = along * along / (squared * (x * x + y * y + z * z));  // squared
    shares[i] = cosine * cosine * cosine * cosine;
  }
  return shares;
}

/// Returns the nearest cell with enough area that looks the right way; if there is none, the nearest of all.
std::span<const CellColor> NearbyColors::nearest(const Cells& cells, const Vec3d& p, const Shares& shares) {
  const ColorCell own{std::int32_t(std::floor(p[0])), std::int32_t(std::floor(p[1])), std::int32_t(std::floor(p[2]))};
  const auto looks_there = [&](std::span<const CellColor> cell) {
    double area = 0, all = 0;
    for (const CellColor& c : cell) area += shares[c.side] * c.weight, all += c.weight;
    return area >= kEnough * all;
  };
  const std::span<const CellColor> here = cells.at(own);
  if (!here.empty() && looks_there(here)) return here;
  std::span<const CellColor> best = here;
  std::pair<bool, double> least{true, here.empty() ? std::numeric_limits<double>::max() : 0};
  for (std::int32_t z = own.z - 1; z <= own.z + 1; ++z) {
    for (std::int32_t y = own.y - 1; y <= own.y + 1; ++y) {
      for (std::int32_t x = own.x - 1; x <= own.x + 1; ++x) {
        const std::span<const CellColor> cell = cells.at({x, y, z});
        if (cell.empty()) continue;
        const Vec3d d{x + 0.5 - p[0], y + 0.5 - p[1], z + 0.5 - p[2]};
        const std::pair<bool, double> distance{!looks_there(cell), dot(d, d)};
        if (distance >= least) continue;  // the first of equal ones wins
        best = cell;
        least = distance;
      }
    }
  }
  return best;
}

LinearColor NearbyColors::at(const Vec3d& lattice, const Vec3d& normal) const {
  if (levels_.empty()) return kWhite;
  const Shares shares = shares_along(normal);
  Vec3d p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = (lattice[i] - origin_[i]) / double(kCellLattice) - min_[int(i)];
  for (const Cells& cells : levels_) {
    if (const auto found = nearest(cells, p, shares); !found.empty()) return mean_of(found, shares);
    for (double& x : p) x /= 2;
  }
  return mean_of(levels_.back().sides, shares);
}

void NearbyColors::add_to(KeyHash& hash) const {
  hash.add(levels_.empty() ? std::vector<CellColor>{} : levels_.front().sides);
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

/// Returns the corner of cell (0,0,0), which is that of the finest level's voxel (0,0,0), in lattice units of `level`.
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
