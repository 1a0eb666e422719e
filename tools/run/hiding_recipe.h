#pragma once
#include <optional>

#include "lib/check/hiding_recipe.h"
#include "tools/run/mesh_extras.h"
#include "tools/run/provenance.h"

namespace bp {

struct OccluderRecipe {
  HidingRecipe hiding;
  bool opaque_only = false;  ///< what can be seen through hides nothing; walls may meet the proxy
  bool ground = false;       ///< the scene stands on the ground (tools/run/grounded_source.h), along the axis `up`
  UpAxis up = UpAxis::y;
};

/// Among the options by which a file was made.
void add_recipe(const OccluderRecipe& recipe, OptionText& text);

/// What bpmesh --mode inside and bplod --profile occluder wrote into the file of how it was made; nothing where another
/// tool made it, or where it cannot be read or understood.
[[nodiscard]] std::optional<OccluderRecipe> hiding_recipe(const MeshExtras& extras);

}  // namespace bp
