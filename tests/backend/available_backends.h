#pragma once
#include <memory>
#include <vector>

#include "lib/device/backend.h"

/// Returns every backend that can run here; the tests of this folder go through them. A machine without a GPU prints
/// so; under BP_REQUIRE_CUDA=1 that is a failure, so that a run on a GPU machine never passes by skipping.
namespace bp {

[[nodiscard]] std::vector<std::unique_ptr<Backend>> available_backends();

/// Returns the numbers of this machine's GPUs. If there is none, it prints that the test was skipped, or fails under
/// BP_REQUIRE_CUDA=1, and the calling test returns.
[[nodiscard]] std::vector<int> gpus_or_skip();

}  // namespace bp
