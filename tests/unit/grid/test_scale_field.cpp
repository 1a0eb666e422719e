#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "lib/core/box.h"
#include "lib/core/error.h"
#include "lib/grid/scale_field.h"
#include "tests/catch.h"
#include "tests/unit/grid/random_fields.h"

using namespace bp;
using namespace bp::test;

namespace {

GridFrame frame_at(std::int64_t x) {
  GridFrame frame;
  frame.voxel = 0.25;
  frame.origin = {x, -7, 3};
  return frame;
}

/// The text of docs/bpscale.1.md, word by word: a rule on a scale, `t` away from the shape.
double defined(const ScaleField& field, const ScaleRule& rule, double t, double before) {
  const double goal = rule.mode == ScaleMode::erase ? field.base : rule.scale, beyond = std::max(t - rule.radius, 0.0);
  double s = 0;
  if (rule.shape == ScaleShape::view) {
    s = std::min(rule.per_distance * t, rule.scale);
  } else if (rule.support < 0) {
    const double most = goal + field.slope * beyond, least = goal - field.slope * beyond;
    s = before > most ? most : before < least ? least : before;
  } else {
    const double u = rule.support > 0 ? beyond / rule.support : t < rule.radius || t == 0 ? 0 : 1;
    const double gamma = u < 1 ? (1 - u * u) * (1 - u * u) : 0;
    s = (1 - gamma) * before + gamma * goal;
  }
  if (rule.mode == ScaleMode::increase) return std::max(s, before);
  if (rule.mode == ScaleMode::decrease) return std::min(s, before);
  return s;
}

double distance(const Vec3d& a, const Vec3d& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// By trying points of the shape: at most `step` too large.
double distance_by_trial(const ScaleRule& rule, const Vec3d& p) {
  double least = std::numeric_limits<double>::infinity();
  if (rule.shape == ScaleShape::box) {
    Vec3d q = p;
    for (std::size_t i = 0; i < 3; ++i) q[i] = std::clamp(p[i], rule.points[0][i], rule.points[1][i]);
    return distance(p, q);
  }
  for (std::size_t i = 0; i + 1 < std::max<std::size_t>(rule.points.size(), 2); ++i) {
    const Vec3d &a = rule.points[i], &b = rule.points[std::min(i + 1, rule.points.size() - 1)];
    for (int k = 0; k <= 20000; ++k) {
      const double t = k / 20000.0;
      least =
          std::min(least, distance(p, {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])}));
    }
  }
  return least;
}

}  // namespace

TEST_CASE("a stroke has full effect within its target, none beyond its support, and is continuous", "[quick][grid]") {
  ScaleField field;
  field.base = 2;
  field.rules = {stroke_rule(ScaleMode::increase, {1, 2, 3}, 4, 6, field.base)};
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
  field.rules = {box_rule({-100, -100, -100}, {100, 100, 100}, 5), stroke_rule(ScaleMode::increase, {0, 0, 0}, 1, 4, 3),
                 stroke_rule(ScaleMode::decrease, {0, 0, 0}, 1, 7, 3)};
  CHECK(field.evaluate({0, 0, 0}) == 5);
  field.rules.push_back(stroke_rule(ScaleMode::decrease, {0, 0, 0}, 1, 1, 3));
  CHECK(field.evaluate({0, 0, 0}) == 1);
  CHECK(field.evaluate({1.5, 0, 0}) == 5 + (1 - 5) * 0.5625);
  field.rules.push_back(stroke_rule(ScaleMode::erase, {0, 0, 0}, 2, 99, 3));
  CHECK(field.evaluate({0, 0, 0}) == 3);
  CHECK(field.evaluate({2.9, 0, 0}) == 3);  // full effect of an erase reaches the base scale
  CHECK(field.evaluate({20, 0, 0}) == 5);
}

TEST_CASE("of overlapping boxes the later wins, edges included", "[quick][grid]") {
  ScaleField field;
  field.base = 1;
  field.rules = {box_rule({0, 0, 0}, {4, 4, 4}, 2), box_rule({4, 0, 0}, {8, 4, 4}, 3)};
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
  field.rules = {stroke_rule(ScaleMode::decrease, {}, 1, bad, 1)};
  CHECK_THROWS_AS(field.upper_bound(frame), Error);
  field.rules = {box_rule({}, {}, bad)};
  CHECK_THROWS_AS(field.upper_bound(frame), Error);
}

TEST_CASE("each rule does what its definition says, in the order of the rules", "[quick][grid]") {
  const std::uint32_t seed = GENERATE(range(0u, 6u));
  const ScaleField field = random_field(seed);
  Random random(seed);
  for (int i = 0; i < 12; ++i) {
    const Vec3d p = random_point(random, 50);
    const std::vector<double> steps = field.steps(p);
    REQUIRE(steps.size() == field.rules.size() + 1);
    CHECK(steps.front() == field.base);
    CHECK(steps.back() == field.evaluate(p));
    for (std::size_t k = 0; k < field.rules.size(); ++k) {
      CAPTURE(seed, i, k);
      CHECK(std::abs(steps[k + 1] - defined(field, field.rules[k], distance_by_trial(field.rules[k], p), steps[k])) <
            0.01);
    }
  }
}

TEST_CASE("every sample of the lattice is Appendix A, stroke by stroke, in its three modes", "[quick][grid]") {
  Random random(GENERATE(range(0u, 6u)));
  const double base = uniform(random, 0, 6);
  std::string json = fmt::format(R"({{"base":{},"rules":[)", base);
  std::vector<ScaleRule> strokes;
  for (int i = 0; i < 16; ++i) {
    ScaleRule& s = strokes.emplace_back();
    s.mode = ScaleMode(1 + i % 3);
    s.scale = uniform(random, 0, 8);
    s.support = i % 5 == 0 ? 0 : uniform(random, 0, 9);
    for (std::uint32_t k = 1 + random() % 3; k > 0; --k) s.points.push_back(random_point(random, 20));
    std::string points;
    for (const Vec3d& p : s.points) points += fmt::format("{}[{},{},{}]", points.empty() ? "" : ",", p[0], p[1], p[2]);
    const char* const modes[] = {"increase", "decrease", "erase"};
    json += fmt::format(R"({}{{"at":[{}],"support":{},"scale":{},"mode":"{}"}})", i > 0 ? "," : "", points, s.support,
                        s.scale, modes[i % 3]);
  }
  const ScaleField field = parse_scale_field(json + "]}", "strokes.json");
  REQUIRE(field.rules.size() == strokes.size());
  const GridFrame frame = frame_at(-40);
  const ScaleLattice lattice = field.sample(frame, {{-40, -40, -60}, {100, 90, 70}});
  const auto definition = [&](const Vec3d& p) {
    double s = base;
    for (const ScaleRule& stroke : strokes) {
      double t = distance(p, stroke.points[0]);
      for (std::size_t k = 1; k < stroke.points.size(); ++k) {
        const Vec3d &a = stroke.points[k - 1], &b = stroke.points[k];
        double along = 0, length = 0;
        for (std::size_t i = 0; i < 3; ++i) along += (p[i] - a[i]) * (b[i] - a[i]), length += std::pow(b[i] - a[i], 2);
        along = std::clamp(along / length, 0.0, 1.0);
        Vec3d q;
        for (std::size_t i = 0; i < 3; ++i) q[i] = a[i] + along * (b[i] - a[i]);
        t = std::min(t, distance(p, q));
      }
      const double target = stroke.mode == ScaleMode::erase ? base : stroke.scale, u = (t - target) / stroke.support;
      const double gamma = t < target ? 1 : t < target + stroke.support ? (1 - u * u) * (1 - u * u) : 0;
      const double phi = (1 - gamma) * s + gamma * target;
      s = stroke.mode == ScaleMode::increase   ? std::max(s, phi)
          : stroke.mode == ScaleMode::decrease ? std::min(s, phi)
                                               : phi;
    }
    return s;
  };
  std::size_t n = 0, wrong = 0, changed = 0;
  for_each(Box<decltype(lattice.origin)>{lattice.origin, lattice.origin + lattice.size}, [&](auto node) {
    Vec3d p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = (double(frame.origin[i]) + 8 * node[int(i)] + 0.5) * frame.voxel;
    const double s = definition(p);
    wrong += std::abs(double(lattice.samples[n++]) - 16 * s / frame.voxel) > 0.5 + 1e-6;
    changed += std::abs(s - base) > 0.1;
  });
  CHECK(n == lattice.samples.size());
  CHECK(wrong == 0);
  CHECK(changed > n / 20);
}

TEST_CASE("without strokes the scale changes by at most the slope", "[quick][grid]") {
  const std::uint32_t seed = GENERATE(range(0u, 12u));
  const ScaleField field = random_ramps(seed);
  Random random(seed);
  double steepest = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d p = random_point(random, 50), d = random_point(random, i % 2 ? 1 : 20);
    const Vec3d q{p[0] + d[0], p[1] + d[1], p[2] + d[2]};
    steepest = std::max(steepest, std::abs(field.evaluate(p) - field.evaluate(q)) / distance(p, q));
  }
  CHECK(steepest <= field.slope * (1 + 1e-9));
  CHECK(steepest > field.slope / 10);
}

TEST_CASE("within a ball the bounds hold, and the rules near it give the same scale", "[quick][grid]") {
  const std::uint32_t seed = GENERATE(range(0u, 12u));
  const ScaleField field = random_field(seed);
  Random random(seed);
  std::size_t left_out = 0;
  for (int i = 0; i < 50; ++i) {
    const Vec3d centre = random_point(random, 50);
    const double radius = uniform(random, 0, 8);
    const ScaleField::Range range = field.range(centre, radius);
    const ScaleField near = field.near(centre, radius);
    left_out += field.rules.size() - near.rules.size();
    for (int k = 0; k < 200; ++k) {
      const Vec3d d = random_point(random, 1);
      const double f = radius * std::cbrt(uniform(random, 0, 1)) / std::max(std::hypot(d[0], d[1], d[2]), 1e-9);
      const Vec3d p{centre[0] + f * d[0], centre[1] + f * d[1], centre[2] + f * d[2]};
      const double s = field.evaluate(p);
      if (s < range.least || s > range.most || near.evaluate(p) != s) FAIL_CHECK("ball " << i << " point " << k);
    }
  }
  CHECK(left_out > 500);
}

TEST_CASE("a field for another base has all scales times as large", "[quick][grid]") {
  const ScaleField field = random_ramps(3);
  const ScaleField twice = field.scaled(2);
  CHECK(twice.base == 2 * field.base);
  CHECK(twice.slope == field.slope);
  CHECK(twice.rules[0].scale == 2 * field.rules[0].scale);
  CHECK(twice.rules[0].points == field.rules[0].points);
  (void)twice.upper_bound(frame_at(0));
}
