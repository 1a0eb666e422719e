#include <algorithm>
#include <new>
#include <numeric>
#include <utility>

#include "io/scene/detail/exact/collada_xml.h"
#include "lib/core/vec3.h"

// COLLADA (Khronos, COLLADA 1.4.1 and 1.5.0): positions of the corners of each primitive; the nodes of the visual
// scene are in collada_nodes.cpp. An XML document is no program: the parser knows no entities but those of the
// standard, and loads nothing.

namespace bp {

namespace {

// --- Meshes

ColladaXml only_child(const ColladaXml& parent, const char* name) {
  const ColladaXml child = parent.child(name);
  if (!child || child.next_sibling(name)) throw ColladaUnfit();
  return child;
}

/// Returns the numbers of a list of vertices, or of their counts.
std::vector<double> whole_numbers(const ColladaXml& list) {
  if (collada_text(list).find_first_not_of("0123456789 \t\r\n") != std::string_view::npos) throw ColladaUnfit();
  return collada_numbers(list);
}

/// The positions that a mesh's vertices name, as nearly all programs write them: X, Y and Z, one after the other.
class PositionSource {
 public:
  explicit PositionSource(const ColladaXml& mesh) {
    const ColladaXml vertices = only_child(mesh, "vertices");
    const ColladaXml input = vertices.find_child_by_attribute("input", "semantic", "POSITION");
    const auto inputs = vertices.children("input");
    const auto is_position = [](const ColladaXml& i) {
      return std::string_view(i.attribute("semantic").value()) == "POSITION";
    };
    if (std::count_if(inputs.begin(), inputs.end(), is_position) != 1) throw ColladaUnfit();
    const ColladaXml source =
        mesh.find_child_by_attribute("source", "id", collada_target(input.attribute("source").value()).c_str());
    const ColladaXml array = only_child(source, "float_array");
    const ColladaXml accessor = only_child(only_child(source, "technique_common"), "accessor");
    numbers_ = collada_numbers(array);
    std::string names;
    for (const ColladaXml param : accessor.children("param")) names += param.attribute("name").value();
    const bool plain = names == "XYZ" && collada_number(accessor, "stride", 1) == 3 &&
                       collada_number(accessor, "offset", 0) == 0 &&
                       collada_target(accessor.attribute("source").value()) == array.attribute("id").value();
    const std::uint64_t n = numbers_.size();
    if (!plain || n != collada_number(array, "count", 0) || n != 3 * collada_number(accessor, "count", 0))
      throw ColladaUnfit();
    vertices_ = vertices.attribute("id").value();
  }

  [[nodiscard]] const std::string& vertices() const { return vertices_; }
  [[nodiscard]] Vec3d at(std::uint64_t i) const {
    if (i >= numbers_.size() / 3) throw ColladaUnfit();
    return {numbers_[3 * i], numbers_[3 * i + 1], numbers_[3 * i + 2]};
  }

 private:
  std::vector<double> numbers_;
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
      if (found_ || collada_target(input.attribute("source").value()) != vertices) throw ColladaUnfit();
      vertex_ = offset;
      found_ = true;
    }
    if (!found_) throw ColladaUnfit();
  }
  [[nodiscard]] std::vector<std::uint64_t> of(const ColladaXml& p) const {
    const std::vector<double> all = whole_numbers(p);
    if (all.size() % inputs_ != 0) throw ColladaUnfit();
    std::vector<std::uint64_t> corners;
    for (std::size_t i = vertex_; i < all.size(); i += inputs_) {
      if (!(all[i] < 0x1p53)) throw ColladaUnfit();
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
  if (!is_element(primitive, "polylist")) return;
  const std::vector<double> corners = whole_numbers(only_child(primitive, "vcount"));
  if (std::accumulate(corners.begin(), corners.end(), 0.0) != double(positions.size())) throw ColladaUnfit();
}

void add_geometry(const ColladaXml& geometry, ExactScene& scene) {
  const ColladaXml mesh = geometry.child("mesh");
  if (!mesh || mesh.next_sibling("mesh")) return;
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

ExactScene exact_collada(std::string text) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_buffer_inplace(text.data(), text.size(), pugi::parse_default & ~pugi::parse_escapes);
  if (parsed.status == pugi::status_out_of_memory) throw std::bad_alloc();
  ExactScene scene;
  if (!parsed) {
    scene.unfollowed.vertices = 1;
    return scene;
  }
  const ColladaXml root = document.child("COLLADA");
  for (const ColladaXml library : root.children("library_geometries")) {
    for (const ColladaXml geometry : library.children("geometry")) add_geometry(geometry, scene);
  }
  read_collada_nodes(root, scene);
  scene.unfollowed.transforms += doubtful_ids(root);
  return scene;
}

}  // namespace bp
