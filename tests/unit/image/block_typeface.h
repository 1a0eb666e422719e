#pragma once
#include <string>
#include <vector>

#include "lib/image/typeface.h"

/// A typeface that needs no font: each byte is a block, half as wide as high.
namespace bp::test {

class BlockTypeface final : public Typeface {
 public:
  int width(std::string_view text, int size) override { return int(text.size()) * (size / 2); }
  void draw(Image& image, int x, int y, std::string_view text, int size, Color color) override {
    lines.emplace_back(text);
    for (int j = y - size; j < y; ++j)
      for (int i = x; i < x + width(text, size); ++i)
        if (i >= 0 && j >= 0 && i < image.width && j < image.height) image.at(i, j) = color;
  }
  std::vector<std::string> lines;  ///< that were drawn
};

}  // namespace bp::test
