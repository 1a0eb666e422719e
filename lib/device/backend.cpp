#include "lib/device/backend.h"

namespace bp {

void Backend::close_from_shelf(const BrickShelf& solid, const BrickBox& bricks, const ScaleLattice& scale,
                               const Halo& halo, const ClosingParams& params, const VoxelBox& interior,
                               BitBox& closed) {
  loaded_.reset(intersect(interior.grown(halo.total_vox()), voxels_of(bricks)));
  load_voxels(solid, loaded_);
  close(loaded_, scale, halo, params, interior, closed);
}

}  // namespace bp
