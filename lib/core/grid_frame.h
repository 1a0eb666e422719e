#pragma once
#include "lib/core/box.h"
#include "lib/core/up_axis.h"

/// World <-> voxel. The frame is chosen so that every lattice vertex is *exactly* a double in scene units
/// (docs/decisions/0001-exact-frame.md): the voxel size has few significant bits, and the origin is a whole number of
/// voxels from the scene's own origin. Then (origin_vox * 64 + lattice) * (voxel / 64) is one integer times a short
/// double. Where the grid allows it, the product is a float32 as well.
namespace bp {

struct GridFrame {
  double voxel = 1;                      ///< edge of a voxel, scene units; exact_voxel_size() made it
  std::array<std::int64_t, 3> origin{};  ///< corner of voxel (0,0,0), in voxels from the scene's origin
  UpAxis up = UpAxis::y;                 ///< axis of the scene that points up; glTF outputs are turned to y up

  /// Converts a lattice point to scene units. Exact while |64 origin + p| < 2^(53 - bits of voxel), which make_frame()
  /// ensures.
  [[nodiscard]] Vec3d world(LatticeCoord p) const {
    const double unit = voxel / kLatticePerVoxel;
    return {double(origin[0] * kLatticePerVoxel + p.x) * unit, double(origin[1] * kLatticePerVoxel + p.y) * unit,
            double(origin[2] * kLatticePerVoxel + p.z) * unit};
  }
  /// Returns the corner of voxel (0,0,0) in scene units, exactly.
  [[nodiscard]] Vec3d world_origin() const { return world({0, 0, 0}); }
  /// Converts a point to voxels. It is rounded: the error is below 2^-20 voxel in grids of up to 2^31 voxels a side.
  [[nodiscard]] Vec3d to_voxels(const Vec3d& p) const {
    const Vec3d o = world_origin();
    return {(p[0] - o[0]) / voxel, (p[1] - o[1]) / voxel, (p[2] - o[2]) / voxel};
  }
  /// Converts a point to lattice units, rounded likewise.
  [[nodiscard]] Vec3d to_lattice(const Vec3d& p) const {
    const Vec3d v = to_voxels(p);
    return {v[0] * kLatticePerVoxel, v[1] * kLatticePerVoxel, v[2] * kLatticePerVoxel};
  }
  friend bool operator==(const GridFrame&, const GridFrame&) = default;
};

/// Rounds `x` up to `bits` significant bits.
[[nodiscard]] double round_up_to_bits(double x, int bits);

/// Returns a frame for a scene with these bounds and about this voxel size. The size is rounded up by at most a 128th,
/// to the most significant bits (up to 24) that make every lattice point of the grid, halo included, an exact double.
/// Each is an exact float32, too, if a 128th suffices for that; within 1,024 voxels of the scene's origin it does.
/// Farther off, the lattice points less a point near the scene's middle are floats. Voxel (0,0,0) holds or touches
/// bounds.min. Throws bad_argument if the voxel size is not within grid_limits.h, or if a side would exceed 2^31
/// voxels; bad_input if the bounds are empty, or beyond any grid.
[[nodiscard]] GridFrame make_frame(const Bounds3d& bounds, double voxel, UpAxis up = UpAxis::y);

/// Returns the voxels that the closed bounds touch, and one layer around them. Throws bad_argument beyond 2^31 voxels.
[[nodiscard]] VoxelBox voxel_bounds(const GridFrame& frame, const Bounds3d& bounds);

}  // namespace bp
