#include "tools/common/make_backend.h"

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

Backends make_cpu_backends(int workers) {
  Backends backends;
  const int n = workers > 0 ? workers : thread_count();
  for (int i = 0; i < n; ++i) backends.push_back(std::make_unique<CpuBackend>());
  return backends;
}

#ifdef BP_HAVE_CUDA
constexpr int kBackendsPerGpu = 2;  ///< one computes while the other's tile travels

std::vector<int> devices_of(const DeviceChoice& choice) {
  if (!choice.ids.empty()) return choice.ids;
  std::vector<int> ids;
  for (const CudaDevice& device : cuda_devices()) ids.push_back(device.index);
  if (ids.empty() && choice.kind == Kind::cuda)
    fail(ErrorCode::out_of_resource, "--device cuda: no usable GPU was found; check the driver, or use --device cpu");
  return ids;
}

/// Empty if there is no GPU and none was asked for.
Backends make_gpu_backends(const DeviceChoice& choice, int workers) {
  Backends backends;
  const std::vector<int> devices = devices_of(choice);
  const int n = devices.empty() ? 0 : workers > 0 ? workers : kBackendsPerGpu * int(devices.size());
  for (int i = 0; i < n; ++i) backends.push_back(make_cuda_backend(devices[std::size_t(i) % devices.size()]));
  return backends;
}
#else
Backends make_gpu_backends(const DeviceChoice& choice, int) {
  if (choice.kind == Kind::cuda) {
    fail(ErrorCode::out_of_resource,
         "--device cuda: this build has no GPU support; rebuild with -DBP_CUDA=ON, or use --device cpu");
  }
  return {};
}
#endif

}  // namespace

Backends make_backends(const CommonOptions& common, int workers) {
  const DeviceChoice choice = resolve(common.device);
  Backends backends;
  if (choice.kind != Kind::cpu) backends = make_gpu_backends(choice, workers);
  return backends.empty() ? make_cpu_backends(workers) : std::move(backends);
}

}  // namespace bp
