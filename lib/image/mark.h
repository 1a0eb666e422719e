#pragma once
#include <string>

#include "lib/core/coords.h"
#include "lib/image/image.h"
#include "lib/image/typeface.h"

namespace bp {

/// A place that a picture points at, through everything that lies before it.
struct Mark {
  Vec3d at{};        ///< scene units
  std::string text;  ///< a few letters; empty: none
};

/// Draws an arrow whose tip is at pixel (x, y), within the panel whose upper left corner is (left, top). It comes from
/// the side of the panel that is nearest, with the text at its tail. `typeface`: null draws no text. A place outside
/// the panel is left out.
void draw_mark(Image& image, int left, int top, int side, double x, double y, const std::string& text,
               Typeface* typeface);

}  // namespace bp
