#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/texture.h"

namespace bp {

/// Gives each texel that is not `known` the colour that lies nearest to it: means over squares of 2, 4, 8 ... texels,
/// smallest first; alpha stays. Of sRGB values: nobody sees them but as a blend at the edge of what is known.
/// O(texels); less than two bytes a texel. Nothing if none is known.
void fill_gaps(TextureImage& image, const std::vector<std::uint8_t>& known);

}  // namespace bp
