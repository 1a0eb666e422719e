#pragma once
#include <cuda_runtime.h>

namespace bp {

/// Returns the properties that the driver reports for a GPU. Throws DeviceError.
[[nodiscard]] cudaDeviceProp device_properties(int device);

}  // namespace bp
