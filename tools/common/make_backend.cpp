#include "tools/common/make_backend.h"

#include <cstdio>
#include <cstdlib>

#include "lib/backend/cpu_backend.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#ifdef BP_HAVE_CUDA
#include "gpu/cuda_backend.h"
#endif

namespace bp {

namespace {

using Kind = DeviceChoice::Kind;

DeviceChoice resolve(DeviceChoice choice) {
  const char* forced = std::getenv("BP_BACKEND");
  if (choice.kind != Kind::automatic || forced == nullptr || *forced == '\0') return choice;
  return parse_device(forced);
}

Backends make_cpu_backends() {
  Backends backends;
  for (int i = 0; i < thread_count(); ++i) backends.push_back(std::make_unique<CpuBackend>());
  return backends;
}

#ifdef BP_HAVE_CUDA
constexpr double kGpuStartSeconds = 0.25;  ///< of the driver, about
constexpr int kBackendsPerGpu = 8;         ///< some gather and scatter bricks while others copy and compute

std::vector<int> devices_of(const DeviceChoice& choice) {
  if (!choice.ids.empty()) return choice.ids;
  std::vector<int> ids;
  for (const CudaDevice& device : cuda_devices()) ids.push_back(device.index);
  if (ids.empty() && choice.kind == Kind::cuda)
    fail(ErrorCode::out_of_resource, "--device cuda: no usable GPU was found; check the driver, or use --device cpu");
  return ids;
}

/// Empty if there is no GPU and none was asked for. Neighbours are of different GPUs.
Backends make_gpu_backends(const DeviceChoice& choice) {
  Backends backends;
  const std::vector<int> devices = devices_of(choice);
  for (int i = 0; i < kBackendsPerGpu; ++i) {
    for (const int device : devices) backends.push_back(make_cuda_backend(device));
  }
  return backends;
}

/// What auto means: a GPU if the cores would take longer than it takes to start; without one that works, the CPU.
Backends make_gpu_backends_if_worth(const DeviceChoice& choice, double core_seconds) {
  if (core_seconds / thread_count() < kGpuStartSeconds) return {};
  try {
    return make_gpu_backends(choice);
  } catch (const Error& e) {
    fmt::print(stderr, "warning: {}; the CPU is used\n", e.what());
    return {};
  }
}
#else
Backends make_gpu_backends_if_worth(const DeviceChoice&, double) {
  return {};
}
Backends make_gpu_backends(const DeviceChoice&) {
  fail(ErrorCode::out_of_resource,
       "--device cuda: this build has no GPU support; rebuild with -DBP_CUDA=ON, or use --device cpu");
}
#endif

}  // namespace

Backends make_backends(const CommonOptions& common, double core_seconds) {
  const DeviceChoice choice = resolve(common.device);
  Backends backends;
  if (choice.kind == Kind::cuda) backends = make_gpu_backends(choice);
  if (choice.kind == Kind::automatic) backends = make_gpu_backends_if_worth(choice, core_seconds);
  return backends.empty() ? make_cpu_backends() : std::move(backends);
}

}  // namespace bp
