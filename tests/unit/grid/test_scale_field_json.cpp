#include "lib/core/error.h"
#include "lib/grid/scale_field.h"
#include "tests/catch.h"
#include "tests/unit/grid/random_fields.h"

using namespace bp;
using namespace bp::test;

namespace {

std::string error_of(const std::string& json) {
  try {
    (void)parse_scale_field(json, "f.json");
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::bad_input);
    return e.what();
  }
  return "";
}

bool names(const std::string& message, const std::string& part) {
  CAPTURE(message, part);
  return message.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("files of earlier versions hold boxes, then strokes", "[quick][grid]") {
  const ScaleField old =
      parse_scale_field(R"({"base":1,"strokes":[{"mode":"decrease","position":[0,1,2],"support":3,"target":0.5}],)"
                        R"("boxes":[{"min":[0,0,0],"max":[1,1,1],"scale":2}]})",
                        "x");
  CHECK(old.rules ==
        std::vector{box_rule({0, 0, 0}, {1, 1, 1}, 2), stroke_rule(ScaleMode::decrease, {0, 1, 2}, 3, 0.5, 1)});
}

TEST_CASE("a file of rules gives lengths in scene units, in percent of the diagonal or in voxels", "[quick][grid]") {
  RuleContext context;
  context.diagonal = 200;
  context.voxel = 0.5;
  context.parts = [](const std::string& pattern) {
    return pattern == "pipe_*" ? std::vector<Bounds3d>{{{0, 0, 0}, {1, 2, 3}}, {{5, 5, 5}, {6, 6, 6}}}
                               : std::vector<Bounds3d>{};
  };
  const ScalePlan plan = parse_scale_rules(
      R"({"base":"2%","slope":0.25,"rules":[
        {"at":[1,2,3],"scale":"3vx"},
        {"at":[[1,2,3],[4,5,6]],"radius":"1%","support":7,"scale":1,"mode":"increase","name":"arm"},
        {"box":[[0,0,0],[1,1,1]],"mode":"erase"},
        {"node":"pipe_*","radius":1,"scale":0.5},
        {"gap":"6vx","mode":"decrease"},
        {"thickness":1,"scale":"1vx","name":"rails"},
        {"view":[[9,9,9]],"per_distance":0.01,"scale":8}]})",
      "x", context);
  const ScaleField& field = plan.field;
  CHECK(field.base == 4);
  CHECK(field.slope == 0.25);
  REQUIRE(field.rules.size() == 6);
  CHECK(field.rules[0] == ScaleRule{ScaleShape::path, ScaleMode::set, {{1, 2, 3}}, 1.5, -1, 0, 1.5, ""});
  CHECK(field.rules[1] == ScaleRule{ScaleShape::path, ScaleMode::increase, {{1, 2, 3}, {4, 5, 6}}, 2, 7, 0, 1, "arm"});
  CHECK(field.rules[2] == ScaleRule{ScaleShape::box, ScaleMode::erase, {{0, 0, 0}, {1, 1, 1}}, 0, -1, 0, 0, ""});
  CHECK(field.rules[3] == ScaleRule{ScaleShape::box, ScaleMode::set, {{0, 0, 0}, {1, 2, 3}}, 1, -1, 0, 0.5, "pipe_*"});
  CHECK(field.rules[4].points == std::vector<Vec3d>{{5, 5, 5}, {6, 6, 6}});
  CHECK(field.rules[5] == ScaleRule{ScaleShape::view, ScaleMode::increase, {{9, 9, 9}}, 0, -1, 0.01, 8, ""});
  CHECK(parse_scale_field(to_json(field), "x") == field);
  const ShapeRule gap{ShapeRule::Kind::gap, 3, 0, ScaleMode::decrease, "openings"};
  const ShapeRule thickness{ShapeRule::Kind::thickness, 1, 0.5, ScaleMode::set, "rails"};
  CHECK(plan.entries == std::vector<RuleEntry>{{1, {}}, {1, {}}, {1, {}}, {2, {}}, {0, gap}, {0, thickness}, {1, {}}});
  const ScalePlan again = parse_scale_rules(to_json(plan), "x", {});
  CHECK(again.field == field);
  CHECK(again.entries.size() == plan.entries.size() + 1);  // the parts are boxes
  CHECK(again.entries[5] == plan.entries[4]);
  CHECK(again.entries[6] == plan.entries[5]);
}

TEST_CASE("rules by shape are refused in streams, and where they are longer than the scene", "[quick][grid]") {
  CHECK_THROWS_AS(parse_scale_field(R"({"base":1,"rules":[{"gap":2}]})", "x"), Error);
  RuleContext context;
  context.diagonal = 10;
  CHECK_THROWS_AS(parse_scale_rules(R"({"base":1,"rules":[{"gap":11}]})", "x", context), Error);
  CHECK_THROWS_AS(parse_scale_rules(R"({"base":1,"rules":[{"thickness":"101%"}]})", "x", context), Error);
  CHECK(parse_scale_rules(R"({"base":1,"rules":[{"gap":10}]})", "x", context).entries.size() == 1);
}

TEST_CASE("a scale field survives its text, and equal fields have equal texts", "[quick][grid]") {
  ScaleField field = random_field(GENERATE(range(0u, 6u)));
  CHECK(parse_scale_field(to_json(field), "x") == field);
  field.rules[0].points[0] = {-0.0, 0.0, 1};
  const std::string text = to_json(field);
  field.rules[0].points[0] = {0.0, 0.0, 1};
  CHECK(to_json(field) == text);
  CHECK(to_json(parse_scale_field(R"({"base":2})", "x")) == R"({"base":2.0})");
}

TEST_CASE("an erase stroke needs no target", "[quick][grid]") {
  const ScaleField f =
      parse_scale_field(R"({"base":1,"strokes":[{"mode":"erase","position":[0,1,2],"support":3}]})", "x");
  CHECK(f.rules.at(0) == stroke_rule(ScaleMode::erase, {0, 1, 2}, 3, 0, 1));
}

TEST_CASE("a broken scale field is refused by the key at fault", "[quick][grid]") {
  CHECK(names(error_of("{"), "f.json: scale field: not valid JSON at byte 2"));
  CHECK(names(error_of(""), "not valid JSON"));
  CHECK(names(error_of("[]"), "the document is not an object"));
  CHECK(names(error_of("{}"), "base is missing"));
  CHECK(names(error_of(R"({"base":"2"})"), "base is not a number"));
  CHECK(names(error_of(R"({"base":-2})"), "base is negative"));
  CHECK(names(error_of(R"({"base":NaN})"), "not valid JSON"));
  CHECK(names(error_of(R"({"base":1e999})"), "too large"));
  CHECK(names(error_of(R"({"base":1,"bass":2})"), "unknown key 'bass'"));
  CHECK(names(error_of(R"({"base":1,"base":2})"), "'base' appears twice"));
  CHECK(names(error_of(R"({"base":1,"rules":[],"boxes":[]})"), "has 'rules' and"));
  const auto rule = [](const std::string& s) { return error_of(R"({"base":1,"rules":[{)" + s + "}]}"); };
  CHECK(names(rule(R"("scale":1)"), "rules[0] says no place"));
  CHECK(names(rule(R"("at":[0,0,0],"box":[],"scale":1)"), "rules[0] has both 'at' and 'box'"));
  CHECK(names(rule(R"("at":[0,0,0])"), "rules[0].scale is missing"));
  CHECK(names(rule(R"("at":[0,0,0],"scale":"2%")"), "rules[0].scale is not a number"));
  CHECK(names(rule(R"("at":[],"scale":1)"), "rules[0].at is an empty list"));
  CHECK(names(rule(R"("at":[[0,0,0],[1,1]],"scale":1)"), "rules[0].at[1] is not a list of three"));
  CHECK(names(rule(R"("at":[0,0,0],"scale":1,"mode":"up")"), "rules[0].mode is none of set, increase"));
  CHECK(names(rule(R"("at":[0,0,0],"scale":1,"radios":1)"), "unknown key 'rules[0].radios'"));
  CHECK(names(rule(R"("box":[[0,0,0]],"scale":1)"), "rules[0].box is not a list of two points"));
  CHECK(names(rule(R"("box":[[0,0,0],[1,-1,1]],"scale":1)"), "min above its max"));
  CHECK(names(rule("\"at\":[0,0,0],\"scale\":1,\"name\":\"\\u001b\""), "rules[0].name holds control characters"));
  CHECK(names(rule(R"("node":"x","scale":1)"), "rules[0].node names parts of a scene"));
  CHECK(names(rule(R"("view":[0,0,0],"scale":1)"), "rules[0].per_distance is missing"));
  CHECK(names(rule(R"("view":[0,0,0],"per_distance":0.6,"scale":1)"), "is above the slope"));
  CHECK(names(rule(R"("view":[0,0,0],"per_distance":0.1,"scale":1,"mode":"erase")"), "as a view needs"));
  CHECK(names(error_of(R"({"base":1,"strokes":{}})"), "strokes is not a list"));
  CHECK(names(error_of(R"({"base":1,"strokes":[4]})"), "strokes[0] is not an object"));
  const auto stroke = [](const std::string& s) { return error_of(R"({"base":1,"strokes":[{)" + s + "}]}"); };
  CHECK(names(stroke(R"("mode":"up","position":[0,0,0],"support":1,"target":1)"), "strokes[0].mode is none of"));
  CHECK(names(stroke(R"("mode":"increase","position":[0,0],"support":1,"target":1)"), "strokes[0].position"));
  CHECK(names(stroke(R"("mode":"increase","position":[0,0,"a"],"support":1,"target":1)"), "strokes[0].position[2]"));
  CHECK(names(stroke(R"("mode":"increase","position":[0,0,0],"support":-1,"target":1)"), "strokes[0].support"));
  CHECK(names(stroke(R"("mode":"increase","position":[0,0,0],"support":1)"), "strokes[0].target is missing"));
  CHECK(names(stroke(R"("mode":"erase","position":[0,0,0],"support":1,"size":1)"), "strokes[0].size"));
  CHECK(names(error_of(R"({"base":1,"boxes":[{"min":[0,0,0],"max":[1,-1,1],"scale":1}]})"), "min above its max"));
  CHECK(names(error_of(R"({"base":1,"boxes":[{"min":[0,0,0],"max":[1,1,1]}]})"), "boxes[0].scale is missing"));
}
