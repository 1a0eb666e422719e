#pragma once
#include <cuda_runtime.h>

/// Turns CUDA error codes into Errors, all of them out_of_resource: tools end with the exit code of devices. Out of
/// device memory is OutOfDeviceMemory.
namespace bp {

/// Throws unless `error` is cudaSuccess; `what` names the call or kernel.
void check_cuda(cudaError_t error, const char* what);
/// After a launch: the launch's own error, and under BP_DEBUG_SYNC=1 that of the kernel.
void check_launch(cudaError_t error, const char* kernel, cudaStream_t stream);

#define BP_CUDA_CHECK(call) ::bp::check_cuda((call), #call)

}  // namespace bp
