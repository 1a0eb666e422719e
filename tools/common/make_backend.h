#pragma once
#include "lib/backend/backend.h"
#include "tools/common/common_options.h"

namespace bp {

/// One backend per computing thread on the CPU, a few per GPU. The only place where a tool chooses between them.
/// --device auto takes the GPUs where this build can use them and the work is worth their start; BP_BACKEND=cpu|cuda in
/// the environment decides what auto means. Throws out_of_resource if a GPU was asked for and cannot be used; under
/// auto that is a warning.
///   core_seconds  what the work that a GPU could take over would take on one core, about
[[nodiscard]] Backends make_backends(const CommonOptions& common, double core_seconds);

}  // namespace bp
