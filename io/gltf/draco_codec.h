#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/scene/instanced_scene.h"

/// Decoder of KHR_draco_mesh_compression (Khronos, glTF extension registry), which uses Draco.
namespace bp {

/// An attribute of vertices: as the file describes it, and its values once decoded.
struct DracoAttribute {
  std::uint32_t id = 0;  ///< its number in the packed bytes
  ComponentType type = ComponentType::f32;
  std::size_t components = 1;
  std::vector<std::byte> values;  ///< vertex by vertex, without gaps
};

struct DracoMesh {
  std::size_t vertices = 0;
  std::vector<std::uint32_t> indices;  ///< three for each triangle, below `vertices`
};

/// Decodes the triangles, and the values of each attribute, in its type. Returns an empty text, or what is wrong with
/// the bytes, "have ..." or "are ...". Bytes that claim more than `most_triangles` are refused before anything is
/// allocated for them. Peak: about 200 bytes a triangle.
[[nodiscard]] std::string decode_draco(std::span<const std::byte> bytes, std::uint64_t most_triangles, DracoMesh& mesh,
                                       std::span<DracoAttribute> attributes);

constexpr std::uint64_t kDracoBytesPerTriangle = 500;  ///< most memory while they are decoded

}  // namespace bp
