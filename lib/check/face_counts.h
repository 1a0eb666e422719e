#pragma once
#include <cstdint>
#include <span>
#include <string>

/// Counts the polygons that a mesh's triangles were cut from.
namespace bp {

/// Takes TriangleSource::read_faces(), batch after batch. Parts of a polygon that a reader skipped are not seen: the
/// rest counts as a polygon of fewer corners.
class FaceCounts {
 public:
  std::uint64_t triangles = 0;  ///< faces with three corners
  std::uint64_t quads = 0;      ///< faces with four corners
  std::uint64_t polygons = 0;   ///< faces with more corners
  std::uint64_t cut = 0;        ///< triangles after all faces were cut

  /// Takes more triangles. inner_edges: one entry for each; `plain` further triangles without inner edges follow.
  void add(std::span<const std::uint8_t> inner_edges, std::uint64_t plain = 0);

  /// Returns "12 triangles"; "350 quads, 700 triangles"; "330 quads and 40 triangles, 700 triangles when cut".
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t open_ = 0;  ///< triangles so far of the last face
  void count(std::uint64_t triangles_of_face, int by);
};

}  // namespace bp
