#include "tools/common/make_backend.h"

#include <cstdlib>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#if __has_include("lib/backend/cpu_backend.h")
#include "lib/backend/cpu_backend.h"
#define BP_HAVE_CPU_BACKEND 1
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
#ifdef BP_HAVE_CPU_BACKEND
  const int n = workers > 0 ? workers : thread_count();
  for (int i = 0; i < n; ++i) backends.push_back(std::make_unique<CpuBackend>());
#else
  (void)workers;
#endif
  return backends;
}

}  // namespace

Backends make_backends(const CommonOptions& common, int workers) {
  const DeviceChoice choice = resolve(common.device);
  if (choice.kind == Kind::cuda)
    fail(ErrorCode::out_of_resource,
         "--device cuda: this build has no GPU support; rebuild with -DBP_CUDA=ON or use cpu");
  return make_cpu_backends(workers);
}

}  // namespace bp
