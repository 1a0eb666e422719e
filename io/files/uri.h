#pragma once
#include <string>

/// Names of files in URIs (RFC 3986): characters other than letters, digits and -._~/ are written as %XX.
namespace bp::detail {

[[nodiscard]] std::string percent_encoded(const std::string& path);
/// Decodes %XX. A % without two hexadecimal digits stays as it is.
[[nodiscard]] std::string percent_decoded(const std::string& uri);

}  // namespace bp::detail
