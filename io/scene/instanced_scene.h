#pragma once
#include <optional>

#include "io/scene/affine.h"
#include "io/scene/raw_source.h"

/// Meshes that lie as arrays in files, and the places where they stand: what glTF describes, and what is left of any
/// format after Assimp has read it. Streamed without ever expanding an instance.
namespace bp {

enum class ComponentType : std::uint16_t {
  i8 = 5120,
  u8 = 5121,
  i16 = 5122,
  u16 = 5123,
  u32 = 5125,
  f32 = 5126,
  f64 = 5130
};
[[nodiscard]] std::size_t bytes_of(ComponentType type);

/// An array of numbers or vectors. All addresses were checked to lie inside the file.
struct Accessor {
  static constexpr std::uint64_t kZeros = ~std::uint64_t(0);

  std::uint64_t count = 0;
  ComponentType type = ComponentType::f32;
  std::size_t components = 1;
  bool normalized = false;           ///< integers stand for [0, 1] or [-1, 1]
  std::uint64_t address = kZeros;    ///< of element 0; kZeros: all elements are 0
  std::uint64_t stride = 0;          ///< bytes from one element to the next
  std::uint64_t replaced_count = 0;  ///< elements that stand elsewhere ("sparse"): their numbers, rising, and values
  std::uint64_t replaced_numbers = 0, replaced_values = 0;  ///< addresses; values are packed
  ComponentType number_type = ComponentType::u32;
  /// A number may be off, from what the file stands for, by this share of the largest of its element, and by `off`.
  double share = 0, off = 0;
};

/// All numbers of all elements.
[[nodiscard]] std::vector<double> read_numbers(const SceneFilePtr& bytes, const Accessor& accessor);

struct Primitive {
  enum class Mode { triangles, strip, fan };
  Mode mode = Mode::triangles;
  Accessor positions;               ///< three components
  std::optional<Accessor> indices;  ///< into positions; none: 0, 1, 2 ...
  std::optional<Accessor> colors;   ///< one for each position, three components or four, of which the last is not used
  std::array<double, 3> base_color{1, 1, 1};  ///< multiplies them
  std::optional<Accessor> uv;                 ///< one for each position, two components
  /// u, v of an image: the first three times (u, v, 1), the other three times it.
  std::array<double, 6> uv_transform{1, 0, 0, 0, 1, 0};
  std::uint32_t material = TriangleTexture::kNoMaterial;
  bool has_image = false;           ///< of colours, at `uv`
  std::optional<Accessor> normals;  ///< one for each position, three components
  bool srgb = false;                ///< transfer function of both; else they are linear
};

/// Transforms of many instances of one node's mesh, applied before the node's own; absent accessors have count 0.
struct InstanceArray {
  std::uint64_t count = 0;
  Accessor translation, rotation, scale;
};

/// One use of the primitives [first, end).
struct MeshNode {
  Affine transform;
  std::uint32_t first = 0, end = 0;
  std::optional<std::uint32_t> instances;  ///< number of an InstanceArray
};

struct InstancedScene {
  SceneFilePtr bytes;
  std::vector<Primitive> primitives;
  std::vector<InstanceArray> arrays;
  std::vector<MeshNode> nodes;
  std::optional<UpAxis> up;    ///< if the file tells
  std::size_t levels = 1;      ///< that the file has, of which this is one
  std::size_t animations = 0;  ///< that the file has; none is followed
  std::uint64_t posed = 0;     ///< SceneCounts::posed
  std::uint64_t points = 0;    ///< vertices of primitives that are points; they are not read
  std::uint64_t lines = 0;     ///< primitives that are lines; they are not read
  UnreadParts unread;
  std::uint64_t bad_faces = 0;       ///< met before, while the scene was put together
  std::uint64_t differing = 0;       ///< SceneCounts::differing
  std::uint64_t document_bytes = 0;  ///< of SceneOptions::document, while the scene was put together
  Unfollowed unfollowed;

  [[nodiscard]] std::uint64_t memory_bytes() const;  ///< of the description
};

/// Bytes that the description of a scene may take: those for vertices, but for a part that vertices need, and as many
/// that are in reserve.
[[nodiscard]] std::uint64_t most_described(const SceneOptions& options);
/// The limit on memory at which a description of so many bytes fits (InstancedScene::memory_bytes()); 0: it fits now,
/// or no limit is known.
[[nodiscard]] std::uint64_t limit_of_description(std::uint64_t bytes, const SceneOptions& options);

/// Streams the triangles of each node in order. Memory: options.memory_bytes and the scene's description.
[[nodiscard]] RawSourcePtr stream_instances(InstancedScene scene, const SceneOptions& options);

}  // namespace bp
