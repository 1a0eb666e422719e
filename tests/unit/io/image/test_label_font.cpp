#include <algorithm>

#include "io/image/label_font.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

// The form of letters depends on the font and on FreeType, so only properties that hold for all of them are tested.

namespace {

const Color kPaper{255, 255, 255}, kInk{10, 20, 30};

std::size_t written(const Image& image) {
  return std::size_t(std::count_if(image.pixels.begin(), image.pixels.end(), [](Color c) { return c != kPaper; }));
}

}  // namespace

TEST_CASE("without a font that can be read there is no typeface, and no error", "[quick][io]") {
  const TempDir dir;
  const std::vector<std::string> none,
      useless{dir.path("missing.ttf"), dir.file("broken.ttf", "no font"), dir.file("empty.ttf", ""), dir.path("")};
  CHECK(open_label_font(none) == nullptr);
  CHECK(open_label_font(useless) == nullptr);
}

TEST_CASE("a label font draws what it measures, clipped, and the same again", "[quick][io]") {
  const auto font = open_label_font();
  if (font == nullptr) {
    WARN("no font is installed; labels are not tested");
    return;
  }
  const int width = font->width("proxy.glb", 15);
  CHECK(width > 40);
  CHECK(width < 9 * 15);
  CHECK(font->width("", 15) == 0);
  CHECK(font->width("proxy.glb proxy.glb", 15) > 2 * width);
  CHECK(std::abs(font->width("proxy.glb", 30) - 2 * width) < 12);
  Image image(200, 30, kPaper), again = image;
  font->draw(image, 5, 20, "proxy.glb", 15, kInk);
  font->draw(again, 5, 20, "proxy.glb", 15, kInk);
  CHECK(image.pixels == again.pixels);
  CHECK(written(image) > 100);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (x < 3 || x > 5 + width + 2 || y < 4 || y > 25) CHECK(image.at(x, y) == kPaper);
  for (const int x : {-1000, -30, 180, 5000}) font->draw(image, x, 3, "clipped", 32, kInk);
  font->draw(image, 0, -50, "clipped", 15, kInk);
  font->draw(image, 0, 5000, "clipped", 15, kInk);
}

TEST_CASE("text that is no UTF-8 is drawn all the same", "[quick][io]") {
  const auto font = open_label_font();
  if (font == nullptr) return;
  const std::string replacement = "\xEF\xBF\xBD";
  const int one = font->width(replacement, 20);
  CHECK(one > 0);
  for (const char* bad : {"\xFF", "\x80", "\xC0", "\xC3", "\xF5", "\xE2"}) CHECK(font->width(bad, 20) == one);
  CHECK(font->width("\xC3(", 20) == one + font->width("(", 20));
  CHECK(font->width("\xE2\x82", 20) == 2 * one);
  Image image(60, 30, kPaper);
  font->draw(image, 0, 20, "a\xFF\xC3", 20, kInk);
  CHECK(written(image) > 20);
}
