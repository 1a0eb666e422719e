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

/// Returns whether a keyword begins beyond ASCII, or is "v" and something other than a letter, or "f" and anything but
/// an "o". Some programs find a blank there, read a number without one, or take each line with an "f" for a face.
[[nodiscard]] inline bool is_glued(std::string_view keyword) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  if (!keyword.empty() && static_cast<unsigned char>(keyword[0]) >= 0x80) return true;
  if (keyword.size() < 2) return false;
  return (keyword[0] == 'v' && !is_letter(keyword[1])) || (keyword[0] == 'f' && keyword != "fo");
}

/// Numbers of lines "v", "vt" and "vn": a corner of a face names one of each.
struct ObjLines {
  std::uint64_t vertices = 0, places = 0, normals = 0;
};

/// An OBJ file whose lines are as nearly all programs write them, in blocks of text that all cores read at once.
class ObjBlocks {
 public:
  explicit ObjBlocks(SceneFilePtr file) : file_(std::move(file)) {}

  /// Reads all vertices. Calls take() with them, in the order of the file. Returns false if a line is not plain (a
  /// continued line, a lone CR, an odd character, a number that a plain one is not, a vertex with other words than a
  /// weight of 1 or a colour): take() then got the vertices of the lines before some line, and none of them is wrong.
  /// Takes 1 MiB for each thread.
  [[nodiscard]] bool read_vertices(const std::function<void(const std::vector<Vec3d>&)>& take);

  /// Returns whether read_faces() may be called: read_vertices() returned true, and all other lines are plain, too.
  /// Such a file has no face that is refused, and none that names what does not stand before it.
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
