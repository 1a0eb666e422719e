#include <algorithm>

#include "io/gltf/gltf_document.h"

namespace bp {

namespace {

constexpr std::array kRead = {"KHR_draco_mesh_compression",
                              "EXT_meshopt_compression",
                              "KHR_meshopt_compression",
                              "KHR_mesh_quantization",
                              "EXT_mesh_gpu_instancing",
                              "MSFT_lod",
                              "CESIUM_RTC",
                              "3DTILES_content_gltf"};
// Extensions that do not move or hide triangles. A name that ends with _ stands for all that begin with it.
constexpr std::array kHarmless = {"KHR_materials_",
                                  "KHR_texture_",
                                  "EXT_texture_",
                                  "MSFT_texture_",
                                  "MSFT_packing_",
                                  "KHR_lights_",
                                  "EXT_lights_",
                                  "KHR_xmp",
                                  "KHR_xmp_json_ld",
                                  "EXT_mesh_features",
                                  "KHR_techniques_webgl",
                                  "3DTILES_metadata",
                                  "EXT_instance_features",
                                  "EXT_structural_metadata",
                                  "CESIUM_primitive_outline",
                                  "3DTILES_bounding_volume_S2"};

bool is_known(const std::string& name) {
  const auto fits = [&](std::string_view known) {
    return name == known || (known.ends_with('_') && name.starts_with(known));
  };
  return std::any_of(kRead.begin(), kRead.end(), fits) || std::any_of(kHarmless.begin(), kHarmless.end(), fits);
}

}  // namespace

bool keeps_triangles(const std::string& extension) {
  const bool draws_others = extension == "MSFT_lod" || extension == "KHR_techniques_webgl";
  return is_known(extension) && !draws_others;
}

void check_required_extensions(const GltfObject& root) {
  for (const GltfJson& name : root.array("extensionsRequired")) {
    if (!name.is_string() || !is_known(name.get<std::string>()))
      root.unfit(fmt::format("requires {}, which is not read", name.dump()));
  }
}

}  // namespace bp
