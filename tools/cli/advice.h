#pragma once
#include <string>

#include "lib/core/error.h"

namespace bp {

/// The message of an error and, after it, the options that would help: "...; raise --memory to at least 700 MiB, or use
/// larger voxels". The library knows what would help, the tools how it is named.
[[nodiscard]] std::string advised(const Error& error, const std::string& tool = "");

}  // namespace bp
