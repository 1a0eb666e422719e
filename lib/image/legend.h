#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "lib/core/coords.h"
#include "lib/image/color_bar.h"
#include "lib/image/image.h"
#include "lib/image/typeface.h"

/// Draws the legend of a panel: lines of text and axes below it, a ruler in its lower right corner.
namespace bp {

/// Returns a round length, 1, 2 or 5 times a power of ten, that spans at most `most` (above 0, finite).
[[nodiscard]] double round_length(double most);

class Legend {
 public:
  /// `typeface`: null draws no text. `marks`: draws axes and ruler, unless panels are too small for them.
  Legend(int panel_width, Typeface* typeface, bool marks, Color ink, Color paper);

  /// Returns the lines of a label (separated by \n) as they are written. A line too long for the panel goes on in the
  /// next one. A word too long for it keeps its end, where file names differ. No typeface, no lines.
  [[nodiscard]] std::vector<std::string> lines(std::string_view label) const;
  /// Returns the pixels below a panel whose text has this many lines.
  [[nodiscard]] int height(std::size_t lines) const;

  /// Draws red x, green y and blue z with their names. `directions` of the axes: in pixels to the right, down, and away
  /// from the viewer, of length 1 if they lie in the picture. (x, y): upper left corner of the area below the panel.
  void draw_axes(Image& image, int x, int y, const std::array<Vec3d, 3>& directions) const;
  /// Draws a bar of a round length, with its length in scene units. (right, bottom): lower right corner of the panel.
  void draw_ruler(Image& image, int right, int bottom, double pixels_per_unit) const;
  /// Draws the colours of color_on_bar() with the numbers at its ends. (x, bottom): lower left corner of the panel.
  void draw_bar(Image& image, int x, int bottom, const ColorBar& bar) const;
  /// Writes text from left to right, to the right of the axes.
  void write(Image& image, int x, int y, const std::vector<std::string>& lines) const;

 private:
  [[nodiscard]] int axes_side() const;
  [[nodiscard]] bool fits(const std::string& text) const;
  [[nodiscard]] std::string end_of(std::string_view word) const;

  int width_;
  Typeface* typeface_;
  bool marks_;
  int size_;  // pixels to the em
  Color ink_, paper_;
};

}  // namespace bp
