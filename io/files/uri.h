#pragma once
#include <string>

/// Names of files in URIs (RFC 3986): characters other than letters, digits and -._~/ are written as %XX.
namespace bp {

/// The file that a URI names. Exactly one of the two is empty.
struct UriFile {
  std::string path;
  std::string fault;  ///< why no file here is surely the one that other programs open; a phrase after the URI's owner
};

/// Returns the file beside a document in `folder` (empty: the current one). A query and a fragment are cut off, as
/// viewers do before they ask a server for the rest. URIs that programs take in different ways are faults: a scheme, an
/// absolute path, a backslash, blanks at the ends, control characters, and %XX for any of these or for a slash.
[[nodiscard]] UriFile file_of_uri(const std::string& uri, const std::string& folder);

namespace detail {

[[nodiscard]] std::string percent_encoded(const std::string& path);

}  // namespace detail

}  // namespace bp
