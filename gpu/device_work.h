#pragma once
#include <cuda_runtime.h>

#include <functional>
#include <string>

#include "gpu/staging.h"

namespace bp {

/// The stream of a backend, its transfers, and a way to get device memory back. All parts of a backend share them.
struct DeviceWork {
  std::string device;  ///< its name, for messages
  cudaStream_t stream;
  Staging& staging;
  std::function<void()> make_room;  ///< waits for the stream, and frees all device memory of the backend
};

}  // namespace bp
