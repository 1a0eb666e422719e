#pragma once
#include <functional>
#include <string>

#include "lib/core/error.h"

namespace bp {

/// Returns the message of an error with the options that would help: "...; raise --memory to at least 700 MiB, or use
/// larger voxels". The library knows what would help; the tools know the names of their options.
/// `has`: whether the tool has an option; advice on others is left out. Empty: all advice is given.
[[nodiscard]] std::string advised(const Error& error, const std::function<bool(const std::string&)>& has = {});

}  // namespace bp
