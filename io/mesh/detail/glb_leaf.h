#pragma once
#include <functional>
#include <map>
#include <string>

#include "io/mesh/detail/glb_looks.h"
#include "io/mesh/leaf_looks.h"
#include "lib/core/up_axis.h"
#include "lib/pass/leaf/scene_leaf.h"

namespace bp {

/// Adds pieces of a scene to a GLB, each with its own materials.
class GlbLeaves {
 public:
  using Position = std::array<float, 3>;
  /// Returns the numbers of POSITION for a vertex, before they are turned to y up.
  using Place = std::function<Position(const std::array<std::int32_t, 3>& at)>;

  /// Keeps references.
  GlbLeaves(GlbData& data, GlbLooks& all, const LeafLooks& looks, UpAxis up)
      : data_(data), all_(all), looks_(looks), up_(up) {}

  /// Returns the primitives of a mesh.
  [[nodiscard]] GltfOutJson primitives(const SceneLeaf& leaf, const Place& place);

 private:
  struct Mapped {
    std::size_t material = 0;
    std::size_t places = 0;  ///< sets of places that its images need
  };
  GltfOutJson primitive(const LeafPart& part, const Place& place);
  Mapped add_material(const TextureMaterial& material, std::array<double, 4> factor, LeafSides sides);
  std::optional<GltfOutJson> add_map(const TextureMap& map);
  std::optional<std::size_t> image_of(std::uint32_t image);

  GlbData& data_;
  GlbLooks& all_;
  const LeafLooks& looks_;
  const UpAxis up_;
  std::map<std::uint32_t, std::optional<std::size_t>> images_;  // numbers in the file of those of the scene
};

}  // namespace bp
