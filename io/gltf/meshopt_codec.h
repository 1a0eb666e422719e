#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// The byte codecs of EXT_meshopt_compression (Khronos, glTF extension registry), by meshoptimizer. Lossless except for
/// normals.
namespace bp {

using TriangleIndices = std::vector<std::array<std::uint32_t, 3>>;

/// Puts triangles into an order that suits a GPU's vertex cache and compresses well, and vertices into the order of
/// their first use. Returns, for each new vertex, its old number; vertices without a triangle are left out.
/// Deterministic.
[[nodiscard]] std::vector<std::uint32_t> optimize_order(TriangleIndices& triangles, std::size_t vertices);

/// Encodes vertices. `data`: count * stride bytes; stride a multiple of 4, at most 256.
[[nodiscard]] std::string encode_attributes(const std::string& data, std::size_t stride);
/// Returns unit vectors as octahedral coordinates of 8 bits, 4 bytes each: the input of encode_attributes() for a view
/// with the filter OCTAHEDRAL, which decodes them to within 1.1 degrees.
[[nodiscard]] std::string octahedral(const std::vector<std::array<float, 3>>& normals);
/// As above, with a fourth number from -1 to 1, as tangents have it.
[[nodiscard]] std::string octahedral(const std::vector<std::array<float, 4>>& tangents);
/// Returns float32 numbers as whole multiples of one power of two: the input of encode_attributes() for a view with the
/// filter EXPONENTIAL, which decodes them to equal numbers. Empty if a multiple would have more than 24 bits.
[[nodiscard]] std::string exponential(const std::string& numbers);
/// Encodes triangles. Decoding may rotate a triangle's corners.
[[nodiscard]] std::string encode_triangles(const TriangleIndices& triangles, std::size_t vertices);

enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

/// The description of a view's compressed bytes.
struct MeshoptView {
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;
  std::uint64_t count = 0, stride = 0;
};

/// Decodes into count * stride bytes. Returns an empty text, or what is wrong with the bytes, "have ..." or "are ...".
/// Reads and writes nowhere else, whatever the bytes are.
[[nodiscard]] std::string decode_meshopt(const MeshoptView& view, std::span<const std::byte> bytes,
                                         std::vector<std::byte>& out);

}  // namespace bp
