#include <fmt/format.h>

#include "gpu/cuda_backend.h"
#include "gpu/device_properties.h"
#include "gpu/kernels/cuda_check.h"
#include "gpu/kernels/device_error.h"

namespace bp {

std::vector<CudaDevice> cuda_devices() {
  int count = 0, driver = 0;
  const cudaError_t error = cudaGetDeviceCount(&count);
  if (error == cudaErrorInsufficientDriver) {  // the driver reports this also where there is none
    (void)cudaGetLastError();
    if (cudaDriverGetVersion(&driver) != cudaSuccess || driver == 0) return {};
    throw DeviceError(
        fmt::format("GPU: the driver is for CUDA {}.{}, older than this build needs, and is to be updated",
                    driver / 1000, driver % 1000 / 10));
  }
  if (error == cudaErrorNoDevice) {
    (void)cudaGetLastError();
    return {};
  }
  check_cuda(error, "cudaGetDeviceCount");
  std::vector<CudaDevice> devices;
  for (int i = 0; i < count; ++i) {
    const cudaDeviceProp p = device_properties(i);
    devices.push_back({i, p.name, p.multiProcessorCount});
  }
  return devices;
}

}  // namespace bp
