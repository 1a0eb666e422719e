#include "tests/catch.h"
#include "tools/notes/estimate.h"

using namespace bp;

TEST_CASE("an attempt with other voxels is told of if it takes long", "[quick][tools]") {
  CHECK(attempt_note(2, 0.2, 0.1).empty());
  CHECK(attempt_note(6, 0.2, 0.1) == "voxels of 0.1 instead of 0.2 are tried, since faces are left over: about 24 s");
  CHECK(attempt_note(80, 0.1, 0.2) == "voxels of 0.2 instead of 0.1 came nearer, and are taken: about 20 s");
}
