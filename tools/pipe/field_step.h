#pragma once
#include "lib/grid/scale_field.h"
#include "lib/grid/stream.h"

/// The step between the voxels and the closing, as bpscale and libbp do it.
namespace bp {

/// Returns the header of the stream with the field of `plan`, and with an orientation, which may be empty.
[[nodiscard]] StreamHeader field_header(const StreamHeader& in, const ScalePlan& plan,
                                        const OrientationField& orientation);

}  // namespace bp
