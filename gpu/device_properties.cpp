#include "gpu/device_properties.h"

#include "gpu/kernels/cuda_check.h"

namespace bp {

cudaDeviceProp device_properties(int device) {
  cudaDeviceProp p{};
  BP_CUDA_CHECK(cudaGetDeviceProperties(&p, device));
  return p;
}

}  // namespace bp
