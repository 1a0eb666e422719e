#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/scene/instanced_scene.h"

/// Triangles as KHR_draco_mesh_compression packs them (Khronos, glTF extension registry), by Draco.
namespace bp {

/// Numbers of vertices: what a file says of them, and their values once decoded.
struct DracoAttribute {
  std::uint32_t id = 0;  ///< by which the packed bytes know it
  ComponentType type = ComponentType::f32;
  std::size_t components = 1;
  std::vector<std::byte> values;  ///< vertex by vertex, without gaps
};

struct DracoMesh {
  std::size_t vertices = 0;
  std::vector<std::uint32_t> indices;  ///< three a triangle, below `vertices`
};

/// Decodes the triangles, and of each attribute the values, in its type. Empty text: done; else what is wrong with the
/// bytes, "have ..." or "are ...". Bytes that speak of more than `most_triangles` are refused before anything is made
/// for them. Peak: about 200 bytes a triangle.
[[nodiscard]] std::string decode_draco(std::span<const std::byte> bytes, std::uint64_t most_triangles, DracoMesh& mesh,
                                       std::span<DracoAttribute> attributes);

constexpr std::uint64_t kDracoBytesPerTriangle = 500;  ///< at most, while they are decoded

}  // namespace bp
