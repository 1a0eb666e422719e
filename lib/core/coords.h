#pragma once
#include <array>
#include <compare>
#include <cstdint>

#include "lib/core/host_device.h"

/// Integer coordinates by space. Voxel, brick, tile and lattice coordinates are different types, and do not convert by
/// themselves.
namespace bp {

constexpr int kBrickEdge = 64;        ///< voxels along one side of a brick
constexpr int kLatticePerVoxel = 64;  ///< vertex positions are integers in units of 1/64 voxel
constexpr int kScaleStep = 8;         ///< voxels between two samples of the scale field
constexpr int kScaleOne = 16;         ///< scales are fixed point: 16 is one voxel

template <class Space, class Int>
struct Coord3 {
  using value_type = Int;
  Int x = 0, y = 0, z = 0;

  BP_HD constexpr Int& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  BP_HD constexpr Int operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  friend BP_HD constexpr Coord3 operator+(Coord3 a, Coord3 b) {
    return {Int(a.x + b.x), Int(a.y + b.y), Int(a.z + b.z)};
  }
  friend BP_HD constexpr Coord3 operator-(Coord3 a, Coord3 b) {
    return {Int(a.x - b.x), Int(a.y - b.y), Int(a.z - b.z)};
  }
  friend BP_HD constexpr Coord3 operator*(Coord3 a, Int s) { return {Int(a.x * s), Int(a.y * s), Int(a.z * s)}; }
  /// Compares x, then y, then z.
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the 0 in a defaulted comparison for a null pointer
  friend constexpr auto operator<=>(const Coord3&, const Coord3&) = default;
};

using VoxelCoord = Coord3<struct VoxelSpace, std::int32_t>;  ///< voxel of the grid; voxel p is the closed cube [p, p+1]
using BrickCoord = Coord3<struct BrickSpace, std::int32_t>;  ///< brick of the grid: voxels [64 b, 64 b + 64)
using TileCoord = Coord3<struct TileSpace, std::int32_t>;    ///< tile of the current run
using LatticeCoord = Coord3<struct LatticeSpace, std::int64_t>;  ///< vertex position, 1/64 voxel

/// Divides and rounds down, so that negative coordinates land in the right cell. b > 0.
template <class Int>
BP_HD constexpr Int floor_div(Int a, Int b) {
  return a / b - (a % b < 0);
}
template <class Int>
BP_HD constexpr Int ceil_div(Int a, Int b) {
  return a / b + (a % b > 0);
}

[[nodiscard]] constexpr BrickCoord brick_of(VoxelCoord v) {
  return {floor_div(v.x, kBrickEdge), floor_div(v.y, kBrickEdge), floor_div(v.z, kBrickEdge)};
}
[[nodiscard]] constexpr VoxelCoord first_voxel(BrickCoord b) {
  return {b.x * kBrickEdge, b.y * kBrickEdge, b.z * kBrickEdge};
}

using Vec3d = std::array<double, 3>;     ///< a point or a vector in scene units
using TriangleD = std::array<Vec3d, 3>;  ///< a triangle of a scene, as read

}  // namespace bp
