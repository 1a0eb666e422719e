#pragma once
#include <string>

#include "lib/core/error.h"

namespace bp {

/// Thrown if a device cannot be used, or fails at its work. The same work may still be done elsewhere
/// (FallbackBackend). Tools end with the exit code for devices.
class DeviceError : public Error {
 public:
  explicit DeviceError(const std::string& message, Remedies remedies = {Remedy::use_cpu})
      : Error(ErrorCode::out_of_resource, message, std::move(remedies)) {}
};

}  // namespace bp
