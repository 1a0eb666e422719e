#include "tests/catch.h"
#include "tools/common/face_notes.h"

using namespace bp;

TEST_CASE("clearly fewer faces than were asked for are noted, and only those", "[quick][tools]") {
  CHECK(too_few_note(1652, 20000).rfind("1652 faces instead of 20000: ", 0) == 0);
  CHECK(!too_few_note(949, 1000).empty());
  CHECK(too_few_note(950, 1000).empty());
  CHECK(too_few_note(1000, 1000).empty());
  CHECK(too_few_note(1100, 1000).empty());  // another note's business
  CHECK(too_few_note(12, 13).empty());      // closed surfaces have an even number
  CHECK(!too_few_note(12, 14).empty());
  CHECK(too_few_note(12, 0).empty());
}
