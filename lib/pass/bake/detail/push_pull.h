#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/texture.h"

namespace bp {

/// Gives each texel that is not `known` (1: it is, 0: it is not) a colour that lies near it; alpha stays. Texels beside
/// known ones get the mean of those: viewers blend them in at the edge of what is known. The others get means over
/// squares of 2, 4, 8 ... texels, smallest first; they show in small copies of the image only, and even squares take
/// few bytes in a file. Of sRGB values. O(texels); less than three bytes a texel. Nothing if none is known.
void fill_gaps(TextureImage& image, std::vector<std::uint8_t> known);

}  // namespace bp
