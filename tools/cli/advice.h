#pragma once
#include <string>

#include "lib/core/error.h"

namespace bp {

/// Returns the message of an error with the options that would help: "...; raise --memory to at least 700 MiB, or use
/// larger voxels". The library knows what would help; the tools know the names of their options.
[[nodiscard]] std::string advised(const Error& error, const std::string& tool = "");

}  // namespace bp
