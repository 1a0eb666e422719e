#pragma once
#include "lib/backend/backend.h"
#include "tools/common/common_options.h"

namespace bp {

/// One backend per worker, `workers` of them (0: one per computing thread on the CPU, a few per GPU). The only place
/// where a tool chooses between CPU and GPU. --device auto takes a GPU when this build can use one and one is there;
/// BP_BACKEND=cpu|cuda in the environment decides what auto means. Throws out_of_resource if the GPU asked for is
/// absent.
[[nodiscard]] Backends make_backends(const CommonOptions& common, int workers = 0);

}  // namespace bp
