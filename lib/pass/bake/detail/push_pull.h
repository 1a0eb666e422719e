#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/texture.h"

namespace bp {

/// The knowledge about a texel: none; its colour and alpha; that it is a hole.
enum class BakedTexel : std::uint8_t { gap, color, hole };

/// Gives each texel that is not `color` a colour from nearby; alpha stays. Texels next to known ones get the mean of
/// these, since viewers blend them in at the edge. The others get means over squares of 2, 4, 8 ... texels, smallest
/// first. These show in small copies of the image only, and even squares take few bytes in a file. Means are of sRGB
/// values. O(texels); less than three bytes a texel. Does nothing if no texel is known.
void fill_gaps(TextureImage& image, const std::vector<BakedTexel>& texels);
/// Does the same for the alpha of each `gap`, if there are holes, because the edges of the gaps would show.
void fill_alpha(TextureImage& image, const std::vector<BakedTexel>& texels);

}  // namespace bp
