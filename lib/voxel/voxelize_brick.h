#pragma once
#include <atomic>

#include "lib/core/box.h"
#include "lib/core/clones.h"
#include "lib/grid/brick.h"
#include "lib/voxel/fixed_triangle.h"

namespace bp {

/// Returns a word whose bits from `begin` to `end`, both included, are set. Only the low six bits of both numbers
/// count.
[[nodiscard]] inline std::uint64_t bits_between(std::int64_t begin, std::int64_t end) {
  return ~std::uint64_t(0) << (begin & 63) & ~std::uint64_t(0) >> (63 - (end & 63));
}

/// Rows of a brick that many threads add voxels to at once. A word that has the bits already is not written: most
/// triangles of a large scene lie where others have been, and memory that is only read stays in the caches of all
/// cores.
class SharedRows {
 public:
  SharedRows(BrickCoord brick, BrickBits& bits) : box_(voxels_of(brick)), bits_(bits) {}
  [[nodiscard]] const VoxelBox& box() const { return box_; }
  /// Sets the voxels [begin, end] along x.
  void set(std::int64_t begin, std::int64_t end, std::int64_t y, std::int64_t z) {
    add(bits_between(begin, end), y, z);
  }
  /// Adds a word's low bits, beginning with voxel x.
  void set_few(std::uint64_t few, std::int64_t x, std::int64_t y, std::int64_t z) { add(few << (x & 63), y, z); }
  [[nodiscard]] bool has(std::int64_t begin, std::int64_t end, std::int64_t y, std::int64_t z) const {
    const std::uint64_t bits = bits_between(begin, end);
    return (word(y, z).load(std::memory_order_relaxed) & bits) == bits;
  }

 private:
  using Word = std::atomic_ref<std::uint64_t>;
  [[nodiscard]] Word word(std::int64_t y, std::int64_t z) const {
    return Word(bits_[std::size_t((z - box_.min.z) * kBrickEdge + (y - box_.min.y))]);
  }
  void add(std::uint64_t bits, std::int64_t y, std::int64_t z) {
    const Word w = word(y, z);
    if ((w.load(std::memory_order_relaxed) & bits) != bits) w.fetch_or(bits, std::memory_order_relaxed);
  }
  VoxelBox box_;
  BrickBits& bits_;
};

/// Returns true if every voxel that the triangle meets in out.box() is set already; most small triangles end here.
///   thin     the triangle lies within one voxel along two axes: it is connected, so it meets each voxel of its box
///   touched  the voxels of its box (voxel_boxes()) that lie in out.box()
template <class Rows>
[[nodiscard]] BP_INLINE bool settle_by_box(bool thin, const VoxelBox& touched, Rows& out) {
  for (std::int32_t z = touched.min.z; z < touched.max.z; ++z) {
    for (std::int32_t y = touched.min.y; y < touched.max.y; ++y) {
      if (thin) {
        out.set(touched.min.x, touched.max.x - 1, y, z);
      } else if (!out.has(touched.min.x, touched.max.x - 1, y, z)) {
        return false;
      }
    }
  }
  return true;
}

/// voxelize_surface() for one triangle and the voxels of one brick.
void voxelize_brick(const FixedTriangle& triangle, std::int64_t slack, SharedRows& out);

}  // namespace bp
