#pragma once
#include "lib/levels/voxel_choice.h"
#include "tools/lod/build_options.h"
#include "tools/notes/estimate.h"

namespace bp {

/// Throws bad_argument if a length in the options, or the grid that follows from one, is out of proportion to the scene
/// (tools/notes/proportion.h). Call it as soon as the bounds are known, before the work.
void question_proportions(const BuildOptions& options, const SceneSize& scene);

/// Estimates what the run takes with voxels of this edge. `counts`: counts of the scene's triangles.
[[nodiscard]] Estimate estimate_build(const BuildOptions& options, const Bounds3d& scene, const VoxelizeCounts& counts,
                                      double voxel);

}  // namespace bp
