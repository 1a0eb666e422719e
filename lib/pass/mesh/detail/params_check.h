#pragma once
#include "lib/pass/mesh/mesh_pass.h"

namespace bp {

/// Throws bad_argument if they make no sense.
void check_params(const MeshParams& params);
/// Throws bad_input if a stream with this header does not hold what the mode needs.
void check_fill(const MeshParams& params, const StreamHeader& header);

}  // namespace bp
