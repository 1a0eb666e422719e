#include "lib/image/canvas.h"
#include "tests/catch.h"

using namespace bp;

TEST_CASE("normals of corners decide the shade, and it is linear between them", "[quick][image]") {
  const TriangleD t{{{0, 0, 1}, {200, 0, 1}, {0, 200, 1}}};
  const auto draw = [&](const std::vector<Canvas::Normals>& normals, bool colored) {
    Canvas canvas(200, 200, {0, 0, 0});
    const TriangleColors white{};
    if (colored) {
      canvas.draw(std::span(&t, 1), std::span(&white, 1), normals);
    } else {
      canvas.draw(std::span(&t, 1), Color{255, 255, 255}, normals);
    }
    Image image(100, 100, {});
    canvas.resolve(image, 0, 0);
    return image;
  };
  const Vec3d front{0, 0, 1}, right{-0.8, 0, 0.6}, none{};  // the triangle faces away, so they are turned
  for (const bool colored : {false, true}) {
    const Image flat = draw({}, colored);
    CHECK(draw({{front, front, front}}, colored).pixels == flat.pixels);
    CHECK(draw({{none, none, none}}, colored).pixels == flat.pixels);
    const Image bent = draw({{front, right, front}}, colored);
    CHECK(std::abs(int(bent.at(1, 1).r) - int(flat.at(1, 1).r)) <= 2);
    CHECK(int(bent.at(95, 1).r) < int(flat.at(95, 1).r) - 40);
    CHECK(std::abs(2 * int(bent.at(49, 1).r) - int(bent.at(1, 1).r) - int(bent.at(97, 1).r)) <= 3);
  }
}
