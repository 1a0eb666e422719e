#include "tests/backend/available_backends.h"

#include <cstdlib>

#include "tests/catch.h"
#if __has_include("lib/backend/cpu_backend.h")
#include "lib/backend/cpu_backend.h"
#endif
#ifdef BP_HAVE_CUDA
#include "gpu/cuda_backend.h"
#endif

namespace bp {

namespace {

bool cuda_required() {
  const char* v = std::getenv("BP_REQUIRE_CUDA");
  return v != nullptr && v[0] == '1';
}

}  // namespace

std::vector<std::unique_ptr<Backend>> available_backends() {
  std::vector<std::unique_ptr<Backend>> backends;
#if __has_include("lib/backend/cpu_backend.h")
  backends.push_back(std::make_unique<CpuBackend>());
#endif
#ifdef BP_HAVE_CUDA
  if (!cuda_devices().empty()) backends.push_back(make_cuda_backend(0));
  const bool skipped = cuda_devices().empty();
#else
  const bool skipped = true;
#endif
  if (skipped && cuda_required()) FAIL("BP_REQUIRE_CUDA=1, but no GPU can be used here");
  if (skipped) WARN("no GPU here: the GPU backend was not tested");
  return backends;
}

}  // namespace bp
