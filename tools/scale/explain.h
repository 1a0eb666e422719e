#pragma once
#include <string>

#include "lib/grid/stream.h"

namespace bp {

/// What scale the point gets, and from which rules of the file: a text of some lines. The scale of the closing is that
/// of the lattice of samples, at the voxel that holds the point. An orientation that is not empty tells how the cube is
/// turned there. Throws bad_argument if the point lies 2^30 voxels away.
[[nodiscard]] std::string explain_point(const ScalePlan& plan, const OrientationField& orientation,
                                        const StreamHeader& header, const Vec3d& point);

}  // namespace bp
