#pragma once
#include <random>

#include "lib/grid/scale_field.h"

/// Random scale fields for tests.
namespace bp::test {

using Random = std::mt19937;
inline double uniform(Random& random, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(random);
}
inline Vec3d random_point(Random& random, double reach) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -reach, reach)};
}

/// Returns fields as files of earlier versions have them: boxes, then strokes.
inline ScaleField random_strokes(std::uint32_t seed) {
  Random random(seed);
  ScaleField field;
  field.base = uniform(random, 0, 8);
  for (int i = 0; i < 5; ++i) {
    const Vec3d min = random_point(random, 30), size = random_point(random, 15);
    field.rules.push_back(
        box_rule(min, {min[0] + 15 + size[0], min[1] + 15 + size[1], min[2] + 15 + size[2]}, uniform(random, 0, 12)));
  }
  for (int i = 0; i < 20; ++i) {
    const auto mode = ScaleMode(1 + random() % 3);
    const double support = random() % 5 == 0 ? 0 : uniform(random, 0, 12);
    field.rules.push_back(stroke_rule(mode, random_point(random, 40), support, uniform(random, 0, 10), field.base));
  }
  return field;
}

/// Rules of all shapes and modes, whose scale changes by at most the slope.
inline ScaleField random_ramps(std::uint32_t seed) {
  Random random(seed);
  ScaleField field;
  field.base = uniform(random, 0, 8);
  field.slope = uniform(random, 0.1, 0.9);
  for (int i = 0; i < 12; ++i) {
    ScaleRule rule;
    rule.shape = ScaleShape(random() % 3);
    rule.mode = ScaleMode(random() % 4);
    rule.scale = uniform(random, 0, 10);
    for (std::uint32_t k = 1 + random() % 4; k > 0; --k) rule.points.push_back(random_point(random, 40));
    if (rule.shape == ScaleShape::box) {
      const Vec3d a = rule.points[0];
      rule.points = {a, {a[0] + uniform(random, 0, 30), a[1] + uniform(random, 0, 30), a[2] + uniform(random, 0, 30)}};
    }
    if (rule.shape == ScaleShape::view) {
      if (rule.mode == ScaleMode::erase) rule.mode = ScaleMode::increase;
      rule.per_distance = uniform(random, 0, field.slope);
    } else {
      rule.radius = uniform(random, 0, 5);
    }
    field.rules.push_back(rule);
  }
  return field;
}

inline ScaleField random_field(std::uint32_t seed) {
  ScaleField field = random_strokes(seed);
  const ScaleField ramps = random_ramps(seed + 1000);
  field.slope = ramps.slope;
  for (std::size_t i = 0; i < ramps.rules.size(); ++i)
    field.rules.insert(field.rules.begin() + std::ptrdiff_t(2 * i), ramps.rules[i]);
  return field;
}

}  // namespace bp::test
