#pragma once
#include "lib/pass/mesh/mesh_params.h"

namespace bp {

/// Throws bad_argument if the parameters contradict each other.
void check_params(const MeshParams& params);
/// Throws bad_input if a stream with this header lacks the layer or filling that the mode needs.
void check_fill(const MeshParams& params, const StreamHeader& header);

}  // namespace bp
