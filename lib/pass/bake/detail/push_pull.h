#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/texture.h"

namespace bp {

/// What is known of a texel: nothing; colour and alpha; that it is a hole.
enum class BakedTexel : std::uint8_t { gap, color, hole };

/// Gives each texel that is none of `color` a colour that lies near it; alpha stays. Texels beside known ones get the
/// mean of those: viewers blend them in at the edge of what is known. The others get means over squares of 2, 4, 8 ...
/// texels, smallest first; they show in small copies of the image only, and even squares take few bytes in a file. Of
/// sRGB values. O(texels); less than three bytes a texel. Nothing if none is known.
void fill_gaps(TextureImage& image, const std::vector<BakedTexel>& texels);
/// The same for the alpha of each `gap`, if there are holes: else their edges would show.
void fill_alpha(TextureImage& image, const std::vector<BakedTexel>& texels);

}  // namespace bp
