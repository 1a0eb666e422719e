#pragma once
#include <cstring>
#include <optional>

#include "io/scene/detail/ply/ply_header.h"
#include "io/scene/detail/ply/ply_values.h"
#include "lib/core/vec3.h"

namespace bp {

/// The positions of numbers in a packed PLY (packed_ply.h).
struct PackedLayout {
  bool swap = false;
  std::uint64_t vertices = 0, vertex_count = 0, stride = 0;
  PlyType type[3]{};      // of x, y, z
  std::size_t at[3]{};    // offsets in the record
  bool together = false;  // floats side by side, as in memory
  std::uint64_t faces = 0, face_count = 0;
  std::size_t before = 0, after = 0;  // bytes of a face's record before and after the list
  PlyType count_type = PlyType::u8, index_type = PlyType::i32;

  [[nodiscard]] std::size_t record_bytes(std::uint64_t corners) const {
    return before + bytes_of(count_type) + std::size_t(corners) * bytes_of(index_type) + after;
  }
  /// Returns the number of corners of a face's list.
  [[nodiscard]] std::int64_t corners_at(const std::byte* list) const {
    return count_type == PlyType::u8 ? std::int64_t(*list) : decode_integer(list, count_type, swap);
  }
  /// Returns the position in a vertex's record.
  [[nodiscard]] Vec3d position(const std::byte* record) const {
    Vec3d p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = decode_real(record + at[i], type[i], swap);
    return p;
  }
  /// Returns three floats as they are in memory.
  [[nodiscard]] static Vec3d floats(const std::byte* from) {
    float p[3];
    std::memcpy(p, from, sizeof p);
    return {p[0], p[1], p[2]};
  }
};

/// Returns nothing unless the file is as packed_ply.h describes.
[[nodiscard]] std::optional<PackedLayout> packed_layout_of(const PlyHeader& header, std::uint64_t file_bytes);

}  // namespace bp
