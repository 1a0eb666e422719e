#pragma once
#include <vector>

#include "lib/pass/bake/detail/mip_image.h"

namespace bp {

/// Texels of an image, some of them without a colour.
struct PartialImage {
  int width = 0, height = 0;
  std::vector<LinearTexel> texels;  ///< by rows
  std::vector<float> weight;        ///< of each texel; 0: it has no colour
};

/// Gives each texel without a colour the mean of what lies nearest to it: means over squares of 2, 4, 8 ... texels,
/// smallest first. O(texels); a third of the image's bytes besides it. Nothing if no texel has a colour.
void fill_gaps(PartialImage& image);

}  // namespace bp
