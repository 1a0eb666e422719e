#pragma once
#include <cuda_runtime.h>

#include <cstddef>

/// Turns CUDA error codes into DeviceErrors, which name the current GPU of the calling thread. A lack of device memory
/// is OutOfDeviceMemory.
namespace bp {

/// Throws unless `error` is cudaSuccess; `what` names the call or kernel.
void check_cuda(cudaError_t error, const char* what);
/// Checks a launch: the launch's own error, and with BP_DEBUG_SYNC=1 the kernel's error.
void check_launch(cudaError_t error, const char* kernel, cudaStream_t stream);
/// Checks an allocation of page-locked host memory. There may be too little of it, whatever the device has.
void check_pinned(cudaError_t error, std::size_t bytes);

#define BP_CUDA_CHECK(call) ::bp::check_cuda((call), #call)

}  // namespace bp
