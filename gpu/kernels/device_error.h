#pragma once
#include <string>

#include "lib/device/device_error.h"

/// This file is apart from cuda_check.h, which device code includes: nvcc does not compile fmt.
namespace bp {

/// The device has no room for an array; parts of it may fit.
class OutOfDeviceMemory : public DeviceError {
 public:
  explicit OutOfDeviceMemory(const std::string& message)
      : DeviceError(message, {Remedy::smaller_tiles, Remedy::fewer_users_of_device, Remedy::use_cpu}) {}
};

}  // namespace bp
