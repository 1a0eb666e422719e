#pragma once
#include <string>
#include <vector>

#include "io/files/file.h"
#include "lib/image/image.h"

namespace bp {

/// 8-bit sRGB without time or comments: the same bytes for the same picture (and libpng, zlib). Throws bad_argument if
/// a side is 0.
[[nodiscard]] std::vector<std::byte> encode_png(const Image& image);

/// Throws bad_argument if the name ends in anything but .png (case ignored), so that no PNG is called otherwise. The
/// empty name passes: no picture is wanted.
void check_png_name(const std::string& path);

/// Appears under its name when complete. Throws as OutputFile does.
void write_png(const Image& image, const std::string& path, bool overwrite);

}  // namespace bp
