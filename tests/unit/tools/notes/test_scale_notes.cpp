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

std::vector<std::string> notes_of(const ScaleField& field, const StreamHeader& h = header()) {
  return scale_notes({field, std::vector<RuleEntry>(field.rules.size())}, h);
}

}  // namespace

TEST_CASE("a scale below one voxel is noted, one voxel is not", "[quick][tools]") {
  ScaleField field;
  field.base = 0.45;
  CHECK(notes_of(field).size() == 1);
  field.base = 0.5;
  CHECK(notes_of(field).empty());
  field.base = 0;
  field.rules.push_back(box_rule({1, 1, 1}, {2, 2, 2}, 3));
  CHECK(notes_of(field).empty());
}

TEST_CASE("rules that the closing cannot reach are noted", "[quick][tools]") {
  ScaleField field;
  field.base = 2;
  field.rules = {box_rule({1, 1, 1}, {2, 2, 2}, 1), box_rule({14, 0, 0}, {20, 5, 5}, 1),
                 box_rule({11, 0, 0}, {20, 5, 5}, 1)};
  const std::vector<std::string> notes = notes_of(field);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("box 14,0,0 to 20,5,5 is nowhere") == 0);
}

TEST_CASE("of an opening, a small scale is said to take nothing away", "[quick][tools]") {
  ScaleField field;
  field.base = 0.1;
  StreamHeader inside = header();
  inside.fill = FillMode::inside;
  REQUIRE(notes_of(field, inside).size() == 1);
  CHECK(notes_of(field, inside)[0].find("opening") != std::string::npos);
}

TEST_CASE("rules by shape that find nothing, or are below a voxel, are noted", "[quick][tools]") {
  ShapeRule gap;
  gap.length = 3;
  gap.name = "streets";
  ScalePlan plan;
  plan.field.base = 2;
  plan.entries = {{0, gap}};
  REQUIRE(scale_notes(plan, header()).size() == 1);
  CHECK(scale_notes(plan, header())[0].find("streets: this rule changes no scale") == 0);
  plan.entries[0].shape->length = 0.4;
  REQUIRE(scale_notes(plan, header()).size() == 1);
  CHECK(scale_notes(plan, header())[0].find("less than a voxel (0.5)") != std::string::npos);
  plan.entries[0] = {1, gap};
  plan.field.rules = {box_rule({1, 1, 1}, {2, 2, 2}, 1)};
  CHECK(scale_notes(plan, header()).empty());
}
