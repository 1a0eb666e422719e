#include "lib/core/error.h"
#include "lib/live/design.h"
#include "tests/catch.h"

using namespace bp;

namespace {

GridFrame frame() {
  return make_frame({{0, 0, 0}, {10, 5, 4}}, 0.125);
}

RuleContext context() {
  RuleContext c;
  c.diagonal = 12;
  c.voxel = 0.125;
  c.may_orient = true;
  return c;
}

Design design(const std::string& json) {
  return {json, "rules.json", context(), frame()};
}

/// Returns the plan of the file that would be saved.
ScalePlan saved(const Design& d) {
  return parse_scale_rules(d.json(), "saved", context());
}

constexpr const char* kFiner = R"({"at": [1,2,3], "radius": "5%", "scale": "4vx", "mode": "decrease"})";
constexpr const char* kErased = R"({"at": [[1,2,3],[4,2,3]], "radius": 1, "mode": "erase"})";

}  // namespace

TEST_CASE("a design is the file of rules that it saves, after each edit, undo and redo", "[quick][live]") {
  Design d = design(R"({"base": "3%", "slope": 0.25, "rules": [{"gap": "1%"}]})");
  std::vector<std::string> texts{d.json()};
  const auto edit = [&](const auto& change) {
    change();
    texts.push_back(d.json());
    CHECK(saved(d) == d.plan());
  };
  edit([&] { d.add(kFiner); });
  edit([&] { d.add(kErased); });
  edit([&] { d.set_base("0.5"); });
  edit([&] { d.remove(1); });
  CHECK(d.rules() == 2);
  CHECK(d.plan().field.base == 0.5);
  CHECK(d.plan().field.slope == 0.25);
  for (std::size_t i = texts.size() - 1; i > 0; --i) {
    REQUIRE(d.can_undo());
    d.undo();
    CHECK(d.json() == texts[i - 1]);
    CHECK(saved(d) == d.plan());
  }
  CHECK_FALSE(d.can_undo());
  for (std::size_t i = 1; i < texts.size(); ++i) {
    REQUIRE(d.can_redo());
    d.redo();
    CHECK(d.json() == texts[i]);
  }
  CHECK_FALSE(d.can_redo());
  CHECK(d.revision() == 13);
}

TEST_CASE("an edit after an undo forgets what was undone", "[quick][live]") {
  Design d = design(R"({"base": 1})");
  d.add(kFiner);
  d.undo();
  d.add(kErased);
  CHECK_FALSE(d.can_redo());
  CHECK(d.rules() == 1);
  d.undo();
  CHECK(d.rules() == 0);
}

TEST_CASE("a slider that moves is one step", "[quick][live]") {
  Design d = design(R"({"base": 1})");
  d.set_base("0.5");
  d.set_base("0.4", true);
  d.set_base("\"2%\"", true);
  CHECK(d.base() == "\"2%\"");
  d.undo();
  CHECK(d.base() == "1");
  CHECK_FALSE(d.can_undo());
  d.redo();
  CHECK(d.base() == "\"2%\"");
}

TEST_CASE("a stroke that is drawn is one step", "[quick][live]") {
  Design d = design(R"({"base": 1})");
  d.add(kFiner);
  d.add(kErased, true);
  CHECK(d.rules() == 1);
  d.set_base("2");
  d.add(kFiner, true);
  CHECK(d.rules() == 2);
  d.undo();
  d.undo();
  d.undo();
  CHECK(d.rules() == 0);
  CHECK_FALSE(d.can_undo());
  CHECK(saved(d) == d.plan());
}

TEST_CASE("an edit that is refused changes nothing", "[quick][live]") {
  Design d = design(R"({"base": 1})");
  d.add(kFiner);
  const std::string before = d.json();
  const std::uint64_t revision = d.revision();
  for (const char* rule :
       {"", "[]", "{}", "{\"at\": [1,2,3]}", "{\"at\": [1,2,3], \"scale\": -1}", "{\"at\": 5, \"scale\": 1}",
        R"({"at": [1,2,3], "scale": 1}], "base": 3, "boxes": [)", R"({"at": [1,2,3], "scale": 1e300})",
        R"({"node": "wheel", "scale": 1})", "{\"at\": [1,2,3], \"scale\": 1, \"file\": \"/etc/passwd\"}"}) {
    CAPTURE(rule);
    CHECK_THROWS_AS(d.add(rule), Error);
  }
  CHECK_THROWS_AS(d.add(std::string(100000, '[')), Error);
  for (const char* base : {"", "-1", "\"x\"", "\"500%\"", "[1]", "1, \"slope\": 3"}) {
    CAPTURE(base);
    CHECK_THROWS_AS(d.set_base(base), Error);
  }
  CHECK_THROWS_AS(d.remove(1), Error);
  CHECK(d.json() == before);
  CHECK(d.revision() == revision);
}

TEST_CASE("names of parts stay names, and a scene is asked once for each", "[quick][live]") {
  RuleContext c = context();
  int asked = 0;
  c.parts = [&](const std::string& pattern) {
    ++asked;
    CHECK(pattern == "wheel_*");
    return std::vector<Bounds3d>{{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}};
  };
  Design d(R"({"base": 1, "rules": [{"node": "wheel_*", "scale": 0.25}]})", "rules.json", c, frame());
  d.add(kFiner);
  d.undo();
  CHECK(asked == 1);
  CHECK(d.plan().field.rules.size() == 2);
  CHECK(d.rule(0) == R"({"node":"wheel_*","scale":0.25})");
}

TEST_CASE("files of earlier versions go on as files of today", "[quick][live]") {
  Design d = design(R"({"base": 1, "boxes": [{"min": [0,0,0], "max": [1,1,1], "scale": 0.5}],
                        "strokes": [{"mode": "decrease", "position": [1,2,3], "support": 0.5, "target": 0.25}]})");
  const ScalePlan before = d.plan();
  CHECK(d.rules() == 2);
  d.add(kFiner);
  d.undo();
  CHECK(d.plan().field == before.field);
  CHECK(d.json().find("strokes") == std::string::npos);
}

TEST_CASE("of very many steps the last ones can be undone", "[quick][live]") {
  Design d = design(R"({"base": 1})");
  for (std::size_t i = 0; i < Design::kMostSteps + 10; ++i) d.add(kErased);
  std::size_t undone = 0;
  for (; d.can_undo(); ++undone) d.undo();
  CHECK(undone == Design::kMostSteps);
  CHECK(d.rules() == 10);
}

TEST_CASE("a stroke and its mirror image are one step", "[quick][live]") {
  Design d = design(R"({"base": "3%"})");
  const std::string both = std::string("[") + kFiner + "," + kErased + "]";
  d.add(both);
  CHECK(d.rules() == 2);
  d.add(both, true);  // replaces both
  CHECK(d.rules() == 2);
  CHECK(saved(d) == d.plan());
  d.undo();
  CHECK(d.rules() == 0);
  CHECK_THROWS_AS(d.add(std::string("[") + kFiner + ",5]"), Error);
  CHECK(d.rules() == 0);
}

TEST_CASE("frames of cubes are set, turned, undone and saved; wrong ones change nothing", "[quick][live]") {
  Design d = design(R"({"base": "3%"})");
  const std::string before = d.json();
  d.set_orientation(R"([{"at": [1,2,3], "frame": [1,0,0,0]}])");
  d.set_orientation(R"([{"at": [1,2,3], "frame": [1,0.5,0,0]}])", true);
  CHECK(saved(d) == d.plan());
  CHECK(d.plan().orientation == d.orientation());
  const std::string framed = d.json();
  for (const char* wrong :
       {R"("by hand")", "[]", "5", R"([{"at": [1,2,3]}])", R"([{"at": [1,2,3], "frame": [0,0,0,0]}])",
        R"([{"at": [1,2], "frame": [1,0,0,0]}])", R"([{"at": [1,2,3], "frame": [[1,0,0],[2,0,0]]}])"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(d.set_orientation(wrong), Error);
    CHECK(d.json() == framed);
  }
  d.set_orientation("null");
  CHECK(d.json() == before);
  d.undo();
  CHECK(d.json() == framed);
  d.undo();  // both turns were one step
  CHECK(d.json() == before);
}
