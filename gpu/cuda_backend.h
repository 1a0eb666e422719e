#pragma once
#include <memory>
#include <string>
#include <vector>

#include "lib/backend/backend.h"

/// The GPU behind the Backend interface. No CUDA type here: tools and tests include it without the toolkit.
namespace bp {

struct CudaDevice {
  int index = 0;
  std::string name;  ///< "NVIDIA H100 80GB HBM3"
  std::size_t memory_bytes = 0;
  int multiprocessors = 0;
};

/// The GPUs this process may use; empty if there is none or no driver.
[[nodiscard]] std::vector<CudaDevice> cuda_devices();

/// A backend with a stream and buffers of its own on one GPU; several may share a GPU. Buffers grow with the tiles and
/// are kept. A tile that does not fit in device memory is closed in parts. Throws out_of_resource if there is no such
/// device or the driver is too old.
[[nodiscard]] std::unique_ptr<Backend> make_cuda_backend(int device);

}  // namespace bp
