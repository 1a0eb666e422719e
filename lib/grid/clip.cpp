#include "lib/grid/clip.h"

#include <algorithm>

namespace bp {

namespace {

/// A range of places along an axis of a brick, [begin, end), not empty or [0, 0).
struct BrickRange {
  std::int32_t begin = 0, end = 0;
  [[nodiscard]] bool holds(std::int32_t i) const { return i >= begin && i < end; }
};

BrickRange within(std::int32_t first, std::int32_t min, std::int32_t max) {
  const BrickRange range{std::max(min - first, 0), std::min(max - first, kBrickEdge)};
  return range.begin < range.end ? range : BrickRange{};
}

/// The rows of a brick that meet a box, and their voxels in it.
struct Rows {
  BrickRange y, z;
  std::uint64_t mask = 0;
};

Rows rows_within(BrickCoord brick, const VoxelBox& box) {
  const VoxelCoord first = first_voxel(brick);
  const BrickRange x = within(first.x, box.min.x, box.max.x);
  const std::uint64_t mask =
      x.begin < x.end ? ~std::uint64_t(0) << x.begin & ~std::uint64_t(0) >> (kBrickEdge - x.end) : 0;
  return {within(first.y, box.min.y, box.max.y), within(first.z, box.min.z, box.max.z), mask};
}

}  // namespace

std::uint64_t row_within(BrickCoord brick, std::int32_t y, std::int32_t z, const VoxelBox& box) {
  const Rows rows = rows_within(brick, box);
  return rows.z.holds(z) && rows.y.holds(y) ? rows.mask : 0;
}

BrickFill get_within(const BrickShelf& shelf, BrickCoord c, const VoxelBox& box, BrickBits& bits) {
  const BrickFill fill = shelf.get(c, bits);
  if (fill == BrickFill::empty || box.contains(voxels_of(c))) return fill;
  const Rows rows = rows_within(c, box);
  const auto clear = [&](std::int32_t z, std::int32_t y, std::int32_t end) {
    std::fill(bits.begin() + z * kBrickEdge + y, bits.begin() + z * kBrickEdge + end, 0);
  };
  for (std::int32_t z = 0; z < kBrickEdge; ++z) {
    if (z < rows.z.begin || z >= rows.z.end) {
      clear(z, 0, kBrickEdge);
      continue;
    }
    clear(z, 0, rows.y.begin);
    clear(z, rows.y.end, kBrickEdge);
    for (std::int32_t y = rows.y.begin; y < rows.y.end; ++y) bits[std::size_t(z * kBrickEdge + y)] &= rows.mask;
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
    const Rows rows = rows_within(c, box);
    for (std::int32_t z = rows.z.begin; z < rows.z.end && full; ++z) {
      for (std::int32_t y = rows.y.begin; y < rows.y.end; ++y) {
        if ((rows.mask & ~bits[std::size_t(z * kBrickEdge + y)]) != 0) full = false;
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
    hash.add(true, c - origin, fill);
    if (fill != BrickFill::mixed) return;
    const Rows rows = rows_within(c, box);
    for (std::int32_t z = rows.z.begin; z < rows.z.end; ++z) {
      const std::uint64_t* const slice = bits.data() + z * kBrickEdge;
      hash.add(std::as_bytes(std::span(slice + rows.y.begin, slice + rows.y.end)));
    }
  });
  hash.add(false);
}

}  // namespace bp
