#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/files/file.h"
#include "lib/core/grid_frame.h"
#include "lib/grid/stream.h"

/// Parts that all writers of glTF share: the container, and the asset with the origin of a file.
namespace bp {

using GltfOutJson = nlohmann::ordered_json;  ///< keys keep their order: same mesh, same bytes

/// Returns the member "asset": generator "TOOL VERSION", and in extras the chain of tools, the axis that is up in the
/// scene (this suite's readers turn back to it, scene_reader.h), the origin that was subtracted, if any, and the name
/// of the contract (docs/contracts.md), if any.
[[nodiscard]] GltfOutJson gltf_asset(const std::string& tool, const std::vector<Provenance>& provenance, UpAxis up,
                                     const Vec3d& origin, const std::string& contract = "");

/// Returns a matte material. Without it viewers take glTF's default (metal, black where nothing is mirrored) or draw
/// without light. White under the colours of vertices, else grey.
[[nodiscard]] GltfOutJson gltf_material(bool colored);

/// The numbers of a material's textures, and its factors where there is no texture.
struct GltfTextures {
  std::optional<std::size_t> color, normal, roughness, emission;
  double roughness_factor = 1, metal_factor = 0;
};
/// Returns a textured material; grey without a texture of colours. With holes, it is cut out where alpha is below a
/// half.
[[nodiscard]] GltfOutJson gltf_textured_material(const GltfTextures& textures, bool has_holes);

/// Returns the bytes of a GLB before those of its binary chunk. Throws as write_glb(), for the file `name`.
[[nodiscard]] std::string glb_head(std::string json, std::size_t data_bytes, const std::string& name);

/// Writes a GLB of one JSON and one binary chunk. Throws bad_argument beyond 4 GiB. `data` must be a multiple of 4
/// bytes.
void write_glb(std::string json, const std::string& data, OutputFile& out);

}  // namespace bp
