#pragma once
#include <string_view>

#include "lib/image/image.h"

namespace bp {

/// Draws text. io/image/label_font.h has an implementation; lib/ opens no file. Text is UTF-8; invalid bytes show as
/// U+FFFD.
class Typeface {
 public:
  virtual ~Typeface() = default;

  /// Returns the pixels from left to right of one line, with `size` pixels to the em.
  [[nodiscard]] virtual int width(std::string_view text, int size) = 0;
  /// Draws one line. (x, y) is the left end of the base line of the letters. Parts outside the image are left out.
  virtual void draw(Image& image, int x, int y, std::string_view text, int size, Color color) = 0;
};

}  // namespace bp
