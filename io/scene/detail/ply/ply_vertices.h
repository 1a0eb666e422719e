#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "io/scene/detail/block_cache.h"
#include "io/scene/detail/ply/ply_values.h"
#include "lib/core/color.h"
#include "lib/core/coords.h"
#include "lib/core/error.h"

/// Finds the properties of PLY elements that are coordinates and colours, and reads vertices in place.
namespace bp {

struct PlyPosition {
  std::size_t property[3];  // x, y, z among the element's properties
  /// Returns which of the three numbers a property is; 3: none.
  [[nodiscard]] std::size_t axis_of(std::size_t k) const {
    std::size_t axis = 0;
    while (axis < 3 && property[axis] != k) ++axis;
    return axis;
  }
};

/// The positions of red, green and blue in a vertex or a face, if it has them.
struct PlyColors : PlyPosition {
  double full = 255;  // full value of their type

  static std::optional<PlyColors> of(const PlyElement& e) {
    PlyColors c{};
    const char* const names[] = {"red", "green", "blue"};
    for (std::size_t i = 0; i < 3; ++i) {
      c.property[i] = e.index_of(names[i]);
      if (c.property[i] == e.properties.size() || e.properties[c.property[i]].is_list) return {};
    }
    const PlyType type = e.properties[c.property[0]].type;
    if (type == PlyType::u16) c.full = 65535;
    if (type == PlyType::f32 || type == PlyType::f64) c.full = 1;
    return c;
  }
  [[nodiscard]] LinearColor color(const Vec3d& rgb) const {
    return color_from_srgb({rgb[0] / full, rgb[1] / full, rgb[2] / full});
  }
};

[[nodiscard]] inline bool ply_has_colors(const PlyHeader& header) {
  return std::any_of(header.elements.begin(), header.elements.end(), [](const PlyElement& e) {
    return (e.name == "vertex" || e.name == "face") && PlyColors::of(e).has_value();
  });
}

[[nodiscard]] inline PlyPosition ply_position_of(const PlyElement& vertex, const std::string& file) {
  PlyPosition position{};
  const char* const names[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    position.property[i] = vertex.index_of(names[i]);
    if (position.property[i] == vertex.properties.size() || vertex.properties[position.property[i]].is_list)
      fail(ErrorCode::bad_input, "{}: its vertices have no number '{}'; is it a mesh?", file, names[i]);
  }
  return position;
}

/// Vertices of fixed size, read from their places in the file.
class PlyPackedVertices {
 public:
  PlyPackedVertices(SceneFilePtr file, std::uint64_t budget, std::uint64_t offset, const PlyElement& vertex,
                    const PlyPosition& position, bool swap)
      : cache_(std::move(file), budget), offset_(offset), stride_(vertex.fixed_bytes()), swap_(swap) {
    for (std::size_t i = 0; i < 3; ++i) {
      type_[i] = vertex.properties[position.property[i]].type;
      for (std::size_t k = 0; k < position.property[i]; ++k) at_[i] += bytes_of(vertex.properties[k].type);
    }
    together_ = type_[1] == type_[0] && type_[2] == type_[0] && at_[1] == at_[0] + bytes_of(type_[0]) &&
                at_[2] == at_[1] + bytes_of(type_[0]);
  }
  Vec3d operator[](std::uint64_t i) {
    const std::uint64_t record = offset_ + i * stride_;
    std::byte raw[3][8];
    std::byte* const packed = raw[0];
    if (together_) {
      const std::size_t size = bytes_of(type_[0]);
      cache_.read(record + at_[0], packed, 3 * size);
      return {decode_real(packed, type_[0], swap_), decode_real(packed + size, type_[0], swap_),
              decode_real(packed + 2 * size, type_[0], swap_)};
    }
    for (std::size_t k = 0; k < 3; ++k) cache_.read(record + at_[k], raw[k], bytes_of(type_[k]));
    return {decode_real(raw[0], type_[0], swap_), decode_real(raw[1], type_[1], swap_),
            decode_real(raw[2], type_[2], swap_)};
  }

 private:
  BlockCache cache_;
  std::uint64_t offset_, stride_;
  bool swap_, together_ = false;
  PlyType type_[3]{};
  std::uint64_t at_[3]{};  // offsets of x, y, z in the record
};

}  // namespace bp
