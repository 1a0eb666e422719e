#include "lib/grid/clip.h"

#include <algorithm>

namespace bp {

namespace {

VoxelBox voxels_of(BrickCoord c) {
  return bp::voxels_of(BrickBox{c, {c.x + 1, c.y + 1, c.z + 1}});
}

}  // namespace

std::uint64_t row_within(BrickCoord brick, std::int32_t y, std::int32_t z, const VoxelBox& box) {
  const VoxelCoord p = first_voxel(brick) + VoxelCoord{0, y, z};
  if (p.y < box.min.y || p.y >= box.max.y || p.z < box.min.z || p.z >= box.max.z) return 0;
  const std::int32_t begin = std::max(box.min.x - p.x, 0), end = std::min(box.max.x - p.x, kBrickEdge);
  if (begin >= end) return 0;
  return ~std::uint64_t(0) << begin & ~std::uint64_t(0) >> (kBrickEdge - end);
}

std::unique_ptr<BrickShelf> clipped(const BrickShelf& from, const VoxelBox& box, const ShelfFactory& make_shelf) {
  auto out = make_shelf();
  BrickBits bits;
  for_each_brick(box, [&](BrickCoord c) {
    BrickFill fill = from.get(c, bits);
    if (fill == BrickFill::empty) return;
    if (!box.contains(voxels_of(c))) {
      for (std::int32_t z = 0; z < kBrickEdge; ++z) {
        for (std::int32_t y = 0; y < kBrickEdge; ++y) bits[std::size_t(z * kBrickEdge + y)] &= row_within(c, y, z, box);
      }
      fill = classify(bits);
    }
    if (fill != BrickFill::empty) out->put(c, fill, bits);
  });
  return out;
}

bool is_full(const BrickShelf& shelf, const VoxelBox& box) {
  bool full = true;
  BrickBits bits;
  for_each_brick(box, [&](BrickCoord c) {
    if (!full || shelf.fill(c) == BrickFill::full) return;
    if (shelf.get(c, bits) == BrickFill::empty) full = false;
    for (std::int32_t z = 0; z < kBrickEdge && full; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y) {
        if ((row_within(c, y, z, box) & ~bits[std::size_t(z * kBrickEdge + y)]) != 0) full = false;
      }
    }
  });
  return full;
}

}  // namespace bp
