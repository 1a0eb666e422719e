#include "lib/enclosed/detail/resting_points.h"

#include <array>
#include <bit>

#include "lib/grid/bit_box.h"

// Works on a row of 64 corners at a time; the voxels around them are eight words.

namespace bp::detail {

namespace {

/// The 8 voxels around each corner of a row: bit i of the index for axis i, set on the high side.
using Around = std::array<std::uint64_t, 8>;

Around around(const BitBox& bits, std::int32_t y, std::int32_t z) {
  Around w;
  for (std::size_t i = 0; i < 8; i += 2) {
    const std::uint64_t* r = bits.row(y - (i & 2 ? 0 : 1), z - (i & 4 ? 0 : 1));
    w[i] = (r[1] << 1) | (r[0] >> 63);
    w[i + 1] = r[1];
  }
  return w;
}

/// Returns true if no voxel touches a corner of the row; the middle words of the box hold the brick.
bool nothing_around(const BitBox& bits, std::int32_t y, std::int32_t z) {
  std::uint64_t any = 0;
  for (const std::int32_t dz : {-1, 0}) {
    for (const std::int32_t dy : {-1, 0}) {
      const std::uint64_t* r = bits.row(y + dy, z + dz);
      any |= r[1] | (r[0] >> 63);
    }
  }
  return any == 0;
}

/// Returns the corners inside a flat side across `axis`: occupied on one side of it, empty on the other.
std::uint64_t inside_side(const Around& w, std::size_t axis) {
  std::array<std::uint64_t, 2> all = {~std::uint64_t(0), ~std::uint64_t(0)}, any{};
  for (std::size_t i = 0; i < 8; ++i) {
    all[i >> axis & 1] &= w[i];
    any[i >> axis & 1] |= w[i];
  }
  return (all[0] & ~any[1]) | (all[1] & ~any[0]);
}

/// Returns the corners between two voxels that follow each other along `axis`.
std::uint64_t between_two(const Around& w, std::size_t axis) {
  std::uint64_t both = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    if ((i >> axis & 1) == 0) both |= w[i] & w[i | std::size_t(1) << axis];
  }
  return both;
}

/// Returns the corners of a row that the proxy may rest on. `sampled`: per axis, the corners at a multiple of the
/// spacing.
std::uint64_t resting_points(const Around& w, const std::array<std::uint64_t, 3>& sampled) {
  std::uint64_t one = 0, two = 0, three = 0;  // corners with one, two, three or more voxels
  for (const std::uint64_t v : w) {
    three |= two & v;
    two |= one & v;
    one |= v;
  }
  std::uint64_t points = one & ~two;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    points |= two & ~three & between_two(w, axis) & sampled[axis];
    points |= inside_side(w, axis) & sampled[(axis + 1) % 3] & sampled[(axis + 2) % 3];
  }
  return points;
}

}  // namespace

std::vector<VoxelCoord> resting_points_of(const BrickShelf& shelf, BrickCoord coord) {
  constexpr std::int32_t kSpacing = 8;
  constexpr std::uint64_t kAll = ~std::uint64_t(0), kEachEighth = kAll / 0xff;
  const VoxelCoord first = first_voxel(coord);
  BitBox bits({{first.x - 64, first.y - 1, first.z - 1}, {first.x + 64, first.y + 64, first.z + 64}});
  load_voxels(shelf, bits);
  std::vector<VoxelCoord> points;
  for (std::int32_t z = 0; z < kBrickEdge; ++z) {
    for (std::int32_t y = 0; y < kBrickEdge; ++y) {
      const std::array<std::uint64_t, 3> sampled = {kEachEighth, y % kSpacing == 0 ? kAll : 0,
                                                    z % kSpacing == 0 ? kAll : 0};
      if (nothing_around(bits, first.y + y, first.z + z)) continue;
      for (std::uint64_t row = resting_points(around(bits, first.y + y, first.z + z), sampled); row != 0;
           row &= row - 1)
        points.push_back({first.x + std::countr_zero(row), first.y + y, first.z + z});
    }
  }
  return points;
}

}  // namespace bp::detail
