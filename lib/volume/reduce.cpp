#include "lib/volume/reduce.h"

#include <algorithm>

#include "lib/core/parallel.h"

namespace bp {

namespace {

/// Returns bits 0, 2, 4 ... of a word, side by side in the lower half. It halves the distance between bits in five
/// steps.
std::uint64_t even_bits(std::uint64_t w) {
  w &= 0x5555555555555555u;
  w = (w | w >> 1) & 0x3333333333333333u;
  w = (w | w >> 2) & 0x0F0F0F0F0F0F0F0Fu;
  w = (w | w >> 4) & 0x00FF00FF00FF00FFu;
  w = (w | w >> 8) & 0x0000FFFF0000FFFFu;
  return (w | w >> 16) & 0x00000000FFFFFFFFu;
}

/// Ors pairs of voxels that begin at even places.
std::uint64_t pairs(std::uint64_t w) {
  return even_bits(w | w >> 1);
}

VoxelCoord shift_of(const GridFrame& frame) {
  const GridFrame coarse = reduced(frame);
  VoxelCoord shift;
  for (int i = 0; i < 3; ++i) shift[i] = std::int32_t(frame.origin[std::size_t(i)] - 2 * coarse.origin[std::size_t(i)]);
  return shift;
}

/// Returns the coarse bricks that fine bricks [lo, hi) reach into.
BrickBox coarse_bricks(const BrickBox& fine, VoxelCoord shift) {
  const VoxelBox voxels = voxels_of(fine);
  VoxelBox coarse;
  for (int i = 0; i < 3; ++i) {
    coarse.min[i] = floor_div(voxels.min[i] + shift[i], 2);
    coarse.max[i] = floor_div(voxels.max[i] - 1 + shift[i], 2) + 1;
  }
  return bricks_of(coarse);
}

/// Returns the fine voxels in a coarse brick, grown to whole words in x.
VoxelBox fine_voxels(BrickCoord coarse, VoxelCoord shift) {
  const VoxelCoord first = first_voxel(coarse) * 2 - shift;
  VoxelBox box{first, {first.x + 128, first.y + 128, first.z + 128}};
  box.max.x += shift.x;
  box.min.x -= 63 * shift.x;
  return box;
}

BrickFill fill_of(const BrickShelf& shelf, const BrickBox& bricks) {
  bool all_full = true, all_empty = true;
  for_each(bricks, [&](BrickCoord c) {
    const BrickFill fill = shelf.fill(c);
    all_full = all_full && fill == BrickFill::full;
    all_empty = all_empty && fill == BrickFill::empty;
  });
  return all_empty ? BrickFill::empty : all_full ? BrickFill::full : BrickFill::mixed;
}

/// Returns one row of a coarse brick from four fine rows. `odd`: its first voxel has only the upper half of a pair in
/// word 1.
std::uint64_t reduced_row(const BitBox& fine, std::int32_t y, std::int32_t z, bool odd) {
  std::uint64_t w[3] = {};
  const int words = odd ? 3 : 2;
  for (int k = 0; k < 4; ++k) {
    const std::uint64_t* row = fine.row(y + (k & 1), z + (k >> 1));
    for (int i = 0; i < words; ++i) w[i] |= row[i];
  }
  if (!odd) return pairs(w[0]) | pairs(w[1]) << 32;
  return pairs(w[1] << 1 | w[0] >> 63) | pairs(w[2] << 1 | w[1] >> 63) << 32;
}

void reduce_brick(const BrickShelf& fine, VoxelCoord shift, BrickCoord brick, BrickShelf& coarse) {
  BrickBits bits;
  const VoxelBox box = fine_voxels(brick, shift);
  const BrickFill fill = fill_of(fine, bricks_of(box));
  if (fill == BrickFill::empty) return;
  if (fill == BrickFill::full) {
    bits.fill(~std::uint64_t(0));
    return coarse.put(brick, BrickFill::full, bits);
  }
  BitBox voxels(box);
  load_voxels(fine, voxels);
  for (std::int32_t z = 0; z < kBrickEdge; ++z) {
    for (std::int32_t y = 0; y < kBrickEdge; ++y) {
      bits[std::size_t(z * kBrickEdge + y)] = reduced_row(voxels, box.min.y + 2 * y, box.min.z + 2 * z, shift.x != 0);
    }
  }
  coarse.put(brick, classify(bits), bits);
}

}  // namespace

GridFrame reduced(const GridFrame& fine) {
  GridFrame coarse = fine;
  coarse.voxel = 2 * fine.voxel;
  for (std::int64_t& o : coarse.origin) o = floor_div(o, std::int64_t(2));
  return coarse;
}

StreamHeader reduced(const StreamHeader& fine) {
  StreamHeader coarse = fine;
  coarse.frame = reduced(fine.frame);
  coarse.bricks = fine.bricks.empty() ? fine.bricks : coarse_bricks(fine.bricks, shift_of(fine.frame));
  coarse.slab_axis = longest_axis(coarse.bricks);
  coarse.has_closing = false;
  coarse.scale = {};
  coarse.has_field = false;
  return coarse;
}

void reduce(const BrickShelf& fine, const GridFrame& frame, BrickShelf& coarse) {
  const VoxelCoord shift = shift_of(frame);
  std::vector<BrickCoord> bricks;
  for (const BrickCoord f : fine.coords()) {
    for_each(coarse_bricks({f, {f.x + 1, f.y + 1, f.z + 1}}, shift), [&](BrickCoord c) { bricks.push_back(c); });
  }
  std::sort(bricks.begin(), bricks.end());
  bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
  parallel_for(std::int64_t(bricks.size()),
               [&](std::int64_t i) { reduce_brick(fine, shift, bricks[std::size_t(i)], coarse); });
}

}  // namespace bp
