#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "io/scene/detail/exact/collada_xml.h"
#include "lib/core/vec3.h"

// COLLADA (Khronos, COLLADA 1.4.1 and 1.5.0): positions of the corners of each primitive; the nodes of the visual
// scene are in collada_nodes.cpp. An XML document is no program: the parser knows no entities but those of the
// standard, and loads nothing.

namespace bp {

namespace {

// --- Meshes

/// The positions that a mesh's vertices name.
class PositionSource {
 public:
  explicit PositionSource(const ColladaXml& mesh) {
    const ColladaXml vertices = mesh.child("vertices");
    const ColladaXml input = vertices.find_child_by_attribute("input", "semantic", "POSITION");
    const ColladaXml source =
        mesh.find_child_by_attribute("source", "id", collada_target(input.attribute("source").value()).c_str());
    const ColladaXml accessor = source.child("technique_common").child("accessor");
    numbers_ = numbers_in(collada_text(source.child("float_array")));
    if (!accessor || numbers_.size() != collada_number(source.child("float_array"), "count", 0)) throw ColladaUnfit();
    stride_ = collada_number(accessor, "stride", 1);
    offset_ = collada_number(accessor, "offset", 0);
    count_ = collada_number(accessor, "count", 0);
    std::uint64_t i = 0;
    for (const ColladaXml param : accessor.children("param")) {
      const std::string_view name = param.attribute("name").value();
      if (name.size() == 1 && name[0] >= 'X' && name[0] <= 'Z') component_[std::size_t(name[0] - 'X')] = i;
      ++i;
    }
    vertices_ = vertices.attribute("id").value();
  }

  [[nodiscard]] const std::string& vertices() const { return vertices_; }
  [[nodiscard]] Vec3d at(std::uint64_t i) const {
    if (i >= count_ || stride_ > numbers_.size()) throw ColladaUnfit();
    Vec3d p;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t n = offset_ + i * stride_ + component_[k];
      if (n >= numbers_.size()) throw ColladaUnfit();
      p[k] = numbers_[n];
    }
    return p;
  }

 private:
  std::vector<double> numbers_;
  std::uint64_t stride_ = 1, offset_ = 0, count_ = 0;
  std::array<std::uint64_t, 3> component_{0, 1, 2};
  std::string vertices_;
};

/// Reads numbers of vertices, one for each corner that <p> lists.
class CornerList {
 public:
  CornerList(const ColladaXml& primitive, const std::string& vertices) {
    for (const ColladaXml input : primitive.children("input")) {
      const std::uint64_t offset = collada_number(input, "offset", 0);
      inputs_ = std::max(inputs_, offset + 1);
      if (std::string_view(input.attribute("semantic").value()) != "VERTEX") continue;
      if (collada_target(input.attribute("source").value()) != vertices) throw ColladaUnfit();
      vertex_ = offset;
      found_ = true;
    }
    if (!found_) throw ColladaUnfit();
  }
  [[nodiscard]] std::vector<std::uint64_t> of(const ColladaXml& p) const {
    const std::vector<double> all = numbers_in(collada_text(p));
    if (all.size() % inputs_ != 0) throw ColladaUnfit();
    std::vector<std::uint64_t> corners;
    for (std::size_t i = vertex_; i < all.size(); i += inputs_) {
      if (!(all[i] >= 0 && all[i] < 0x1p53)) throw ColladaUnfit();
      corners.push_back(std::uint64_t(all[i]));
    }
    return corners;
  }

 private:
  std::uint64_t inputs_ = 1, vertex_ = 0;
  bool found_ = false;
};

/// Adds the corners in the order of Assimp's faces. Strips are not cut here.
void add_corners(const ColladaXml& primitive, const PositionSource& source, std::vector<Vec3d>& positions) {
  const bool plain =
      is_element(primitive, "triangles") || is_element(primitive, "polylist") || is_element(primitive, "polygons");
  if (!plain || primitive.child("ph")) throw ColladaUnfit();
  const CornerList list(primitive, source.vertices());
  for (const ColladaXml p : primitive.children("p")) {
    for (const std::uint64_t corner : list.of(p)) positions.push_back(source.at(corner));
  }
}

void add_geometry(const ColladaXml& geometry, ExactScene& scene) {
  const ColladaXml mesh = geometry.child("mesh");
  if (!mesh) return;
  try {
    const PositionSource source(mesh);
    for (const ColladaXml primitive : mesh.children()) {
      if (is_element(primitive, "source") || is_element(primitive, "vertices") || is_element(primitive, "extra"))
        continue;
      ExactMesh out;
      out.name = geometry.attribute("id").value();
      try {
        add_corners(primitive, source, out.positions);
      } catch (const ColladaUnfit&) {
        continue;  // lines, strips, and broken primitives
      }
      if (!out.name.empty()) scene.meshes.push_back(std::move(out));
    }
  } catch (const ColladaUnfit&) {
  }
}

}  // namespace

std::optional<ExactScene> exact_collada(std::string text) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_buffer_inplace(text.data(), text.size(), pugi::parse_default & ~pugi::parse_escapes);
  if (parsed.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!parsed) return {};
  const ColladaXml root = document.child("COLLADA");
  ExactScene scene;
  for (const ColladaXml library : root.children("library_geometries")) {
    for (const ColladaXml geometry : library.children("geometry")) add_geometry(geometry, scene);
  }
  read_collada_nodes(root, scene);
  return scene;
}

}  // namespace bp
