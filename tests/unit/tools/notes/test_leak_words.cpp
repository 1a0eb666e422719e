#include "tests/catch.h"
#include "tools/notes/leak_words.h"

using namespace bp;

TEST_CASE("a scale is told as one that shuts a leak only if it was tried", "[quick][notes]") {
  GridFrame frame;
  frame.voxel = 0.5;
  Leak leak;
  leak.clearance = 4;
  leak.room_clearance = 6;
  const auto text = [&](ShutTrial trial) {
    leak.trial = trial;
    return scale_text(leak, frame);
  };
  CHECK(text({ShutTrial::Answer::shut, 5}) == "--scale 2.532 shuts it, as tried there");
  CHECK(text({ShutTrial::Answer::open, 0}) == "it needs --scale 2.032 or more; none was found that shuts it");
  CHECK(text({ShutTrial::Answer::filled, 0}) ==
        "it needs --scale 2.032 or more; none was found that shuts it below 3, which fills the room");
  CHECK(text({}) == "it needs --scale 2.032 or more; it is too long or too wide to try one");
}
