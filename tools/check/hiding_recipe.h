#pragma once
#include <optional>

#include "lib/check/hidden.h"

namespace bp {

/// What bplod --profile occluder wrote into the file of how it was made; nothing where another tool made it, or where
/// it cannot be read or understood.
[[nodiscard]] std::optional<HidingRecipe> hiding_recipe(const std::string& path);

}  // namespace bp
