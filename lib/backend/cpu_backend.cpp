#include "lib/backend/cpu_backend.h"

#include "lib/voxel/voxelize.h"

namespace bp {

void CpuBackend::voxelize(std::span<const FixedTriangle> triangles, BitBox& out) {
  voxelize_surface(triangles, out);
}

void CpuBackend::close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                       const VoxelBox& interior, BitBox& closed) {
  close_tile(solid, scale, halo, params, interior, closed, scratch_);
}

}  // namespace bp
