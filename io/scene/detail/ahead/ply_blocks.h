#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "io/scene/detail/ply/ply_header.h"
#include "io/scene/detail/ply/ply_vertices.h"
#include "io/scene/detail/vertex_pool.h"
#include "io/scene/raw_source.h"

namespace bp {

/// An ASCII PLY with a record in each line, as nearly all programs write it, in blocks of text that all cores read at
/// once.
class PlyBlocks {
 public:
  /// `data`: the first byte behind the header.
  PlyBlocks(SceneFilePtr file, const TextMark& data) : file_(std::move(file)), faces_(data) {}

  /// Reads all vertices; the first element of the file has them. Calls take() with them, in the order of the file.
  /// Returns false if a line is not plain: take() then got some of the vertices. Takes 1 MiB for each thread.
  [[nodiscard]] bool read_vertices(const PlyElement& vertex, const PlyPosition& position,
                                   const std::function<void(const std::vector<Vec3d>&)>& take);

  /// Returns the place behind the vertices, once read_vertices() has returned true.
  [[nodiscard]] TextMark faces() const { return faces_; }

  /// Returns whether an element is a list of vertex numbers, which may be followed by single numbers.
  [[nodiscard]] static bool has_plain_form(const PlyElement& face);
  /// Looks at all faces, which follow the vertices, and returns the place behind them; nothing if a line is not plain:
  /// then read_faces() may not be called, and a line may be wrong.
  [[nodiscard]] std::optional<TextMark> find_faces(const PlyElement& face);

  [[nodiscard]] std::size_t size() const { return faces_in_.size(); }
  /// Makes the triangles of the faces whose lines begin in block `i`, as PolygonSource does. `pool`: all vertices, in
  /// memory. `fans`: as SceneOptions::fans. Thread-safe.
  void read_faces(std::size_t i, const VertexPool& pool, bool fans, RawBatch& batch) const;

 private:
  SceneFilePtr file_;
  TextMark faces_;                       // where the faces begin
  std::vector<std::uint64_t> faces_in_;  // number of faces in each block
};

}  // namespace bp
