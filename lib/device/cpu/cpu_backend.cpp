#include "lib/device/cpu/cpu_backend.h"

namespace bp {

void CpuBackend::close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                       const VoxelBox& interior, BitBox& closed) {
  close_tile(solid, scale, halo, params, interior, closed, scratch_);
}

void CpuBackend::weigh(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside,
                       WeightBlock& out, std::span<CoordinateRows::Place> places) {
  weigh_points(coordinates, points, carry_outside, rows_, out, places);
}

}  // namespace bp
