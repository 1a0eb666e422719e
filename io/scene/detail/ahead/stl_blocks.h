#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "io/scene/scene_file.h"
#include "lib/core/box.h"
#include "lib/core/triangle_source.h"

namespace bp {

/// Returns whether a number of "normal x y z" may begin with c: also one such as "nan", "inf" or "-1".
[[nodiscard]] inline bool begins_number(char c) {
  return std::string_view("0123456789+-.nNiI").find(c) != std::string_view::npos;
}

constexpr std::size_t kLongestName = 4096;  ///< characters that names_facets() looks at
/// Returns whether statements stand in what follows "solid" or "endsolid" on its line, or if it is too long to tell.
/// Programs that do not look at lines read these statements.
[[nodiscard]] bool names_facets(std::string_view name);

/// An ASCII STL with the lines of the format's description, as nearly all programs write it, in blocks of
/// text that all cores read at once.
class StlBlocks {
 public:
  explicit StlBlocks(SceneFilePtr file) : file_(std::move(file)) {}

  /// Reads the whole file. Returns the bounds of all vertices, or nothing if a line is not plain: then read() may not
  /// be called. Takes 1 MiB for each thread.
  [[nodiscard]] std::optional<Bounds3d> find();

  [[nodiscard]] std::size_t size() const { return blocks_; }
  /// Replaces `out` by the triangles whose "facet" begins in block `i`. Thread-safe.
  void read(std::size_t i, std::vector<TriangleD>& out) const;

 private:
  SceneFilePtr file_;
  std::size_t blocks_ = 0;
};

}  // namespace bp
