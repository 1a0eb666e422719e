#include <charconv>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <set>

#include "io/scene/detail/exact/exact_scene.h"
#include "lib/core/vec3.h"

// COLLADA (Khronos, COLLADA 1.4.1 and 1.5.0): positions of the corners of each primitive, and the nodes of the visual
// scene. An XML document is no program: the parser knows no entities but those of the standard, and loads nothing.

namespace bp {

namespace {

using Xml = pugi::xml_node;

struct Unfit {};  // thrown where the document is anything else

std::string_view text_of(const Xml& node) {
  return node.child_value();
}

/// Of an element of this document: "#id".
std::string target_of(const char* uri) {
  return uri[0] == '#' ? uri + 1 : "";
}

std::uint64_t number_of(const Xml& node, const char* attribute, std::uint64_t otherwise) {
  const pugi::xml_attribute found = node.attribute(attribute);
  return found.empty() ? otherwise : found.as_ullong();
}

bool is(const Xml& node, std::string_view name) {
  return name == node.name();
}

// --- Meshes

/// The positions that a mesh's vertices name.
class PositionSource {
 public:
  explicit PositionSource(const Xml& mesh) {
    const Xml vertices = mesh.child("vertices");
    const Xml input = vertices.find_child_by_attribute("input", "semantic", "POSITION");
    const Xml source =
        mesh.find_child_by_attribute("source", "id", target_of(input.attribute("source").value()).c_str());
    const Xml accessor = source.child("technique_common").child("accessor");
    numbers_ = numbers_in(text_of(source.child("float_array")));
    if (!accessor || numbers_.size() != number_of(source.child("float_array"), "count", 0)) throw Unfit();
    stride_ = number_of(accessor, "stride", 1);
    offset_ = number_of(accessor, "offset", 0);
    count_ = number_of(accessor, "count", 0);
    std::uint64_t i = 0;
    for (const Xml param : accessor.children("param")) {
      const std::string_view name = param.attribute("name").value();
      if (name.size() == 1 && name[0] >= 'X' && name[0] <= 'Z') component_[std::size_t(name[0] - 'X')] = i;
      ++i;
    }
    vertices_ = vertices.attribute("id").value();
  }

  [[nodiscard]] const std::string& vertices() const { return vertices_; }
  [[nodiscard]] Vec3d at(std::uint64_t i) const {
    if (i >= count_ || stride_ > numbers_.size()) throw Unfit();
    Vec3d p;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t n = offset_ + i * stride_ + component_[k];
      if (n >= numbers_.size()) throw Unfit();
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

/// Numbers of vertices, one for each corner that <p> lists.
class CornerList {
 public:
  CornerList(const Xml& primitive, const std::string& vertices) {
    for (const Xml input : primitive.children("input")) {
      const std::uint64_t offset = number_of(input, "offset", 0);
      inputs_ = std::max(inputs_, offset + 1);
      if (std::string_view(input.attribute("semantic").value()) != "VERTEX") continue;
      if (target_of(input.attribute("source").value()) != vertices) throw Unfit();
      vertex_ = offset;
      found_ = true;
    }
    if (!found_) throw Unfit();
  }
  [[nodiscard]] std::vector<std::uint64_t> of(const Xml& p) const {
    const std::vector<double> all = numbers_in(text_of(p));
    if (all.size() % inputs_ != 0) throw Unfit();
    std::vector<std::uint64_t> corners;
    for (std::size_t i = vertex_; i < all.size(); i += inputs_) {
      if (!(all[i] >= 0 && all[i] < 0x1p53)) throw Unfit();
      corners.push_back(std::uint64_t(all[i]));
    }
    return corners;
  }

 private:
  std::uint64_t inputs_ = 1, vertex_ = 0;
  bool found_ = false;
};

/// In the order of Assimp's faces. A strip is not taken apart here.
void add_corners(const Xml& primitive, const PositionSource& source, std::vector<Vec3d>& positions) {
  const bool plain = is(primitive, "triangles") || is(primitive, "polylist") || is(primitive, "polygons");
  if (!plain || primitive.child("ph")) throw Unfit();
  const CornerList list(primitive, source.vertices());
  for (const Xml p : primitive.children("p")) {
    for (const std::uint64_t corner : list.of(p)) positions.push_back(source.at(corner));
  }
}

void add_geometry(const Xml& geometry, ExactScene& scene) {
  const Xml mesh = geometry.child("mesh");
  if (!mesh) return;
  try {
    const PositionSource source(mesh);
    for (const Xml primitive : mesh.children()) {
      if (is(primitive, "source") || is(primitive, "vertices") || is(primitive, "extra")) continue;
      ExactMesh out;
      out.name = geometry.attribute("id").value();
      try {
        add_corners(primitive, source, out.positions);
      } catch (const Unfit&) {
        continue;  // lines, strips, and what is broken
      }
      if (!out.name.empty()) scene.meshes.push_back(std::move(out));
    }
  } catch (const Unfit&) {
  }
}

// --- Nodes

std::vector<double> transform_numbers(const Xml& element, std::size_t n) {
  std::vector<double> numbers = numbers_in(text_of(element));
  if (numbers.size() < n) throw Unfit();
  return numbers;
}

Vec3d unit(const Vec3d& v) {
  const double size = length(v);
  if (!(size > 0)) throw Unfit();
  return (1 / size) * v;
}

void set_linear(Affine& a, const std::array<Vec3d, 3>& rows) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) a.m[i][j] = rows[i][j];
  }
}

constexpr double kTurnRounding = 0x1p-46;  // a sine, a cosine, a unit vector, and products of three

void blur_linear(Affine& a) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) a.off.set(i, j, kTurnRounding);
  }
}

struct SineCosine {
  double sine, cosine;
  bool exact;
};

/// Whole quarter turns are exact.
SineCosine sine_cosine(double degrees) {
  if (!(std::abs(degrees) <= 1e6)) throw Unfit();
  const double quarters = std::remainder(degrees, 360) / 90;
  if (quarters == std::round(quarters)) {
    const int turn = (int(quarters) + 4) % 4;
    return {turn == 1 ? 1.0 : turn == 3 ? -1.0 : 0.0, turn == 0 ? 1.0 : turn == 2 ? -1.0 : 0.0, true};
  }
  const double radians = std::remainder(degrees, 360) * (M_PI / 180);
  return {std::sin(radians), std::cos(radians), false};
}

bool is_axis(const Vec3d& v) {
  return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]) == 1 && length(v) == 1;
}

Affine rotation(const Xml& element) {
  const std::vector<double> r = transform_numbers(element, 4);
  const Vec3d n = unit({r[0], r[1], r[2]});
  const SineCosine turn = sine_cosine(r[3]);
  const double s = turn.sine, c = turn.cosine, d = 1 - c;
  Affine a;
  set_linear(a, {Vec3d{d * n[0] * n[0] + c, d * n[0] * n[1] - s * n[2], d * n[0] * n[2] + s * n[1]},
                 Vec3d{d * n[1] * n[0] + s * n[2], d * n[1] * n[1] + c, d * n[1] * n[2] - s * n[0]},
                 Vec3d{d * n[2] * n[0] - s * n[1], d * n[2] * n[1] + s * n[0], d * n[2] * n[2] + c}});
  if (!turn.exact || !is_axis({r[0], r[1], r[2]})) blur_linear(a);
  return a;
}

/// From where the eye is, to where it looks.
Affine look_at(const Xml& element) {
  const std::vector<double> r = transform_numbers(element, 9);
  const Vec3d eye{r[0], r[1], r[2]}, to{r[3], r[4], r[5]}, up = unit({r[6], r[7], r[8]});
  const Vec3d along = unit(to - eye), right = unit(cross(along, up));
  const Vec3d top = cross(right, along);
  Affine a;
  set_linear(
      a, {Vec3d{right[0], top[0], -along[0]}, Vec3d{right[1], top[1], -along[1]}, Vec3d{right[2], top[2], -along[2]}});
  for (std::size_t i = 0; i < 3; ++i) a.m[i][3] = eye[i];
  blur_linear(a);
  return a;
}

/// None for an element that is no transform.
std::optional<Affine> transform_of(const Xml& element) {
  Affine a;
  if (is(element, "matrix")) {
    const std::vector<double> m = transform_numbers(element, 16);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) a.m[i][j] = m[4 * i + j];
    }
    return a;
  }
  if (is(element, "translate") || is(element, "scale")) {
    const std::vector<double> v = transform_numbers(element, 3);
    for (std::size_t i = 0; i < 3; ++i) a.m[i][is(element, "scale") ? i : 3] = v[i];
    return a;
  }
  if (is(element, "rotate")) return rotation(element);
  if (is(element, "lookat")) return look_at(element);
  if (is(element, "skew")) throw Unfit();
  return {};
}

class NodeTree {
 public:
  explicit NodeTree(const Xml& document) {
    for (const Xml library : document.children("library_nodes")) add_ids(library);
    for (const Xml library : document.children("library_visual_scenes")) add_ids(library);
  }

  ExactNode of(const Xml& node, int depth = 0) {
    if (depth == kMostNested || ++nodes_ > kMostNodes) throw Unfit();
    ExactNode out;
    for (const Xml element : node.children()) {
      if (const std::optional<Affine> next = transform_of(element)) out.transform = out.transform * *next;
    }
    for (const Xml child : node.children("node")) out.children.push_back(of(child, depth + 1));
    for (const Xml instance : node.children("instance_node")) {
      const auto found = nodes_of_.find(target_of(instance.attribute("url").value()));
      if (found != nodes_of_.end()) out.children.push_back(of(found->second, depth + 1));
    }
    return out;
  }

 private:
  static constexpr int kMostNested = 1000;
  static constexpr std::uint64_t kMostNodes = 1'000'000;

  void add_ids(const Xml& parent) {
    struct Ids final : pugi::xml_tree_walker {
      std::map<std::string, Xml>* all = nullptr;
      bool for_each(Xml& node) override {
        if (is(node, "node") && node.attribute("id")) all->try_emplace(node.attribute("id").value(), node);
        return true;
      }
    } walker;
    walker.all = &nodes_of_;
    Xml(parent).traverse(walker);
  }

  std::map<std::string, Xml> nodes_of_;
  std::uint64_t nodes_ = 0;
};

/// What follows the visual scene's own transform: its unit in metres, and which axis is up.
Affine to_metres(const Xml& asset) {
  Affine a;
  const double metre =
      asset.child("unit").attribute("meter") ? numbers_in(asset.child("unit").attribute("meter").value()).at(0) : 1;
  for (std::size_t i = 0; i < 3; ++i) a.m[i][i] = metre;
  Affine turn;
  const std::string_view up = text_of(asset.child("up_axis"));
  if (up == "X_UP") turn.m = {{{0, -1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}}};
  if (up == "Z_UP") turn.m = {{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}}};
  return a * turn;
}

}  // namespace

std::optional<ExactScene> exact_collada(std::string text) {
  pugi::xml_document document;
  if (!document.load_buffer_inplace(text.data(), text.size(), pugi::parse_default & ~pugi::parse_escapes)) return {};
  const Xml root = document.child("COLLADA");
  ExactScene scene;
  for (const Xml library : root.children("library_geometries")) {
    for (const Xml geometry : library.children("geometry")) add_geometry(geometry, scene);
  }
  try {
    const std::string shown = target_of(root.child("scene").child("instance_visual_scene").attribute("url").value());
    for (const Xml library : root.children("library_visual_scenes")) {
      const Xml visual = library.find_child_by_attribute("visual_scene", "id", shown.c_str());
      if (!visual) continue;
      scene.root = NodeTree(root).of(visual);
      scene.root.transform = to_metres(root.child("asset"));
    }
  } catch (const Unfit&) {
    scene.root = {};  // its nodes are taken from Assimp
  } catch (const std::out_of_range&) {
    scene.root = {};
  }
  return scene;
}

}  // namespace bp
