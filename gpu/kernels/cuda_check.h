#pragma once
#include <cuda_runtime.h>

#include <cstddef>

/// Turns CUDA error codes into DeviceErrors, which name the GPU that is current on the calling thread. Out of device
/// memory is OutOfDeviceMemory.
namespace bp {

/// Throws unless `error` is cudaSuccess; `what` names the call or kernel.
void check_cuda(cudaError_t error, const char* what);
/// After a launch: the launch's own error, and under BP_DEBUG_SYNC=1 that of the kernel.
void check_launch(cudaError_t error, const char* kernel, cudaStream_t stream);
/// After an allocation of page-locked host memory: there is too little of that, whatever the device has.
void check_pinned(cudaError_t error, std::size_t bytes);

#define BP_CUDA_CHECK(call) ::bp::check_cuda((call), #call)

}  // namespace bp
