#pragma once
#include <string_view>

#include "lib/image/image.h"

namespace bp {

/// Draws text. io/image/label_font.h has one; lib/ opens no file. Text is UTF-8; bytes that are not show as U+FFFD.
class Typeface {
 public:
  virtual ~Typeface() = default;

  /// Pixels from left to right of one line, `size` pixels to the em.
  [[nodiscard]] virtual int width(std::string_view text, int size) = 0;
  /// Draws one line. (x, y) is the left end of the line that letters stand on. What lies outside the image is left out.
  virtual void draw(Image& image, int x, int y, std::string_view text, int size, Color color) = 0;
};

}  // namespace bp
