#pragma once
#include <compare>
#include <map>
#include <tuple>
#include <vector>

#include "io/gltf/detail/gltf_materials.h"
#include "io/gltf/detail/gltf_skin.h"
#include "io/gltf/gltf_document.h"
#include "io/scene/part_names.h"

namespace bp {

/// The morph weights and skin that move a mesh before its node places it.
struct MeshMotion {
  static constexpr std::uint64_t kNoSkin = ~std::uint64_t(0);
  std::vector<double> weights;  ///< weights of its morph targets; empty: none
  std::uint64_t skin = kNoSkin;
  auto operator<=>(const MeshMotion&) const = default;
};

/// Returns whether the object's name fits the parts that are asked for.
[[nodiscard]] bool name_fits(const PartFilter& parts, const GltfObject& named);

/// Adds the meshes of a document to a scene: the primitives, each once for each motion.
class GltfMeshes {
 public:
  /// Numbers of primitives of the scene.
  struct Range {
    std::uint32_t first, end;
  };
  /// Keeps references. `places`: of the nodes that were reached, for joints of skins.
  GltfMeshes(GltfDocument& doc, const std::string& file, const SceneOptions& options, const PartFilter& parts,
             const std::vector<std::optional<Affine>>& places, InstancedScene& scene)
      : doc_(doc),
        root_(doc.root()),
        options_(options),
        parts_(parts),
        places_(places),
        scene_(scene),
        materials_(doc, file, options) {}

  /// Adds mesh i: all of its parts if it is wanted, or if its name fits; else those whose materials' names fit.
  [[nodiscard]] Range add(std::uint64_t i, bool wanted, const MeshMotion& motion);

 private:
  const GltfSkin& skin(std::uint64_t i);
  void add_primitive(const GltfObject& p, const MeshMotion& motion);
  void add_positions(const GltfObject& p, const MeshMotion& motion, bool packed, Primitive& primitive);
  void add_indices(const GltfObject& p, Primitive& primitive);
  void add_normals(const GltfObject& p, const MeshMotion& motion, Primitive& primitive);
  void add_colors(const GltfObject& p, const GltfObject& attributes, Primitive& primitive);
  void try_texture(std::uint64_t material, const GltfObject& attributes, Primitive& primitive);

  GltfDocument& doc_;
  const GltfObject root_;
  const SceneOptions& options_;
  const PartFilter& parts_;
  const std::vector<std::optional<Affine>>& places_;
  InstancedScene& scene_;
  GltfMaterials materials_;
  std::map<std::tuple<std::uint64_t, bool, MeshMotion>, Range> meshes_;
  std::map<std::uint64_t, GltfSkin> skins_;
};

}  // namespace bp
