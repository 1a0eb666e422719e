#pragma once
#include <memory>
#include <vector>

#include "lib/device/backend.h"

/// Every backend that can run here: what the tests of this folder go through. A machine without a GPU says so; under
/// BP_REQUIRE_CUDA=1 that is a failure, so that a run on a GPU machine never passes by skipping.
namespace bp {

[[nodiscard]] std::vector<std::unique_ptr<Backend>> available_backends();

/// Numbers of the GPUs of this machine. Empty where there is none, for the calling test to return: that it was skipped
/// is said here, and under BP_REQUIRE_CUDA=1 it fails here.
[[nodiscard]] std::vector<int> gpus_or_skip();

}  // namespace bp
