#pragma once
#include "lib/grid/scale_field.h"

namespace bp {

/// Returns true if two fields have the same samples over a box. Cost: a visit of all rules where those that matter in
/// the box are the same; elsewhere samples near the rules that differ.
[[nodiscard]] bool same_scales(const ScaleField& a, const ScaleField& b, const GridFrame& frame, const VoxelBox& box);

}  // namespace bp
