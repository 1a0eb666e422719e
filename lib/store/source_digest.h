#pragma once
#include <string_view>

namespace bp {

/// 16 hexadecimal digits, of the sources that this was built from (cmake/source_digest.cmake): results that are kept
/// for later builds are never taken by a program that might make other ones.
[[nodiscard]] std::string_view source_digest();

}  // namespace bp
