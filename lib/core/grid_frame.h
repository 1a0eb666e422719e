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
  UpAxis up = UpAxis::y;                 ///< of the scene; glTF outputs are turned to y up

  /// Scene units of a lattice point; exact while |64 origin + p| < 2^(53 - bits of voxel), which make_frame ensures.
  [[nodiscard]] Vec3d world(LatticeCoord p) const {
    const double unit = voxel / kLatticePerVoxel;
    return {double(origin[0] * kLatticePerVoxel + p.x) * unit, double(origin[1] * kLatticePerVoxel + p.y) * unit,
            double(origin[2] * kLatticePerVoxel + p.z) * unit};
  }
  /// Corner of voxel (0,0,0) in scene units; exact.
  [[nodiscard]] Vec3d world_origin() const { return world({0, 0, 0}); }
  /// Position in voxels, rounded: error below 2^-20 voxel in grids up to 2^31 voxels a side.
  [[nodiscard]] Vec3d to_voxels(const Vec3d& p) const {
    const Vec3d o = world_origin();
    return {(p[0] - o[0]) / voxel, (p[1] - o[1]) / voxel, (p[2] - o[2]) / voxel};
  }
  /// The same in lattice units.
  [[nodiscard]] Vec3d to_lattice(const Vec3d& p) const {
    const Vec3d v = to_voxels(p);
    return {v[0] * kLatticePerVoxel, v[1] * kLatticePerVoxel, v[2] * kLatticePerVoxel};
  }
  friend bool operator==(const GridFrame&, const GridFrame&) = default;
};

/// `x` rounded up to `bits` significant bits.
[[nodiscard]] double round_up_to_bits(double x, int bits);

/// Frame for a scene with these bounds and (about) this voxel size: rounds `voxel` up, by at most a 128th of it, to the
/// most significant bits (up to 24) that keep every lattice point of the grid, halo included, an exact double; and a
/// float32, too, if a 128th suffices for it (at most 1,024 voxels from the scene's origin it does). If the scene lies
/// farther off, lattice points less a point near its middle are such floats. Voxel (0,0,0) holds or touches bounds.min.
/// Throws bad_argument if the voxel size is not within grid_limits.h, or if a side would exceed 2^31
/// voxels; bad_input if the bounds are empty, or beyond any grid.
[[nodiscard]] GridFrame make_frame(const Bounds3d& bounds, double voxel, UpAxis up = UpAxis::y);

/// Voxels of the grid that the closed bounds touch, and one around them. Throws bad_argument beyond 2^31 voxels.
[[nodiscard]] VoxelBox voxel_bounds(const GridFrame& frame, const Bounds3d& bounds);

}  // namespace bp
