#pragma once
#include <memory>
#include <string>
#include <vector>

#include "lib/device/backend.h"

/// The GPU behind the Backend interface. There is no CUDA type here, so tools and tests include it without the toolkit.
namespace bp {

struct CudaDevice {
  int index = 0;
  std::string name;  ///< "NVIDIA H100 80GB HBM3"
  int multiprocessors = 0;
};

/// Returns the GPUs that this process may use; none if there is no GPU or no driver. Throws DeviceError if the driver
/// is too old for this build or does not work.
[[nodiscard]] std::vector<CudaDevice> cuda_devices();

/// Returns a backend with a stream and buffers of its own on one GPU. Several backends may share a GPU. Buffers grow
/// with the tiles and are kept. A tile that does not fit in device memory is closed in parts. Throws DeviceError if
/// there is no such device, or if this build holds no code for it. Later failures of the device are DeviceErrors, too.
[[nodiscard]] std::unique_ptr<Backend> make_cuda_backend(int device);

}  // namespace bp
