#include "lib/device/cpu/cpu_backend.h"

#include "lib/voxel/voxelize.h"

namespace bp {

void CpuBackend::voxelize(std::span<const FixedTriangle> triangles, BitBox& out, std::int64_t slack) {
  voxelize_surface(triangles, out, slack);
}

void CpuBackend::find_crossings(std::span<const FixedTriangle> triangles, const VoxelBox& tile,
                                std::vector<Crossing>& out) {
  bp::find_crossings(triangles, tile, out);
}

void CpuBackend::fill_winding(std::vector<Crossing>& crossings, std::span<const std::uint64_t> skip,
                              std::span<std::int32_t> numbers, BitBox& bits) {
  bp::fill_winding(crossings, bits.box(), skip, numbers, bits);
}

void CpuBackend::close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                       const VoxelBox& interior, BitBox& closed) {
  close_tile(solid, scale, halo, params, interior, closed, scratch_);
}

void CpuBackend::weigh(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside,
                       WeightBlock& out, std::span<CoordinateRows::Place> places) {
  weigh_points(coordinates, points, carry_outside, rows_, out, places);
}

}  // namespace bp
