#include "tests/catch.h"
#include "tools/notes/scale_notes.h"

using namespace bp;

namespace {

StreamHeader header() {
  StreamHeader h;
  h.frame.voxel = 0.5;
  h.bounds.add({0, 0, 0});
  h.bounds.add({10, 10, 10});
  return h;
}

}  // namespace

TEST_CASE("a scale below one voxel is noted, one voxel is not", "[quick][tools]") {
  ScaleField field;
  field.base = 0.45;
  CHECK(scale_notes(field, header()).size() == 1);
  field.base = 0.5;
  CHECK(scale_notes(field, header()).empty());
  field.base = 0;
  field.rules.push_back(box_rule({1, 1, 1}, {2, 2, 2}, 3));
  CHECK(scale_notes(field, header()).empty());
}

TEST_CASE("rules that the closing cannot reach are noted", "[quick][tools]") {
  ScaleField field;
  field.base = 2;
  field.rules = {box_rule({1, 1, 1}, {2, 2, 2}, 1), box_rule({14, 0, 0}, {20, 5, 5}, 1),
                 box_rule({11, 0, 0}, {20, 5, 5}, 1)};
  const std::vector<std::string> notes = scale_notes(field, header());
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("box 14,0,0 to 20,5,5 is nowhere") == 0);
}

TEST_CASE("of an opening, a small scale is said to take nothing away", "[quick][tools]") {
  ScaleField field;
  field.base = 0.1;
  REQUIRE(scale_notes(field, header(), true).size() == 1);
  CHECK(scale_notes(field, header(), true)[0].find("opening") != std::string::npos);
}
