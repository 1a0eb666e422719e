#pragma once
#include <algorithm>
#include <array>
#include <functional>
#include <string_view>
#include <vector>

#include "io/scene/detail/vertex_pool.h"
#include "io/scene/raw_source.h"
#include "io/scene/scene_file.h"

namespace bp {

/// Returns whether a line with this keyword adds surfaces that are not read: a free-form surface, a patch of version 2,
/// or another file.
[[nodiscard]] inline bool adds_unread_surface(std::string_view keyword) {
  constexpr std::array<std::string_view, 7> kKeywords{"surf", "call", "bsp", "bzp", "cdc", "cdp", "res"};
  return std::find(kKeywords.begin(), kKeywords.end(), keyword) != kKeywords.end();
}

/// Returns whether a keyword is "v" or "f" and a number without a blank between them. Some programs read both.
[[nodiscard]] inline bool is_glued(std::string_view keyword) {
  constexpr std::string_view kNumberStarts = "0123456789+-.";
  return keyword.size() > 1 && (keyword[0] == 'v' || keyword[0] == 'f') &&
         kNumberStarts.find(keyword[1]) != std::string_view::npos;
}

/// An OBJ file whose lines are as nearly all programs write them, in blocks of text that all cores read at once.
class ObjBlocks {
 public:
  explicit ObjBlocks(SceneFilePtr file) : file_(std::move(file)) {}

  /// Reads all vertices. Calls take() with them, in the order of the file. Returns false if a line is not plain (a
  /// continued line, a lone CR, a number that a plain one is not): take() then got the vertices of the lines before
  /// some line, and none of them is wrong. Takes 1 MiB for each thread.
  [[nodiscard]] bool read_vertices(const std::function<void(const std::vector<Vec3d>&)>& take);

  /// Returns whether read_faces() may be called: read_vertices() returned true, and all other lines are plain, too.
  /// Such a file has no face that is refused.
  [[nodiscard]] bool has_plain_faces() const { return plain_faces_; }
  [[nodiscard]] std::size_t size() const { return seen_before_.size(); }
  /// Makes the triangles of the faces whose lines begin in block `i`, as PolygonSource does. `pool`: all vertices, in
  /// memory. `fans`: as SceneOptions::fans. Thread-safe.
  void read_faces(std::size_t i, const VertexPool& pool, bool fans, RawBatch& batch) const;

 private:
  SceneFilePtr file_;
  std::vector<std::uint64_t> seen_before_;  // vertices in the blocks before each block
  bool plain_faces_ = false;
};

}  // namespace bp
