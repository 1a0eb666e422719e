#include "io/mesh/leaf_writer.h"

#include "io/mesh/contract.h"
#include "io/mesh/detail/glb_leaf.h"

namespace bp {

std::string leaf_glb(const std::string& name, const SceneLeaf& leaf, const LeafLooks& looks, UpAxis up,
                     const std::vector<Provenance>& provenance, bool is_scene) {
  using Json = GltfOutJson;
  GlbData data(looks.compression == Compression::meshopt);
  GlbLooks all(data);
  const auto in_units = [](const std::array<std::int32_t, 3>& at) {
    return GlbLeaves::Position{float(at[0]), float(at[1]), float(at[2])};
  };
  Json primitives = GlbLeaves(data, all, looks, up).primitives(leaf, in_units);
  Json& doc = data.json();
  doc["meshes"].push_back({{"name", name}, {"primitives", std::move(primitives)}});
  doc["nodes"].push_back({{"name", name}, {"mesh", 0}, {"scale", Json::array({leaf.unit, leaf.unit, leaf.unit})}});
  all.write();
  Json asset = gltf_asset("bplod", provenance, UpAxis::y, {}, is_scene ? name_of(Contract::leaf) : "");
  asset["extras"]["tile_origin"] = leaf.origin;
  const std::string json = data.document(std::move(asset), {0});
  return glb_head(json, data.bytes().size(), name + ".glb") + data.bytes();
}

}  // namespace bp
