#pragma once
#include "tools/lod/build.h"

/// The levels of a chain: each has fewer faces than the one before, and spends its budget as far as the voxels can.
namespace bp {

/// Which levels of a request are made.
struct ChainRange {
  LodRequest request;                ///< as request_for() gives it
  std::size_t first = 0, count = 0;  ///< `first` is the first in one mesh
  double scene_voxel = 0;            ///< edge of the finest voxels, scene units
  Bounds3d bounds;                   ///< of the scene
  std::string input_hash;            ///< for the provenance
  double detail = 1;                 ///< LodTarget::detail of all of them
};

/// At most as many levels as were asked for, finest first. One that comes out with no fewer faces than the one before,
/// or with an error above the scene's diagonal, is left out, but for the first; a note says how many are. Where the
/// first has clearly fewer faces than its budget, budgets that follow from it (a quarter each) are quarters of what it
/// has, and scales double. Errors never fall. `finest`: the first level, if it is there already.
[[nodiscard]] std::vector<LodLevel> make_levels(Build& build, LodChain& chain, const ChainRange& range,
                                                std::optional<LodLevel> finest = {});

struct MadeChain {
  VoxelizedScene scene;  ///< without its voxels
  std::vector<LodLevel> levels;
};

/// All levels, in one mesh each. If the finest has clearly fewer faces than were asked for, and may_refine(), voxels
/// and scale are halved, as long as that gives a quarter more faces, and kMostResolution allows it; what was tried last
/// is taken. Throws out_of_resource where the memory does not: it must not decide what is made.
[[nodiscard]] MadeChain make_chain(Build& build);

}  // namespace bp
