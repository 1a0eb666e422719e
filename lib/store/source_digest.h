#pragma once
#include <string_view>

namespace bp {

/// Returns 16 hexadecimal digits of the sources of this build (cmake/source_digest.cmake). They enter the keys of kept
/// results, so a program that might make other results never takes them.
[[nodiscard]] std::string_view source_digest();

}  // namespace bp
