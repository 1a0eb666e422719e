#include "io/scene/detail/ply/packed_layout.h"

#include <algorithm>
#include <bit>
#include <span>

namespace bp {

namespace {

bool lay_out_vertices(const PlyElement& vertex, PackedLayout& layout) {
  const char* const names[] = {"x", "y", "z"};
  layout.stride = vertex.fixed_bytes();
  layout.vertex_count = vertex.count;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t property = vertex.index_of(names[i]);
    if (property == vertex.properties.size()) return false;
    layout.type[i] = vertex.properties[property].type;
    for (std::size_t k = 0; k < property; ++k) layout.at[i] += bytes_of(vertex.properties[k].type);
  }
  layout.together = !layout.swap && layout.at[1] == layout.at[0] + 4 && layout.at[2] == layout.at[1] + 4 &&
                    std::all_of(layout.type, layout.type + 3, [](PlyType t) { return t == PlyType::f32; });
  return true;
}

bool lay_out_faces(const PlyElement& face, PackedLayout& layout) {
  bool found = false;
  layout.face_count = face.count;
  for (const PlyProperty& p : face.properties) {
    if (!p.is_list) {
      (found ? layout.after : layout.before) += bytes_of(p.type);
      continue;
    }
    if (found || (p.name != "vertex_indices" && p.name != "vertex_index")) return false;
    found = true;
    layout.count_type = p.count_type;
    layout.index_type = p.type;
  }
  return found && is_integer(layout.count_type) && is_integer(layout.index_type);
}

}  // namespace

std::optional<PackedLayout> packed_layout_of(const PlyHeader& header, std::uint64_t file_bytes) {
  PackedLayout layout;
  layout.swap = (header.format == PlyHeader::Format::big_endian) != (std::endian::native == std::endian::big);
  bool has_vertices = false;
  std::uint64_t at = header.data.offset;
  for (std::size_t i = 0; i < header.elements.size(); ++i) {
    const PlyElement& element = header.elements[i];
    if (element.name == "face") {
      layout.faces = at;
      for (const PlyElement& e : std::span(header.elements).subspan(i + 1)) {
        if (e.name == "tristrips") return {};
      }
      if (!has_vertices || !lay_out_faces(element, layout)) return {};
      const std::size_t least = layout.record_bytes(0);
      return element.count <= (file_bytes - at) / least ? std::optional(layout) : std::nullopt;
    }
    const std::uint64_t size = element.fixed_bytes();
    if (element.has_lists() || element.name == "tristrips") return {};
    if (size > 0 && element.count > (file_bytes - at) / size) return {};
    if (element.name == "vertex" && !has_vertices) {
      has_vertices = true;
      layout.vertices = at;
      if (!lay_out_vertices(element, layout)) return {};
    }
    at += size * element.count;
  }
  return {};
}

}  // namespace bp
