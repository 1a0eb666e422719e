#include "lib/enclosed/enclosed_voxels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <tuple>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/enclosed/detail/cell_window.h"
#include "lib/enclosed/detail/outlines.h"
#include "lib/enclosed/detail/resting_points.h"
#include "lib/enclosed/detail/separator.h"

// Tetrahedra are separated from cubes by detail/separator.h: first from bricks, then from blocks of 8^3 voxels, then
// from voxels. detail/cell_window.h finds the bricks, blocks and voxels that a box meets. detail/resting_points.h finds
// the points that a proxy rests on.

namespace bp {

using namespace detail;

namespace {

constexpr std::size_t kCubeCorners = 8;  // corners of a blocker that is a voxel

/// Returns the occupied voxels of a brick with an empty one across one of their 6 faces.
BrickBits boundary_of(const BrickShelf& shelf, BrickCoord coord) {
  const VoxelCoord first = first_voxel(coord);
  BitBox bits({{first.x - 64, first.y - 1, first.z - 1}, {first.x + 128, first.y + 65, first.z + 65}});
  load_voxels(shelf, bits);
  BrickBits out;
  for (std::int32_t z = 0; z < kBrickEdge; ++z) {
    for (std::int32_t y = 0; y < kBrickEdge; ++y) {
      const auto row = [&](std::int32_t dy, std::int32_t dz) { return bits.row(first.y + y + dy, first.z + z + dz); };
      const std::uint64_t* r = row(0, 0);
      std::uint64_t& boundary = out[std::size_t(z * kBrickEdge + y)] = 0;
      if (r[1] == 0) continue;
      const std::uint64_t inner = ((r[1] << 1) | (r[0] >> 63)) & ((r[1] >> 1) | (r[2] << 63)) & row(-1, 0)[1] &
                                  row(1, 0)[1] & row(0, -1)[1] & row(0, 1)[1];
      boundary = r[1] & ~inner;
    }
  }
  return out;
}

/// Returns block b = 64 z + 8 y + x of a brick: bit 8 y + x of word z for each voxel.
std::array<std::uint64_t, 8> block_of(const BrickBits& bits, std::size_t b) {
  const std::size_t bx = b % 8, by = b / 8 % 8, bz = b / 64;
  std::array<std::uint64_t, 8> block{};
  for (std::size_t z = 0; z < 8; ++z) {
    for (std::size_t y = 0; y < 8; ++y)
      block[z] |= ((bits[(bz * 8 + z) * kBrickEdge + by * 8 + y] >> (8 * bx)) & 0xff) << (8 * y);
  }
  return block;
}

/// Returns all rows' bits, combined by OR, of the blocks b to b + 7, which follow each other along x.
std::uint64_t columns_of(const BrickBits& bits, std::size_t b) {
  std::uint64_t any = 0;
  for (std::size_t z = 0; z < 8; ++z) {
    for (std::size_t y = 0; y < 8; ++y) any |= bits[(b / 64 * 8 + z) * kBrickEdge + b / 8 % 8 * 8 + y];
  }
  return any;
}

LatticeCoord low_corner(VoxelCoord v) {
  return LatticeCoord{v.x, v.y, v.z} * kLatticePerVoxel;
}

Blocker cube(const LatticeCoord& low, std::int64_t edge) {
  Blocker b;
  b.count = kCubeCorners;
  for (int i = 0; i < int(kCubeCorners); ++i)
    b.points[std::size_t(i)] = to_double(low + LatticeCoord{i & 1, (i >> 1) & 1, i >> 2} * edge);
  return b;
}

/// Returns whether an open voxel and an open tetrahedron are disjoint. `low`: the voxel's low corner.
bool is_clear_of(const LatticeCoord& low, const Tetrahedron& t) {
  Separator separator(t);
  for (int i = 0; i < 3; ++i) {
    if (low[i] >= separator.box().max[i] || low[i] + kLatticePerVoxel <= separator.box().min[i]) return true;
  }
  return separator.separates(low, kLatticePerVoxel);
}

}  // namespace

EnclosedVoxels::EnclosedVoxels(const BrickShelf& shelf) : near_(shelf) {
  const std::vector<BrickCoord> coords = shelf.coords();
  struct Found {
    BoundaryBrick brick{};
    std::vector<Block> blocks;
    std::vector<VoxelCoord> points;
  };
  std::vector<Found> found(coords.size());
  parallel_for(std::int64_t(coords.size()), [&](std::int64_t i) {
    Found& f = found[std::size_t(i)];
    const BrickBits bits = boundary_of(shelf, coords[std::size_t(i)]);
    std::uint64_t columns = 0;
    for (std::size_t b = 0; b < 512; ++b) {
      if (b % 8 == 0) columns = columns_of(bits, b);
      if ((columns >> (8 * (b % 8)) & 0xff) == 0) continue;
      const Block block = block_of(bits, b);
      f.brick.blocks[b / 64] |= std::uint64_t(1) << b % 64;
      f.blocks.push_back(block);
    }
    f.points = resting_points_of(shelf, coords[std::size_t(i)]);
  });
  for (std::size_t i = 0; i < coords.size(); ++i) {
    Found& f = found[i];
    auto first = std::uint32_t(blocks_.size());
    for (std::size_t z = 0; z < 8; ++z) {
      f.brick.first[z] = first;
      first += std::uint32_t(std::popcount(f.brick.blocks[z]));
    }
    if (!f.blocks.empty()) bricks_.emplace(coords[i], f.brick);
    if (!f.points.empty()) points_of_.push_back({coords[i], points_.size()});
    blocks_.insert(blocks_.end(), f.blocks.begin(), f.blocks.end());
    points_.insert(points_.end(), f.points.begin(), f.points.end());
    f = {};
  }
}

bool EnclosedVoxels::allows(std::span<const NewFace>, std::span<const Tetrahedron> swept, Blocker* blocker) const {
  const auto all_clear_of = [&](const auto& what) { return std::all_of(swept.begin(), swept.end(), what); };
  if (blocker != nullptr && blocker->count == kCubeCorners) {
    const LatticeCoord voxel = rounded(blocker->points[0]);
    if (!all_clear_of([&](const Tetrahedron& t) { return is_clear_of(voxel, t); })) return false;
  }
  return all_clear_of([&](const Tetrahedron& t) { return clear(t, blocker); });
}

std::uint64_t EnclosedVoxels::bytes() const {
  constexpr std::uint64_t kBytesPerBrick = sizeof(BoundaryBrick) + 48;  // with 48 bytes of a hash table
  return blocks_.capacity() * sizeof(Block) + bricks_.size() * kBytesPerBrick +
         points_.capacity() * sizeof(VoxelCoord) + points_of_.capacity() * sizeof(PointsOf) +
         points_.size() * kBytesPerContactPoint;
}

std::vector<Vec3d> EnclosedVoxels::contact_points(const LatticeCoord& origin, const LatticeBox& within) const {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < points_of_.size(); ++i) {
    const LatticeCoord low = low_corner(first_voxel(points_of_[i].coord));
    constexpr std::int64_t edge = std::int64_t(kBrickEdge) * kLatticePerVoxel;
    if (!within.meets({low, low + LatticeCoord{edge, edge, edge}})) continue;
    const std::size_t end = i + 1 < points_of_.size() ? points_of_[i + 1].first : points_.size();
    for (std::size_t k = points_of_[i].first; k < end; ++k) {
      const LatticeCoord p = low_corner(points_[k]);
      if (within.meets({p, p})) points.push_back(to_double(p - origin));
    }
  }
  return points;
}

template <class Use>
void EnclosedVoxels::for_each_block(BrickCoord coord, const Use& use) const {
  const BoundaryBrick& brick = bricks_.at(coord);
  for (std::int32_t z = 0; z < 8; ++z) {
    std::uint32_t next = brick.first[std::size_t(z)];
    for (std::uint64_t left = brick.blocks[std::size_t(z)]; left != 0; left &= left - 1) {
      const std::int32_t b = std::countr_zero(left);
      use(first_voxel(coord) + VoxelCoord{b % 8, b / 8, z} * 8, blocks_[next++]);
    }
  }
}

void EnclosedVoxels::outer_boxes(const UseBoxes& use) const {
  std::vector<BrickCoord> coords;
  for (const auto& [coord, brick] : bricks_) coords.push_back(coord);
  std::sort(coords.begin(), coords.end(),
            [](BrickCoord a, BrickCoord b) { return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x); });
  std::vector<LatticeBox> boxes;
  const std::size_t step = blocks_.size() / kFirstBoxes + 1;
  std::size_t count = 0;
  for (const BrickCoord& coord : coords) {
    for_each_block(coord, [&](VoxelCoord first, const Block& block) {
      if (count++ % step != 0) return;
      const auto z =
          std::int32_t(std::find_if(block.begin(), block.end(), [](auto bits) { return bits != 0; }) - block.begin());
      const std::int32_t b = std::countr_zero(block[std::size_t(z)]);
      const LatticeCoord p = low_corner(first + VoxelCoord{b % 8, b / 8, z});
      boxes.push_back({p, p});
    });
  }
  if (!use(boxes)) return;
  for (auto begin = coords.begin(); begin != coords.end();) {
    const auto end = std::find_if(begin, coords.end(), [&](BrickCoord c) { return c.z != begin->z; });
    Outlines outlines(first_voxel(*begin), ((end - 1)->y - begin->y + 1) * kBrickEdge, kBrickEdge);
    for (; begin != end; ++begin) {
      for_each_block(*begin, [&](VoxelCoord first, const Block& block) {
        for (std::int32_t row = 0; row < 64; ++row) {
          const auto bits = std::uint8_t(block[std::size_t(row / 8)] >> (8 * (row % 8)));
          if (bits == 0) continue;
          outlines.add(first.x + std::countr_zero(bits), first.x + 8 - std::countl_zero(bits), first.y + row % 8,
                       first.z + row / 8);
        }
      });
    }
    boxes.clear();
    outlines.add_corners_to(boxes);
    if (!use(boxes)) return;
  }
}

bool EnclosedVoxels::is_near(std::span<const NewFace> faces, double distance) const {
  return near_.is_near(faces, distance);
}

bool EnclosedVoxels::clear(const Tetrahedron& t, Blocker* blocker) const {
  Separator separator(t);
  constexpr std::int64_t edge = std::int64_t(kBrickEdge) * kLatticePerVoxel;
  const LatticeBox& box = separator.box();
  BrickCoord low, high;
  for (int i = 0; i < 3; ++i) {
    low[i] = std::int32_t(floor_div(box.min[i], edge));
    high[i] = std::int32_t(floor_div(box.max[i] - 1, edge));
  }
  for (std::int32_t z = low.z; z <= high.z; ++z) {
    for (std::int32_t y = low.y; y <= high.y; ++y) {
      for (std::int32_t x = low.x; x <= high.x; ++x) {
        const auto it = bricks_.find({x, y, z});
        if (it == bricks_.end() || separator.left(1, {x * edge, y * edge, z * edge}, edge) == 0) continue;
        if (!brick_clear(separator, {x, y, z}, it->second, blocker)) return false;
      }
    }
  }
  return true;
}

bool EnclosedVoxels::brick_clear(Separator& separator, BrickCoord coord, const BoundaryBrick& brick,
                                 Blocker* blocker) const {
  constexpr std::int64_t edge = 8 * kLatticePerVoxel;
  const VoxelCoord first = first_voxel(coord);
  const CellWindow window(separator.box(), low_corner(first), edge);
  for (std::int64_t z = window.low_z(); z <= window.high_z(); ++z) {
    const std::uint64_t word = brick.blocks[std::size_t(z)];
    const VoxelCoord layer{first.x, first.y, first.z + std::int32_t(z) * 8};
    for (std::uint64_t rest = separator.left(word & window.word(), low_corner(layer), edge); rest != 0;
         rest &= rest - 1) {
      const int bit = std::countr_zero(rest);
      const VoxelCoord voxel{layer.x + bit % 8 * 8, layer.y + bit / 8 * 8, layer.z};
      const auto before = std::uint32_t(std::popcount(word & ((std::uint64_t(1) << bit) - 1)));
      if (!block_clear(separator, voxel, blocks_[brick.first[std::size_t(z)] + before], blocker)) return false;
    }
  }
  return true;
}

bool EnclosedVoxels::block_clear(Separator& separator, VoxelCoord first, const Block& block, Blocker* blocker) const {
  const CellWindow window(separator.box(), low_corner(first), kLatticePerVoxel);
  for (std::int64_t z = window.low_z(); z <= window.high_z(); ++z) {
    const std::uint64_t word = block[std::size_t(z)] & window.word();
    const VoxelCoord layer{first.x, first.y, first.z + std::int32_t(z)};
    for (std::uint64_t rest = separator.left(word, low_corner(layer), kLatticePerVoxel); rest != 0; rest &= rest - 1) {
      const int bit = std::countr_zero(rest);
      const LatticeCoord low = low_corner({layer.x + bit % 8, layer.y + bit / 8, layer.z});
      if (separator.separates(low, kLatticePerVoxel)) continue;
      if (blocker != nullptr) *blocker = cube(low, kLatticePerVoxel);
      return false;
    }
  }
  return true;
}

}  // namespace bp
