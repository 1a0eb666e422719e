#pragma once
#include <string>

#include "lib/device/device_error.h"

/// Apart from cuda_check.h, which device code includes: fmt is not for nvcc.
namespace bp {

/// The device has no room for something; its parts may fit.
class OutOfDeviceMemory : public DeviceError {
 public:
  explicit OutOfDeviceMemory(const std::string& message)
      : DeviceError(message, {Remedy::smaller_tiles, Remedy::fewer_users_of_device, Remedy::use_cpu}) {}
};

}  // namespace bp
