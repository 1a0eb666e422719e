#pragma once
#include <cstdint>
#include <vector>

#include "lib/grid/scale_field.h"

/// The part of a scale field that matters near a place. A field may have thousands of rules, and few of them are near.
namespace bp {

struct ScalePart {
  std::vector<std::uint32_t> rules;  ///< numbers of the rules that may change S in the ball, rising
  ScaleField::Range range;           ///< of S in the ball
};

/// Returns the part of a field in a ball, scene units. `around`: the part of a ball that holds this one; null: all
/// rules are visited.
[[nodiscard]] ScalePart part_near(const ScaleField& field, const Vec3d& centre, double radius,
                                  const ScalePart* around = nullptr);

/// Returns ScaleField::evaluate(), to the last bit, in the ball of `part`.
[[nodiscard]] double evaluate(const ScaleField& field, const ScalePart& part, const Vec3d& p);

}  // namespace bp
