#pragma once
#include <cuda_runtime.h>

/// Turns CUDA error codes into Errors: out of device memory, no device or an old driver is out_of_resource, anything
/// else failed.
namespace bp {

/// Throws unless `error` is cudaSuccess; `what` names the call or kernel.
void check_cuda(cudaError_t error, const char* what);
/// After a launch: the launch's own error, and under BP_DEBUG_SYNC=1 that of the kernel.
void check_launch(cudaError_t error, const char* kernel, cudaStream_t stream);

#define BP_CUDA_CHECK(call) ::bp::check_cuda((call), #call)

}  // namespace bp
