#include "tests/catch.h"
#include "tools/notes/up_note.h"

using namespace bp;

namespace {

std::string note_on(const Vec3d& min, const Vec3d& max) {
  Bounds3d bounds;
  bounds.add(min);
  bounds.add(max);
  return up_note(bounds, false);
}

}  // namespace

TEST_CASE("a scene that may have z up is noted", "[quick][tools]") {
  CHECK_THAT(note_on({0, 0, 0}, {100, 100, 10}), ContainsSubstring("flat along z"));
  CHECK_THAT(note_on({-100, -76, -11}, {105, 77, 158}), ContainsSubstring("begins near z = 0 (at -11),"));  // a tower
  CHECK(note_on({-100, -76, -31}, {105, 77, 158}).empty());
  CHECK_THAT(note_on({8, 19, 0}, {237, 159, 76}), ContainsSubstring("stands on z = 0"));
}

TEST_CASE("a scene that may have -y up is noted", "[quick][tools]") {
  CHECK_THAT(note_on({-646, -600, -328}, {950, 8, 470}), ContainsSubstring("hangs below y = 0"));  // of LDraw
  CHECK_THAT(note_on({-646, -600, -328}, {950, 8, 470}), ContainsSubstring("say --up -y"));
  CHECK(note_on({-646, -60, -328}, {950, 0, 470}).empty());  // flat along y
}

TEST_CASE("a scene that stands on y = 0, or on nothing, is not taken for one with z up", "[quick][tools]") {
  CHECK(note_on({-15, 0, -5}, {16, 32, 4}).empty());
  CHECK(note_on({0, 0, 0}, {1, 1, 1}).empty());
  CHECK(note_on({-1, -1, -1}, {1, 1, 1}).empty());
  CHECK(note_on({0, -2, 0}, {62, 2, 62}).empty());       // flat along y
  CHECK(note_on({-5, 0, -0.15}, {5, 4, 0.15}).empty());  // a wall
}
