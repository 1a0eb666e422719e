#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "lib/check/check_proxy.h"
#include "tools/run/mesh_extras.h"
#include "tools/run/provenance.h"

namespace bp {

/// Adds the recipe to the options in the provenance of a file.
void add_recipe(const HidingRecipe& recipe, OptionText& text);

/// Returns the recipe that bpmesh --mode inside or bplod --profile occluder wrote into its output; nothing if another
/// tool made the file, if the recipe cannot be read or understood, or if another axis points up in it than in the file.
[[nodiscard]] std::optional<HidingRecipe> hiding_recipe(const MeshExtras& extras);

/// The question how a proxy is hidden, with the scene that hides it.
struct Walls {
  std::unique_ptr<TriangleSource> source;
  std::optional<HidingQuestion> question;  ///< refers to `source`
};
/// Returns the question for a proxy's file; nothing if that has no recipe. `open` opens the scene once more, perhaps
/// without what can be seen through.
[[nodiscard]] Walls walls_of(const MeshExtras& extras,
                             const std::function<std::unique_ptr<TriangleSource>(bool opaque_only)>& open);

}  // namespace bp
