#pragma once
#include <string_view>

#include "lib/image/image.h"

/// Text from a bitmap font of 5 x 7 dots, ASCII; anything else shows as a box.
namespace bp {

constexpr int kGlyphWidth = 5, kGlyphHeight = 7, kGlyphAdvance = 6;

/// Pixels that `text` covers from left to right at `scale` pixels a dot; one line.
[[nodiscard]] int text_width(std::string_view text, int scale);

/// Draws one line with its upper left corner at (x, y); what lies outside the image is left out.
void draw_text(Image& image, int x, int y, std::string_view text, int scale, Color color);

}  // namespace bp
