#pragma once
#include <string>

#include "lib/core/error.h"

/// Apart from cuda_check.h, which device code includes: fmt is not for nvcc.
namespace bp {

/// The device has no room for something; its parts may fit.
class OutOfDeviceMemory : public Error {
 public:
  explicit OutOfDeviceMemory(const std::string& message) : Error(ErrorCode::out_of_resource, message) {}
};

}  // namespace bp
