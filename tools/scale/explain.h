#pragma once
#include <string>

#include "lib/grid/stream.h"

namespace bp {

/// Returns some lines about the scale at a point, and about the rules of the file that give it. The closing's scale is
/// that of the lattice of samples, at the voxel that holds the point. If the orientation is not empty, a line tells how
/// the cube is turned there. Throws bad_argument if the point lies 2^30 voxels away.
[[nodiscard]] std::string explain_point(const ScalePlan& plan, const OrientationField& orientation,
                                        const StreamHeader& header, const Vec3d& point);

}  // namespace bp
