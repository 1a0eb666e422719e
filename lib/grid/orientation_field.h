#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/coords.h"

/// The orientation field: how the cube of the closing is turned at each voxel ([CB17] §5.2). It has one rotation for
/// each cell of a coarse lattice, in fixed point, so that no float decides a voxel.
namespace bp {

constexpr int kRotationBits = 14;

/// The cube's axes as rows, times 2^14. The rounding changes the cube itself, so all code that decides about it decides
/// alike.
struct Rotation {
  std::int16_t row[3][3] = {{1 << kRotationBits, 0, 0}, {0, 1 << kRotationBits, 0}, {0, 0, 1 << kRotationBits}};
  friend bool operator==(const Rotation&, const Rotation&) = default;
  friend auto operator<=>(const Rotation&, const Rotation&) = default;
};

/// Returns the rotation of a quaternion of any length but zero.
[[nodiscard]] Rotation rotation_of(double w, double x, double y, double z);

/// Returns the same cube with the same rows, whichever of the 24 rotations of a cube onto itself came first. A cube
/// that is not turned becomes Rotation{}.
[[nodiscard]] Rotation canonical(const Rotation& r);

/// A quaternion times 2^14, each part rounded. It may have any length but zero.
struct FixedQuaternion {
  std::int16_t w = 1 << kRotationBits, x = 0, y = 0, z = 0;
  friend bool operator==(const FixedQuaternion&, const FixedQuaternion&) = default;
  friend auto operator<=>(const FixedQuaternion&, const FixedQuaternion&) = default;
};
[[nodiscard]] Rotation rotation_of(const FixedQuaternion& q);

using OrientationCell = Coord3<struct OrientationSpace, std::int32_t>;

struct OrientationField {
  static constexpr std::uint32_t kMostCells = 1 << 18, kMostRotations = (1 << 16) - 1;

  std::int32_t cell_vox = 0;               ///< edge of a cell, a multiple of 8 voxels; 0: there is no field
  OrientationCell origin{}, size{};        ///< in cells: cell (0,0,0) begins at voxel (0,0,0)
  std::vector<FixedQuaternion> rotations;  ///< each rotation once
  std::vector<std::uint16_t> cells;        ///< index into `rotations` for each cell; x fastest
  friend bool operator==(const OrientationField&, const OrientationField&) = default;

  [[nodiscard]] bool empty() const { return cell_vox == 0; }
  /// Returns the index into `rotations` at a voxel; beyond the lattice that of the nearest cell.
  [[nodiscard]] std::size_t index_at(VoxelCoord p) const;
};

/// Returns the same field, where rotations that turn a cube alike are replaced by the first of them. Cost: n log n.
[[nodiscard]] OrientationField each_cube_once(const OrientationField& field);

/// Returns what is out of range in a field that is not empty, as a fact about it; null if all is well.
[[nodiscard]] const char* orientation_fault(const OrientationField& field);

}  // namespace bp
