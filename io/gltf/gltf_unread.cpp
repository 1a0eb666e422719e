#include "io/gltf/gltf_unread.h"

#include <algorithm>
#include <set>

#include "io/gltf/detail/gltf_materials.h"
#include "io/gltf/gltf_nodes.h"

namespace bp {

namespace {

/// Returns the names of all extensions in the document, declared or not.
std::set<std::string> extensions_in(const GltfObject& root) {
  std::set<std::string> names;
  for (const GltfJson& name : root.array("extensionsUsed"))
    names.insert(name.is_string() ? name.get<std::string>() : name.dump());
  std::vector<const GltfJson*> open{&root.json()};  // no recursion: a file may be as deep as it is long
  while (!open.empty()) {
    const GltfJson& json = *open.back();
    open.pop_back();
    for (const auto& [key, value] : json.items()) {
      if (json.is_object() && key == "extras") continue;  // extras may hold anything
      if (json.is_object() && key == "extensions" && value.is_object()) {
        for (const auto& [name, extension] : value.items()) names.insert(name);
      }
      if (value.is_structured()) open.push_back(&value);
    }
  }
  return names;
}

void look_at_extensions(const GltfObject& root, std::vector<std::string>& lines) {
  for (const std::string& name : extensions_in(root)) {
    if (!keeps_triangles(name)) lines.push_back(name + " is not followed here, and may move or hide what is drawn");
    const bool moves = name == "EXT_mesh_gpu_instancing" || (name == "CESIUM_RTC" && gltf_rtc_center(root) != Vec3d{});
    if (moves && !requires_extension(root, name))
      lines.push_back(name + " moves what is drawn, and a viewer need not know it: it is not among extensionsRequired");
  }
}

void look_at_material(const GltfObject& material, UnreadParts& out) {
  if (transmits_light(material))
    out.see_through.push_back(material.place() + " has KHR_materials_transmission, and may be seen through");
  if (!material.has("alphaMode") || material.text("alphaMode") == "OPAQUE") return;
  const bool has_image =
      material.has("pbrMetallicRoughness") && material.object("pbrMetallicRoughness").has("baseColorTexture");
  if (material.text("alphaMode") == "MASK" && has_image) {
    out.has_holes = true;
  } else {
    out.see_through.push_back(
        fmt::format("{} has the alphaMode {}, and may be seen through", material.place(), material.text("alphaMode")));
  }
}

}  // namespace

bool requires_extension(const GltfObject& root, const std::string& name) {
  const GltfJson& required = root.array("extensionsRequired");
  return std::find(required.begin(), required.end(), name) != required.end();
}

UnreadParts gltf_unread(const GltfObject& root) {
  UnreadParts out;
  look_at_extensions(root, out.moves);
  if (!root.array("animations").empty()) out.moves.emplace_back("animations may move what is drawn");
  if (has_no_default_scene(root))
    out.moves.emplace_back("it has no scene, or no default one, and a viewer need not draw its nodes");
  for (std::size_t i = 0; i < root.array("materials").size(); ++i) look_at_material(root.item("materials", i), out);
  return out;
}

}  // namespace bp
