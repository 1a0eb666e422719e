#pragma once
#include <optional>

#include "io/scene/affine.h"
#include "io/scene/raw_source.h"

/// Meshes as arrays in files, and the places where they stand: the form of glTF, and of any format after Assimp has
/// read it. Streamed without ever expanding an instance.
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
  std::uint64_t replaced_count = 0;  ///< "sparse" elements, which lie elsewhere: their numbers, rising, and values
  std::uint64_t replaced_numbers = 0, replaced_values = 0;  ///< addresses; values are packed
  ComponentType number_type = ComponentType::u32;
  /// Bounds on the error of a number: this share of the largest number of its element, and `off`.
  double share = 0, off = 0;
};

/// Returns all numbers of all elements.
[[nodiscard]] std::vector<double> read_numbers(const SceneFilePtr& bytes, const Accessor& accessor);

struct Primitive {
  enum class Mode { triangles, strip, fan };
  Mode mode = Mode::triangles;
  Accessor positions;               ///< three components
  std::optional<Accessor> indices;  ///< indices into positions; none: 0, 1, 2 ...
  std::optional<Accessor> colors;   ///< one for each position, three components, or four of which the last is not used
  std::array<double, 3> base_color{1, 1, 1};  ///< factor of the colours
  std::optional<Accessor> uv;                 ///< one for each position, two components
  /// Maps texture coordinates to those of the image: u is the first three numbers times (u, v, 1), v the other three.
  std::array<double, 6> uv_transform{1, 0, 0, 0, 1, 0};
  std::optional<Accessor> second_uv;  ///< further places, if SceneOptions::details asks for them
  std::array<double, 6> second_uv_transform{1, 0, 0, 0, 1, 0};
  std::uint32_t material = TriangleTexture::kNoMaterial;
  bool has_image = false;           ///< an image of colours, at `uv`
  std::optional<Accessor> normals;  ///< one for each position, three components
  bool srgb = false;                ///< both are sRGB; else they are linear
  std::optional<Bounds3d> told;     ///< bounds of the positions that the file tells, grown by what rounding explains
  bool moved = false;               ///< a pose has moved the positions since
};

/// Transforms of many instances of one node's mesh, applied before the node's own. Missing accessors have count 0.
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
  std::optional<UpAxis> up;    ///< set if the file tells
  std::size_t levels = 1;      ///< levels of the file, of which this is one
  std::size_t animations = 0;  ///< animations in the file; none is followed
  std::uint64_t posed = 0;     ///< SceneCounts::posed
  std::uint64_t points = 0;    ///< vertices of primitives that are points, which are not read
  std::uint64_t lines = 0;     ///< primitives that are lines, which are not read
  UnreadParts unread;
  std::uint64_t bad_faces = 0;       ///< met while the scene was put together
  std::uint64_t differing = 0;       ///< SceneCounts::differing
  std::uint64_t document_bytes = 0;  ///< bytes of SceneOptions::document in use while the scene was put together
  Unfollowed unfollowed;

  [[nodiscard]] std::uint64_t memory_bytes() const;  ///< memory of the description
};

/// Returns how many bytes the description of a scene may take: the vertices' memory without a part that vertices need,
/// and as many in reserve.
[[nodiscard]] std::uint64_t most_described(const SceneOptions& options);
/// Returns the limit on memory at which a description of so many bytes fits (InstancedScene::memory_bytes()); 0: it
/// fits now, or no limit is known.
[[nodiscard]] std::uint64_t limit_of_description(std::uint64_t bytes, const SceneOptions& options);

/// Streams the triangles of each node in order. Memory: options.memory_bytes and the scene's description.
[[nodiscard]] RawSourcePtr stream_instances(InstancedScene scene, const SceneOptions& options);

}  // namespace bp
