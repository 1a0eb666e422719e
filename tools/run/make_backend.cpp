#include "tools/run/make_backend.h"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <numeric>
#include <optional>
#include <string_view>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/device/cpu/cpu_backend.h"
#include "lib/device/cpu/fallback_backend.h"
#include "lib/device/device_error.h"
#ifdef BP_HAVE_CUDA
#include "gpu/cuda_backend.h"
#endif

namespace bp {

namespace {

using Kind = DeviceChoice::Kind;

struct Wish {
  DeviceChoice choice;
  std::string_view by = "--device";  ///< what asked for the device, for messages
};

Wish resolve(const DeviceChoice& choice) {
  const char* forced = std::getenv("BP_BACKEND");
  if (choice.kind != Kind::automatic || forced == nullptr || *forced == '\0') return {choice};
  try {
    return {parse_device(forced), "BP_BACKEND"};
  } catch (const Error& e) {
    fail_as(e, "BP_BACKEND in the environment: {}", e.what());
  }
}

Backends make_cpu_backends() {
  Backends backends;
  for (int i = 0; i < thread_count(); ++i) backends.push_back(std::make_unique<CpuBackend>());
  return backends;
}

#ifdef BP_HAVE_CUDA
// A child of fork() cannot use GPUs that its parent has begun to use.
std::atomic<bool> gpu_was_begun{false};
std::atomic<bool> gpu_is_lost{false};
[[maybe_unused]] const int registered = ::pthread_atfork(nullptr, nullptr, [] {
  if (gpu_was_begun) gpu_is_lost = true;
});

std::vector<CudaDevice> begin_gpus() {
  gpu_was_begun = true;
  return cuda_devices();
}

constexpr double kGpuStartSeconds = 0.25;  ///< start of the driver, about
constexpr int kBackendsPerGpu = 8;         ///< while some copy and compute, others gather and scatter bricks

/// Makes backends in an order in which neighbours belong to different GPUs.
Backends make_backends_on(const std::vector<int>& devices) {
  Backends backends;
  for (int i = 0; i < kBackendsPerGpu; ++i) {
    for (const int device : devices) backends.push_back(make_cuda_backend(device));
  }
  return backends;
}

std::string list_of(const std::vector<CudaDevice>& devices) {
  std::string text;
  for (const CudaDevice& d : devices) text += fmt::format("{}cuda:{} ({})", text.empty() ? "" : ", ", d.index, d.name);
  return text;
}

/// Makes backends for --device cuda.
Backends make_gpu_backends(const Wish& wish) {
  if (gpu_is_lost)
    fail(ErrorCode::out_of_resource,
         "{0} cuda: this process was forked after its parent had begun to use a GPU; start it anew, or use {0} cpu",
         wish.by);
  const std::vector<CudaDevice> there = begin_gpus();
  if (there.empty())
    fail(ErrorCode::out_of_resource, "{0} cuda: no GPU was found; check the driver, or use {0} cpu", wish.by);
  std::vector<int> ids = wish.choice.ids;
  for (const int id : ids) {
    if (id >= int(there.size()))
      fail(ErrorCode::out_of_resource, "{} cuda:{}: no such GPU; here are {}", wish.by, id, list_of(there));
  }
  if (ids.empty()) {
    for (const CudaDevice& device : there) ids.push_back(device.index);
  }
  return make_backends_on(ids);
}

/// Makes backends on the first GPU that works; empty if there is no GPU. If none of several works, throws the
/// DeviceError of the first.
Backends make_on_first_gpu() {
  std::optional<DeviceError> first;
  for (const CudaDevice& device : begin_gpus()) {
    try {
      return make_backends_on({device.index});
    } catch (const DeviceError& e) {
      if (!first) first = e;
    }
  }
  if (first) throw DeviceError(*first);
  return {};
}

/// Makes backends for --device auto: on a GPU, if the cores would need longer than the GPU takes to start. Empty if no
/// GPU works.
Backends make_gpu_backends_if_worth(const CommonOptions& common, double core_seconds, Report* report) {
  if (report == nullptr || gpu_is_lost || core_seconds / thread_count() < kGpuStartSeconds) return {};
  Backends backends;
  try {
    backends = make_on_first_gpu();
  } catch (const DeviceError& e) {
    report->note(fmt::format("{}; the CPU is used", e.what()), common);
  }
  const auto warn = [report, &common, said = std::make_shared<std::once_flag>()](const DeviceError& e) {
    std::call_once(*said, [&] { report->note(fmt::format("{}; the CPU takes over", e.what()), common); });
  };
  for (auto& backend : backends) backend = std::make_unique<FallbackBackend>(std::move(backend), warn);
  return backends;
}
#else
Backends make_gpu_backends_if_worth(const CommonOptions&, double, Report*) {
  return {};
}
Backends make_gpu_backends(const Wish& wish) {
  fail(ErrorCode::out_of_resource, "{0} cuda: this build has no GPU support; rebuild with -DBP_CUDA=ON, or use {0} cpu",
       wish.by);
}
#endif

}  // namespace

Backends make_backends(const CommonOptions& common, double core_seconds, Report* report) {
  const Wish wish = resolve(common.device);
  Backends backends;
  if (wish.choice.kind == Kind::cuda) backends = make_gpu_backends(wish);
  if (wish.choice.kind == Kind::automatic) backends = make_gpu_backends_if_worth(common, core_seconds, report);
  return backends.empty() ? make_cpu_backends() : std::move(backends);
}

std::vector<std::string> names_of(const Backends& backends) {
  std::vector<std::string> names;
  for (const auto& backend : backends) {
    const std::string name = backend->name();
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::uint64_t pinned_bytes(const Backends& backends) {
  return std::accumulate(backends.begin(), backends.end(), std::uint64_t(0),
                         [](std::uint64_t sum, const auto& backend) { return sum + backend->pinned_bytes(); });
}

}  // namespace bp
