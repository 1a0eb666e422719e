#include "tests/backend/available_backends.h"

#include <cstdlib>

#include "lib/core/error.h"
#include "lib/device/cpu/cpu_backend.h"
#include "tests/catch.h"
#ifdef BP_HAVE_CUDA
#include "gpu/cuda_backend.h"
#endif

namespace bp {

std::vector<int> gpus_or_skip() {
  std::vector<int> indices;
  std::string why = "no GPU here";
#ifdef BP_HAVE_CUDA
  try {
    for (const CudaDevice& device : cuda_devices()) indices.push_back(device.index);
  } catch (const Error& e) {
    why = e.what();
  }
#endif
  const char* required = std::getenv("BP_REQUIRE_CUDA");
  if (indices.empty() && required != nullptr && required[0] == '1') FAIL("BP_REQUIRE_CUDA=1, but: " << why);
  if (indices.empty()) WARN(why << ": the GPU backend was not tested");
  return indices;
}

std::vector<std::unique_ptr<Backend>> available_backends() {
  std::vector<std::unique_ptr<Backend>> backends;
  backends.push_back(std::make_unique<CpuBackend>());
  const std::vector<int> found = gpus_or_skip();
#ifdef BP_HAVE_CUDA
  if (!found.empty()) backends.push_back(make_cuda_backend(found.front()));
#endif
  return backends;
}

}  // namespace bp
