#pragma once
#include <string>

#include "lib/core/error.h"

namespace bp {

/// A device cannot be used, or failed at its work: the same work may still be done elsewhere (FallbackBackend). Tools
/// end with the exit code of devices.
class DeviceError : public Error {
 public:
  explicit DeviceError(const std::string& message, Remedies remedies = {Remedy::use_cpu})
      : Error(ErrorCode::out_of_resource, message, std::move(remedies)) {}
};

}  // namespace bp
