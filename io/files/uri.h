#pragma once
#include <string>

/// File names in URIs (RFC 3986): what is neither a letter, a digit nor one of -._~/ is written as %XX.
namespace bp::detail {

[[nodiscard]] std::string percent_encoded(const std::string& path);
/// A % without two hexadecimal digits stays what it is.
[[nodiscard]] std::string percent_decoded(const std::string& uri);

}  // namespace bp::detail
