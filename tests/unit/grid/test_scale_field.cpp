#include <cmath>
#include <limits>
#include <random>

#include "lib/core/error.h"
#include "lib/grid/scale_field.h"
#include "tests/catch.h"

using namespace bp;

namespace {

GridFrame frame_at(std::int64_t x) {
  GridFrame frame;
  frame.voxel = 0.25;
  frame.origin = {x, -7, 3};
  return frame;
}

ScaleField random_field(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  ScaleField field;
  field.base = uniform(0, 8);
  for (int i = 0; i < 20; ++i) {
    BrushStroke s;
    s.mode = BrushMode(random() % 3);
    for (double& c : s.position) c = uniform(-40, 40);
    s.support = random() % 5 == 0 ? 0 : uniform(0, 12);
    s.target = uniform(0, 10);
    field.strokes.push_back(s);
  }
  for (int i = 0; i < 5; ++i) {
    ScaleBox b;
    for (std::size_t k = 0; k < 3; ++k) {
      b.min[k] = uniform(-40, 30);
      b.max[k] = b.min[k] + uniform(0, 30);
    }
    b.scale = uniform(0, 12);
    field.boxes.push_back(b);
  }
  return field;
}

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

TEST_CASE("a stroke has full effect within its target, none beyond its support, and is continuous", "[quick][grid]") {
  ScaleField field;
  field.base = 2;
  field.strokes = {{BrushMode::increase, {1, 2, 3}, 4, 6}};
  const auto at = [&](double t) { return field.evaluate({1 + t, 2, 3}); };
  CHECK(at(0) == 6);
  CHECK(at(5.999) == 6);
  CHECK(at(6) == 6);
  CHECK(at(8) == 2 + 4 * 0.5625);  // half of the support: (1 - 1/4)^2
  CHECK(at(10) == 2);
  CHECK(at(11) == 2);
  for (double t = 0; t < 11; t += 0.01) {
    CHECK(at(t + 0.01) <= at(t));
    CHECK(at(t) - at(t + 0.01) < 0.03);
  }
}

TEST_CASE("increase never lowers, decrease never raises, erase goes back to the base", "[quick][grid]") {
  ScaleField field;
  field.base = 3;
  field.boxes = {{{-100, -100, -100}, {100, 100, 100}, 5}};
  field.strokes = {{BrushMode::increase, {0, 0, 0}, 1, 4}, {BrushMode::decrease, {0, 0, 0}, 1, 7}};
  CHECK(field.evaluate({0, 0, 0}) == 5);
  field.strokes.push_back({BrushMode::decrease, {0, 0, 0}, 1, 1});
  CHECK(field.evaluate({0, 0, 0}) == 1);
  CHECK(field.evaluate({1.5, 0, 0}) == 5 + (1 - 5) * 0.5625);
  field.strokes.push_back({BrushMode::erase, {0, 0, 0}, 2, 99});
  CHECK(field.evaluate({0, 0, 0}) == 3);
  CHECK(field.evaluate({2.9, 0, 0}) == 3);  // full effect of an erase reaches the base scale
  CHECK(field.evaluate({20, 0, 0}) == 5);
}

TEST_CASE("of overlapping boxes the later wins, edges included", "[quick][grid]") {
  ScaleField field;
  field.base = 1;
  field.boxes = {{{0, 0, 0}, {4, 4, 4}, 2}, {{4, 0, 0}, {8, 4, 4}, 3}};
  CHECK(field.evaluate({0, 4, 0}) == 2);
  CHECK(field.evaluate({4, 1, 1}) == 3);
  CHECK(field.evaluate({8.001, 1, 1}) == 1);
}

TEST_CASE("samples are the field at voxel centres, rounded to 1/16 voxel", "[quick][grid]") {
  const std::uint32_t seed = GENERATE(range(0u, 12u));
  CAPTURE(seed);
  const ScaleField field = random_field(seed);
  const GridFrame frame = frame_at(seed % 2 ? 0 : -100);
  const VoxelBox box{{-61, -90, -70}, {75, 81, -5}};
  const ScaleLattice lattice = field.sample(frame, box);
  CHECK(lattice.origin.x == -8);
  CHECK(lattice.size.x == 19);
  Scale low = 65535, high = 0;
  std::size_t n = 0;
  for (std::int32_t z = 0; z < lattice.size.z; ++z) {
    for (std::int32_t y = 0; y < lattice.size.y; ++y) {
      for (std::int32_t x = 0; x < lattice.size.x; ++x, ++n) {
        Vec3d p;
        const std::int32_t node[3] = {x + lattice.origin.x, y + lattice.origin.y, z + lattice.origin.z};
        for (std::size_t i = 0; i < 3; ++i) p[i] = (double(frame.origin[i]) + 8 * node[i] + 0.5) * frame.voxel;
        const Scale expected = Scale(std::floor(field.evaluate(p) / frame.voxel * 16 + 0.5));
        if (lattice.samples[n] != expected) FAIL_CHECK("node " << x << " " << y << " " << z);
        low = std::min(low, expected);
        high = std::max(high, expected);
      }
    }
  }
  CHECK(n == lattice.samples.size());
  CHECK(lattice.min == low);
  CHECK(lattice.max == high);
  CHECK(lattice.max <= field.upper_bound(frame));
}

TEST_CASE("two overlapping boxes have the same scale where they overlap", "[quick][grid]") {
  const std::uint32_t seed = GENERATE(range(0u, 8u));
  const ScaleField field = random_field(seed);
  const GridFrame frame = frame_at(5);
  const VoxelBox a{{-100, -64, -3}, {40, 60, 61}}, b{{-13, -71, 2}, {64, 3, 90}};
  const ScaleLattice sa = field.sample(frame, a), sb = field.sample(frame, b);
  const VoxelBox both = intersect(a, b);
  int differing = 0;
  for (std::int32_t z = both.min.z; z < both.max.z; ++z) {
    for (std::int32_t y = both.min.y; y < both.max.y; y += 3) {
      for (std::int32_t x = both.min.x; x < both.max.x; ++x) differing += sa.at({x, y, z}) != sb.at({x, y, z});
    }
  }
  CHECK(differing == 0);
}

TEST_CASE("the scale of a voxel is the floor of the trilinear sum", "[quick][grid]") {
  std::mt19937 random(7);
  ScaleLattice lattice;
  lattice.origin = {-2, -1, 3};
  lattice.size = {4, 3, 2};
  for (int i = 0; i < 24; ++i) lattice.samples.push_back(Scale(i == 0 ? 65535 : random() % 65536));
  for (std::int32_t z = 24; z < 32; ++z) {
    for (std::int32_t y = -8; y < 8; ++y) {
      for (std::int32_t x = -16; x < 8; ++x) {
        std::uint64_t sum = 0;
        for (std::int32_t k = 0; k < 2; ++k) {
          for (std::int32_t j = 0; j < 3; ++j) {
            for (std::int32_t i = 0; i < 4; ++i) {
              const std::int32_t d[3] = {std::abs(8 * (i - 2) - x), std::abs(8 * (j - 1) - y),
                                         std::abs(8 * (k + 3) - z)};
              if (d[0] >= 8 || d[1] >= 8 || d[2] >= 8) continue;
              sum += std::uint64_t((8 - d[0]) * (8 - d[1]) * (8 - d[2])) *
                     lattice.samples[std::size_t((k * 3 + j) * 4 + i)];
            }
          }
        }
        if (lattice.at({x, y, z}) != sum / 512) FAIL_CHECK("voxel " << x << " " << y << " " << z);
      }
    }
  }
}

TEST_CASE("a constant field has constant samples, also in an empty box", "[quick][grid]") {
  ScaleField field;
  field.base = 5;
  const ScaleLattice lattice = field.sample(frame_at(0), {{0, 0, 0}, {64, 64, 64}});
  CHECK(lattice.constant());
  CHECK(lattice.min == 320);
  CHECK(lattice.samples.size() == 9 * 9 * 9);
  CHECK(lattice.at({63, 63, 63}) == 320);
  CHECK(field.sample(frame_at(0), {}).max == 320);
}

TEST_CASE("scales that have no samples are refused", "[quick][grid]") {
  const double bad = GENERATE(-1.0, std::nan(""), std::numeric_limits<double>::infinity(), 0.25 * 4096);
  const GridFrame frame = frame_at(0);
  ScaleField field;
  field.base = 0.25 * 4095;
  CHECK(field.upper_bound(frame) == 4095 * 16);
  field.base = bad;
  CHECK_THROWS_AS(field.upper_bound(frame), Error);
  CHECK_THROWS_AS(field.sample(frame, {{0, 0, 0}, {8, 8, 8}}), Error);
  field.base = 1;
  field.strokes = {{BrushMode::decrease, {}, 1, bad}};
  CHECK_THROWS_AS(field.upper_bound(frame), Error);
  field.strokes.clear();
  field.boxes = {{{}, {}, bad}};
  CHECK_THROWS_AS(field.upper_bound(frame), Error);
}

TEST_CASE("a scale field survives its text, and equal fields have equal texts", "[quick][grid]") {
  ScaleField field = random_field(GENERATE(range(0u, 6u)));
  CHECK(parse_scale_field(to_json(field), "x") == field);
  field.strokes[0].position = {-0.0, 0.0, 1};
  const std::string text = to_json(field);
  field.strokes[0].position = {0.0, 0.0, 1};
  CHECK(to_json(field) == text);
  CHECK(to_json(parse_scale_field(R"({"base":2})", "x")) == R"({"base":2.0,"strokes":[],"boxes":[]})");
}

TEST_CASE("an erase stroke needs no target", "[quick][grid]") {
  const ScaleField f =
      parse_scale_field(R"({"base":1,"strokes":[{"mode":"erase","position":[0,1,2],"support":3}]})", "x");
  CHECK(f.strokes.at(0) == BrushStroke{BrushMode::erase, {0, 1, 2}, 3, 0});
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

TEST_CASE("a scale is reached along a line only where it is at every point of it", "[quick][grid]") {
  const ScaleField field = random_field(GENERATE(range(0u, 8u)));
  std::mt19937 random(5);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  int reached = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3d a{uniform(-40, 40), uniform(-40, 40), uniform(-40, 40)};
    const double length = uniform(0, 20);
    const Vec3d b{a[0] + uniform(-length, length), a[1] + uniform(-length, length), a[2] + uniform(-length, length)};
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 500; ++k) {
      const double t = k / 500.0;
      least = std::min(least,
                       field.evaluate({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])}));
    }
    CAPTURE(i, least);
    reached += field.reaches_along(a, b, 0.95 * least, 0.01);
    CHECK_FALSE(field.reaches_along(a, b, 1.001 * least + 0.1, 0.01));
  }
  CHECK(reached > 290);  // pieces of 0.01 may straddle what the 500 samples pass by
}

TEST_CASE("a thin box is found between the ends of a line", "[quick][grid]") {
  ScaleField field;
  field.base = 8;
  field.boxes.push_back({{4.9, -1, -1}, {5.1, 1, 1}, 2});
  field.boxes.push_back({{-9, -9, 3}, {0, 9, 9}, 6});  // two that touch
  field.boxes.push_back({{0, -9, 3}, {9, 9, 9}, 7});
  CHECK_FALSE(field.reaches_along({-9, 0, 0}, {90, 0, 0}, 3, 0.1));
  CHECK(field.reaches_along({-9, 0, 0}, {90, 0, 0}, 2, 0.1));
  CHECK(field.reaches_along({-9, 0, 2}, {90, 0, 2}, 8, 0.1));
  CHECK(field.reaches_along({-9, 0, 5}, {9, 0, 5}, 6, 0.1));
  CHECK_FALSE(field.reaches_along({-9, 0, 5}, {9, 0, 5}, 6.5, 0.1));
}
