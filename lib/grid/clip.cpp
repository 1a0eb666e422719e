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

BrickFill get_within(const BrickShelf& shelf, BrickCoord c, const VoxelBox& box, BrickBits& bits) {
  const BrickFill fill = shelf.get(c, bits);
  if (fill == BrickFill::empty || box.contains(voxels_of(c))) return fill;
  for (std::int32_t z = 0; z < kBrickEdge; ++z) {
    for (std::int32_t y = 0; y < kBrickEdge; ++y) bits[std::size_t(z * kBrickEdge + y)] &= row_within(c, y, z, box);
  }
  return classify(bits);
}

std::unique_ptr<BrickShelf> clipped(const BrickShelf& from, const VoxelBox& box, const ShelfFactory& make_shelf) {
  auto out = make_shelf();
  BrickBits bits;
  for_each_brick(box, [&](BrickCoord c) {
    const BrickFill fill = get_within(from, c, box, bits);
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

void add_voxels(KeyHash& hash, const BrickShelf& shelf, const VoxelBox& box, BrickCoord origin) {
  BrickBits bits;
  for_each_brick(box, [&](BrickCoord c) {
    const BrickFill fill = get_within(shelf, c, box, bits);
    if (fill == BrickFill::empty) return;
    hash.add(std::int64_t(1))
        .add(std::int64_t(c.x - origin.x))
        .add(std::int64_t(c.y - origin.y))
        .add(std::int64_t(c.z - origin.z));
    hash.add(std::int64_t(fill));
    if (fill == BrickFill::mixed) hash.add(std::as_bytes(std::span(bits)));
  });
  hash.add(std::int64_t(0));
}

}  // namespace bp
