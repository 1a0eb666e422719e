#include "gpu/kernels/cuda_check.h"

#include <cstdlib>

#include "gpu/kernels/device_error.h"

namespace bp {

namespace {

bool debug_sync() {
  static const bool on = [] {
    const char* v = std::getenv("BP_DEBUG_SYNC");
    return v != nullptr && v[0] == '1';
  }();
  return on;
}

std::string current_device() {
  int device = 0;
  return cudaGetDevice(&device) == cudaSuccess ? fmt::format("cuda:{}", device) : "GPU";
}

}  // namespace

void check_cuda(cudaError_t error, const char* what) {
  if (error == cudaSuccess) return;
  (void)cudaGetLastError();  // an error that is not sticky must not show up in the next call
  const std::string device = current_device();
  if (error == cudaErrorMemoryAllocation) {
    throw OutOfDeviceMemory(fmt::format("{}: out of device memory in {}", device, what));
  }
  throw DeviceError(fmt::format("{}: {} failed: {} ({}); BP_DEBUG_SYNC=1 in the environment names the kernel", device,
                                what, cudaGetErrorString(error), cudaGetErrorName(error)));
}

void check_pinned(cudaError_t error, std::size_t bytes) {
  if (error != cudaErrorMemoryAllocation) return check_cuda(error, "cudaMallocHost");
  (void)cudaGetLastError();
  throw DeviceError(fmt::format(
      "{}: {} MiB of page-locked host memory cannot be had; the limit of this container, or ulimit -l, is too "
      "low",
      current_device(), bytes >> 20));
}

void check_launch(cudaError_t error, const char* kernel, cudaStream_t stream) {
  check_cuda(error, kernel);
  if (debug_sync()) check_cuda(cudaStreamSynchronize(stream), kernel);
}

}  // namespace bp
