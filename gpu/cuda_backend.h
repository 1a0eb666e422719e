#pragma once
#include <memory>
#include <string>
#include <vector>

#include "lib/device/backend.h"

/// The GPU behind the Backend interface. No CUDA type here: tools and tests include it without the toolkit.
namespace bp {

struct CudaDevice {
  int index = 0;
  std::string name;  ///< "NVIDIA H100 80GB HBM3"
  int multiprocessors = 0;
};

/// The GPUs this process may use; empty if there is none or no driver. Throws DeviceError if there is a driver that is
/// too old for this build or does not work.
[[nodiscard]] std::vector<CudaDevice> cuda_devices();

/// A backend with a stream and buffers of its own on one GPU; several may share a GPU. Buffers grow with the tiles and
/// are kept. A tile that does not fit in device memory is closed in parts. Throws DeviceError if there is no such
/// device, or if this build holds no code for it; what fails there later is a DeviceError, too.
[[nodiscard]] std::unique_ptr<Backend> make_cuda_backend(int device);

}  // namespace bp
