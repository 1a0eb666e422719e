#include <algorithm>
#include <cmath>

#include "lib/image/legend.h"
#include "tests/catch.h"
#include "tests/unit/image/block_typeface.h"

using namespace bp;
using namespace bp::test;

namespace {

const Color kPaper{255, 255, 255}, kInk{0, 0, 0};

/// Columns that hold a dark pixel, first and last.
std::pair<int, int> dark_columns(const Image& image) {
  int first = image.width, last = -1;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.at(x, y) == kInk) first = std::min(first, x), last = std::max(last, x);
  return {first, last};
}

}  // namespace

TEST_CASE("a round length is 1, 2 or 5 times a power of ten, and as long as it may be", "[quick][image]") {
  for (const double most : {1e-300, 3e-7, 0.00099, 0.001, 0.0021, 0.05, 0.4999, 1.0, 1.99, 7.0, 123456.0, 1e300}) {
    const double length = round_length(most);
    CAPTURE(most, length);
    CHECK(length <= most * (1 + 1e-9));
    CHECK(length * 2.5 > most * (1 - 1e-9));
    const double first_digit = length / std::pow(10, std::floor(std::log10(length * (1 + 1e-9))));
    CHECK((std::abs(first_digit - 1) < 1e-9 || std::abs(first_digit - 2) < 1e-9 || std::abs(first_digit - 5) < 1e-9));
  }
}

TEST_CASE("a ruler is as long as its words say", "[quick][image]") {
  BlockTypeface typeface;
  for (const double pixels_per_unit : {0.03, 1.0, 77.7, 123456.0}) {
    Image with(400, 60, kPaper), without(400, 60, kPaper);
    Legend(400, &typeface, true, kInk, kPaper).draw_ruler(with, 400, 60, pixels_per_unit);
    Legend(400, nullptr, true, kInk, kPaper).draw_ruler(without, 400, 60, pixels_per_unit);
    const auto [first, last] = dark_columns(without);
    const double units = std::stod(typeface.lines.back());
    CAPTURE(pixels_per_unit, units);
    CHECK(std::abs(last + 1 - first - units * pixels_per_unit) <= 1);
    CHECK(last + 1 - first >= 40);
    CHECK(last < 400);
    CHECK(dark_columns(with).first < first);  // its length stands to the left of it
  }
  CHECK(typeface.lines.front().find(" units") != std::string::npos);
  Image same(400, 60, kPaper);
  for (const double nonsense : {0.0, -1.0, std::nan(""), HUGE_VAL})
    Legend(400, nullptr, true, kInk, kPaper).draw_ruler(same, 400, 60, nonsense);
  CHECK(dark_columns(same).second == -1);
}

TEST_CASE("axes are red, green and blue where they point to, and are named", "[quick][image]") {
  BlockTypeface typeface;
  const Legend legend(480, &typeface, true, kInk, kPaper), mute(480, nullptr, true, kInk, kPaper);
  const int side = mute.height(0);
  Image image(480, side, kPaper), named(480, side, kPaper);
  const std::array<Vec3d, 3> directions{Vec3d{1, 0, 0}, Vec3d{0, -1, 0}, Vec3d{0, 0, 1}};
  mute.draw_axes(image, 0, 0, directions);
  const Color right = image.at(side * 7 / 10, side / 2), up = image.at(side / 2, side * 3 / 10);
  CHECK((right.r > 150 && right.g < 120 && right.b < 120));
  CHECK((up.g > up.r + 40 && up.g > up.b + 40));
  CHECK(image.at(side * 3 / 10, side / 2) == kPaper);
  legend.draw_axes(named, 0, 0, directions);
  std::sort(typeface.lines.begin(), typeface.lines.end());
  CHECK(typeface.lines == std::vector<std::string>{"x", "y", "z"});
}

TEST_CASE("lines too long for a panel go on in the next one, words too long keep their end", "[quick][image]") {
  using Lines = std::vector<std::string>;
  BlockTypeface typeface;  // 4 pixels a character at this size
  const Legend legend(200, &typeface, false, kInk, kPaper);
  CHECK(legend.lines("").empty());
  CHECK(legend.lines("proxy.glb\n12 triangles\n\nlast") == Lines{"proxy.glb", "12 triangles", "", "last"});
  CHECK(legend.lines("x -0.000213 to 0.000213, y -0.000468 to 0.000462, z -0.000386 to 0.000392") ==
        Lines{"x -0.000213 to 0.000213, y -0.000468 to", "0.000462, z -0.000386 to 0.000392"});
  const Lines name = legend.lines("a/very/long/name/of/a/file/that/no/panel/can/hold/x_LOD0.glb");
  REQUIRE(name.size() == 1);
  CHECK(name[0].starts_with("..."));
  CHECK(name[0].ends_with("/hold/x_LOD0.glb"));
  const std::string letter = "\xC3\xA4";
  const Lines tiny = Legend(40, &typeface, false, kInk, kPaper).lines(letter + letter + letter + letter + letter);
  CHECK(tiny == Lines{"..." + letter + letter});  // no half of a character
  CHECK(Legend(200, nullptr, false, kInk, kPaper).lines("a\nb").empty());
  Image image(240, 100, kPaper);
  legend.write(image, 10, 0, name);
  CHECK(dark_columns(image).first >= 10);
  CHECK(dark_columns(image).second < 210);
}

TEST_CASE("small panels have no marks, and nothing is below a panel without text", "[quick][image]") {
  BlockTypeface typeface;
  CHECK(Legend(99, &typeface, true, kInk, kPaper).height(0) == 0);
  CHECK(Legend(99, nullptr, true, kInk, kPaper).height(3) == 0);
  CHECK(Legend(720, &typeface, false, kInk, kPaper).height(0) == 0);
  CHECK(Legend(720, nullptr, true, kInk, kPaper).height(3) > 30);
  CHECK(Legend(720, &typeface, false, kInk, kPaper).height(2) > Legend(720, &typeface, false, kInk, kPaper).height(1));
  Image image(99, 40, kPaper);
  Legend(99, &typeface, true, kInk, kPaper).draw_ruler(image, 99, 40, 1);
  Legend(99, &typeface, true, kInk, kPaper).draw_axes(image, 0, 0, {});
  CHECK(std::all_of(image.pixels.begin(), image.pixels.end(), [](Color c) { return c == kPaper; }));
}
