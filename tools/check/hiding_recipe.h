#pragma once
#include <optional>

#include "lib/check/hidden.h"

namespace bp {

/// `ground`: the scene stands on the ground (tools/run/grounded_source.h), along the axis `up`.
struct OccluderRecipe {
  HidingRecipe hiding;
  bool ground = false;
  UpAxis up = UpAxis::y;
};

/// What bplod --profile occluder wrote into the file of how it was made; nothing where another tool made it, or where
/// it cannot be read or understood.
[[nodiscard]] std::optional<OccluderRecipe> hiding_recipe(const std::string& path);

}  // namespace bp
