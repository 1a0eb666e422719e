#pragma once
#include <span>

namespace bp {

/// A file of the page, compressed by gzip. The build makes these from page/ (page/build.mjs).
struct PageFile {
  const char* path;  ///< "/app.js"
  const char* type;  ///< "text/javascript"
  std::span<const unsigned char> bytes;
};

/// Returns the files of the page; none if the build had no npm.
[[nodiscard]] std::span<const PageFile> page_files();

}  // namespace bp
