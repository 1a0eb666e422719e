#pragma once
#include <span>

namespace bp {

/// A file of the page, gzip-compressed. The build makes them from page/ (page/build.mjs).
struct PageFile {
  const char* path;  ///< "/app.js"
  const char* type;  ///< "text/javascript"
  std::span<const unsigned char> bytes;
};

/// Empty if the build had no npm.
[[nodiscard]] std::span<const PageFile> page_files();

}  // namespace bp
