#pragma once
#include <cstdint>
#include <span>
#include <string>

/// How many polygons a mesh's triangles were cut from.
namespace bp {

/// Fed with TriangleSource::read_faces(), batch after batch. Parts of a polygon that a reader skipped are not seen:
/// what is left of it counts as a polygon of fewer corners.
class FaceCounts {
 public:
  std::uint64_t triangles = 0;  ///< faces with three corners
  std::uint64_t quads = 0;      ///< with four
  std::uint64_t polygons = 0;   ///< with more
  std::uint64_t cut = 0;        ///< triangles after all faces were cut

  /// inner_edges: by triangle; `plain` more triangles without inner edges follow.
  void add(std::span<const std::uint8_t> inner_edges, std::uint64_t plain = 0);

  /// "12 triangles"; "350 quads, 700 triangles"; "330 quads and 40 triangles, 700 triangles when cut".
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t open_ = 0;  ///< triangles so far of the face that the last triangle belongs to
  void count(std::uint64_t triangles_of_face, int by);
};

}  // namespace bp
