#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/scene/raw_source.h"
#include "lib/core/indexed_mesh.h"
#include "tools/api/include/bp/bp.h"

namespace bp::api {

/// Triangles in memory, of a caller or copied.
class ArrayScene {
 public:
  /// Checks each number. Throws bad_argument if the arrays' description makes no sense; bad_input if a triangle names a
  /// vertex that does not exist, a vertex that is used is not finite, or there is no triangle.
  explicit ArrayScene(const bp_arrays& arrays);

  [[nodiscard]] std::size_t size() const { return triangle_count_; }
  /// Throws bad_input if borrowed arrays were changed so that it is none any more.
  [[nodiscard]] TriangleD triangle(std::size_t i) const;
  [[nodiscard]] const Bounds3d& bounds() const { return bounds_; }
  [[nodiscard]] std::optional<UpAxis> up() const { return up_; }
  /// Returns the mesh with vertices of equal coordinates merged, as read_mesh() does.
  [[nodiscard]] IndexedMesh mesh() const;
  /// Returns the mesh with its vertices as they are, in their order.
  [[nodiscard]] IndexedMesh mesh_as_given() const;
  /// Returns a source as those of files are. It keeps a reference to this object.
  [[nodiscard]] RawSourcePtr open() const;

 private:
  /// One array: rows of three numbers.
  struct Rows {
    const std::byte* data = nullptr;
    std::size_t stride = 0, count = 0;
    std::int32_t type = 0;
  };
  [[nodiscard]] static Rows rows(const void* data, std::size_t count, std::size_t stride, std::int32_t type,
                                 const char* name);
  /// Numbers above those of std::int64_t become the largest of these.
  [[nodiscard]] std::int64_t index(std::size_t triangle, std::size_t corner) const;
  [[nodiscard]] std::string index_text(std::size_t triangle, std::size_t corner) const;
  [[nodiscard]] Vec3d vertex(std::size_t i) const;
  void check();
  void copy();

  Rows vertices_, triangles_;
  std::vector<Vec3d> own_vertices_;
  std::vector<std::array<std::uint32_t, 3>> own_triangles_;
  std::size_t triangle_count_ = 0;
  std::optional<UpAxis> up_;
  Bounds3d bounds_;
};

/// Returns the axis of a bp_up; nothing if it is unknown. Throws bad_argument if it is none.
[[nodiscard]] std::optional<UpAxis> up_of(std::int32_t up);

}  // namespace bp::api
