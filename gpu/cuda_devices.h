#pragma once
#include <cuda_runtime.h>

namespace bp {

/// What the driver says of a GPU. Throws DeviceError.
[[nodiscard]] cudaDeviceProp device_properties(int device);

}  // namespace bp
