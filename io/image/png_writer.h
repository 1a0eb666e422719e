#pragma once
#include <string>
#include <vector>

#include "io/files/file.h"
#include "lib/image/image.h"

namespace bp {

/// Returns an 8-bit sRGB PNG without time or comments: the same bytes for the same picture (and libpng, zlib). Throws
/// bad_argument if a side is 0.
[[nodiscard]] std::vector<std::byte> encode_png(const Image& image);

/// Throws bad_argument if the name does not end in .png (case ignored). The empty name passes: no picture is wanted.
void check_png_name(const std::string& path);

/// Writes a PNG, which appears under its name when it is complete. Throws as OutputFile.
void write_png(const Image& image, const std::string& path, bool overwrite);

}  // namespace bp
