#include "gpu/cuda_check.h"

#include <cstdlib>

#include "gpu/device_error.h"

namespace bp {

namespace {

bool debug_sync() {
  static const bool on = [] {
    const char* v = std::getenv("BP_DEBUG_SYNC");
    return v != nullptr && v[0] == '1';
  }();
  return on;
}

}  // namespace

void check_cuda(cudaError_t error, const char* what) {
  if (error == cudaSuccess) return;
  (void)cudaGetLastError();  // an error that is not sticky must not show up in the next call
  if (error == cudaErrorMemoryAllocation) {
    throw OutOfDeviceMemory(fmt::format(
        "GPU: out of device memory in {}; use smaller tiles, fewer tools on this GPU, or --device cpu", what));
  }
#ifndef BP_EMULATED_CUDA
  if (error == cudaErrorInsufficientDriver) {
    fail(ErrorCode::out_of_resource, "GPU: the driver is older than this build needs; update it, or use --device cpu");
  }
  if (error == cudaErrorNoDevice || error == cudaErrorInvalidDevice) {
    fail(ErrorCode::out_of_resource, "GPU: no such device; use --device cpu");
  }
  if (error == cudaErrorNoKernelImageForDevice) {
    fail(ErrorCode::out_of_resource, "GPU: this build holds no code for this GPU; use --device cpu");
  }
#endif
  fail(ErrorCode::out_of_resource,
       "GPU: {} failed: {} ({}); rerun with BP_DEBUG_SYNC=1 to name the kernel, or use --device cpu", what,
       cudaGetErrorString(error), cudaGetErrorName(error));
}

void check_launch(cudaError_t error, const char* kernel, cudaStream_t stream) {
  check_cuda(error, kernel);
  if (debug_sync()) check_cuda(cudaStreamSynchronize(stream), kernel);
}

}  // namespace bp
