#pragma once
#include <memory>
#include <vector>

#include "lib/backend/backend.h"

/// Every backend that can run here: what the tests of this folder go through. A machine without a GPU says so once;
/// under BP_REQUIRE_CUDA=1 that is a failure, so that a run on a GPU machine never passes by skipping.
namespace bp {

[[nodiscard]] std::vector<std::unique_ptr<Backend>> available_backends();

}  // namespace bp
