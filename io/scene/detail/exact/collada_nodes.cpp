#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/scene/detail/exact/collada_xml.h"
#include "lib/core/vec3.h"

// The nodes of a COLLADA document (1.4.1, chapter "Core elements": node, and the transforms), in double. Parts of the
// document that Assimp leaves out, or reads in another way, are counted: nothing is proven of such a scene. Assimp 5
// stops at <skew>, and finds no mesh of a <morph>.

namespace bp {

namespace {

std::vector<double> transform_numbers(const ColladaXml& element, std::size_t n) {
  std::vector<double> numbers = collada_numbers(element);
  if (numbers.size() != n) throw ColladaUnfit();
  return numbers;
}

Vec3d unit(const Vec3d& v) {
  const double size = length(v);
  if (!(size > 0)) throw ColladaUnfit();
  return (1 / size) * v;
}

void set_linear(Affine& a, const std::array<Vec3d, 3>& rows) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) a.m[i][j] = rows[i][j];
  }
}

constexpr double kTurnRounding = 0x1p-46;  // rounding of a sine, a cosine, a unit vector, and products of three of them

void blur_linear(Affine& a, double off = kTurnRounding) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) a.off.set(i, j, off);
  }
}

struct SineCosine {
  double sine, cosine;
  bool exact;
};

/// Returns the sine and cosine; whole quarter turns are exact.
SineCosine sine_cosine(double degrees) {
  if (!(std::abs(degrees) <= 1e6)) throw ColladaUnfit();
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

Affine rotation(const ColladaXml& element) {
  const std::vector<double> r = transform_numbers(element, 4);
  const Vec3d n = unit({r[0], r[1], r[2]});
  const SineCosine turn = sine_cosine(r[3]);
  const double s = turn.sine, c = turn.cosine, d = 1 - c;
  Affine a;
  set_linear(a, {Vec3d{d * n[0] * n[0] + c, d * n[0] * n[1] - s * n[2], d * n[0] * n[2] + s * n[1]},
                 Vec3d{d * n[1] * n[0] + s * n[2], d * n[1] * n[1] + c, d * n[1] * n[2] - s * n[0]},
                 Vec3d{d * n[2] * n[0] - s * n[1], d * n[2] * n[1] + s * n[0], d * n[2] * n[2] + c}});
  // An axis with few decimals is no unit vector, and some programs turn about it as it is: the matrix's numbers are
  // products of two of its numbers at most, times 2.
  const double stretch = std::abs(length(Vec3d{r[0], r[1], r[2]}) - 1);
  if (!turn.exact || !is_axis({r[0], r[1], r[2]})) blur_linear(a, kTurnRounding + 8 * std::min(stretch, 1.0));
  return a;
}

/// Returns the transform of <lookat>: from the eye to the point that it looks at.
Affine look_at(const ColladaXml& element) {
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

/// Returns the transform of an element; none if the element is no transform.
std::optional<Affine> transform_of(const ColladaXml& element) {
  Affine a;
  if (is_element(element, "matrix")) {
    const std::vector<double> m = transform_numbers(element, 16);
    if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) throw ColladaUnfit();
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) a.m[i][j] = m[4 * i + j];
    }
    return a;
  }
  if (is_element(element, "translate") || is_element(element, "scale")) {
    const std::vector<double> v = transform_numbers(element, 3);
    for (std::size_t i = 0; i < 3; ++i) a.m[i][is_element(element, "scale") ? i : 3] = v[i];
    return a;
  }
  if (is_element(element, "rotate")) return rotation(element);
  if (is_element(element, "lookat")) return look_at(element);
  return {};
}

/// The larger magnitude of two numbers that a float32 reader adds: if they cancel, its error is a share of that
/// magnitude.
class TermSizes {
 public:
  void multiply(const Affine& next) {
    Affine sizes;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) sizes.m[i][j] = std::abs(next.m[i][j]);
    }
    terms_ = terms_ * sizes;
  }
  void tell(ExactNode& node) const {
    for (const auto& row : terms_.m) {
      for (std::size_t j = 0; j < 3; ++j) node.largest = std::max(node.largest, row[j]);
      node.farthest = std::max(node.farthest, row[3]);
    }
  }

 private:
  Affine terms_;
};

class NodeTree {
 public:
  NodeTree(const ColladaXml& document, Unfollowed& unfollowed) : unfollowed_(unfollowed) {
    for (const ColladaXml library : document.children("library_nodes")) add_ids(library, "node", nodes_of_);
    for (const ColladaXml library : document.children("library_visual_scenes")) add_ids(library, "node", nodes_of_);
    for (const ColladaXml library : document.children("library_geometries")) add_ids(library, "geometry", geometries_);
    for (const ColladaXml library : document.children("library_controllers"))
      add_ids(library, "controller", controllers_);
  }

  ExactNode of(const ColladaXml& node, int depth = 0) {
    if (depth == kMostNested || ++nodes_ > kMostNodes) throw ColladaUnfit();
    ExactNode out;
    TermSizes terms;
    for (const ColladaXml element : node.children()) {
      const std::optional<Affine> next = transform_of(element);
      if (!next) continue;
      out.transform = out.transform * *next;
      terms.multiply(*next);
    }
    terms.tell(out);
    if (node.child("skew")) sheared_ = true;
    note_shapes(node);
    for (const ColladaXml child : node.children("node")) out.children.push_back(of(child, depth + 1));
    for (const ColladaXml instance : node.children("instance_node")) {
      const char* const url = instance.attribute("url").value();
      const auto found = nodes_of_.find(collada_target(url));
      if (found != nodes_of_.end())
        out.children.push_back(of(found->second, depth + 1));
      else
        ++unfollowed_.missing;  // perhaps a node of another file
    }
    return out;
  }
  [[nodiscard]] bool sheared() const { return sheared_; }

 private:
  static constexpr int kMostNested = 1000;
  static constexpr std::uint64_t kMostNodes = 1'000'000;
  using ById = std::map<std::string, ColladaXml>;

  static void add_ids(const ColladaXml& parent, const char* name, ById& all) {
    struct Ids final : pugi::xml_tree_walker {
      const char* name = nullptr;
      ById* all = nullptr;
      bool for_each(ColladaXml& node) override {
        if (is_element(node, name) && node.attribute("id")) all->try_emplace(node.attribute("id").value(), node);
        return true;
      }
    } walker;
    walker.name = name;
    walker.all = &all;
    ColladaXml(parent).traverse(walker);
  }

  /// Counts the shapes of a node that Assimp leaves out, and those that a controller moves. Bones are checked when
  /// Assimp has read them (assimp_bones.h).
  void note_shapes(const ColladaXml& node) {
    for (const ColladaXml instance : node.children("instance_geometry")) {
      const auto found = geometries_.find(collada_target(instance.attribute("url").value()));
      if (found == geometries_.end() || found->second.child("convex_mesh") || found->second.child("brep"))
        ++unfollowed_.missing;
    }
    for (const ColladaXml instance : node.children("instance_controller")) {
      const auto found = controllers_.find(collada_target(instance.attribute("url").value()));
      if (found != controllers_.end()) note_controller(found->second);
    }
  }
  void note_controller(const ColladaXml& controller) {
    const ColladaXml skin = controller.child("skin");
    if (!geometries_.contains(collada_target(skin.attribute("source").value()))) {
      ++unfollowed_.missing;
    } else if (has_no_joints(skin)) {
      ++unfollowed_.skins;
    }
  }
  /// Returns whether all vertices of a skin are without a joint. Programs differ on where such vertices stay. A skin of
  /// these alone has no bones for Assimp.
  static bool has_no_joints(const ColladaXml& skin) {
    const std::vector<double> joints = collada_numbers(skin.child("vertex_weights").child("vcount"));
    return std::all_of(joints.begin(), joints.end(), [](double n) { return !(n > 0); });
  }

  ById nodes_of_, geometries_, controllers_;
  Unfollowed& unfollowed_;
  std::uint64_t nodes_ = 0;
  bool sheared_ = false;
};

/// Returns the transform after that of the visual scene: its unit in metres, and the axis that is up. Programs turn
/// X_UP to different sides.
Affine to_metres(const ColladaXml& asset) {
  Affine a;
  const pugi::xml_attribute meter = asset.child("unit").attribute("meter");
  const std::optional<std::vector<double>> unit = only_numbers_in(meter ? meter.value() : "1");
  if (!unit || unit->size() != 1 || !(unit->front() > 0)) throw ColladaUnfit();
  for (std::size_t i = 0; i < 3; ++i) a.m[i][i] = unit->front();
  Affine turn;
  const std::string_view up = collada_text(asset.child("up_axis"));
  if (up == "Z_UP")
    turn.m = {{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}}};
  else if (up != "Y_UP" && asset.child("up_axis"))
    throw ColladaUnfit();
  return a * turn;
}

/// Looks at the targets of a document, and at the ids of what surfaces and their places are made of.
struct IdWalker final : pugi::xml_tree_walker {
  bool for_each(ColladaXml& element) override {
    const std::string kind = element.name(), id = element.attribute("id").value();
    const std::string name = element.attribute("name").value();
    constexpr std::array<std::string_view, 7> kPlaced{"node",   "geometry", "controller", "visual_scene",
                                                      "source", "vertices", "float_array"};
    const bool is_placed = std::find(kPlaced.begin(), kPlaced.end(), kind) != kPlaced.end();
    if (is_placed && !id.empty() && !ids.insert(kind + "#" + id).second) ++doubts;
    if (name != id) names.insert(kind + "#" + name);
    if (kind == "instance_node" || kind == "instance_geometry")
      targets.push_back(kind.substr(kInstance.size()) + element.attribute("url").value());
    if ((kind == "unit" || kind == "up_axis") && is_element(element.parent(), "asset") &&
        (!is_element(element.parent().parent(), "COLLADA") || !ids.insert(kind).second))
      ++doubts;  // a unit of a part of the document, or a second one
    return true;
  }
  static constexpr std::string_view kInstance = "instance_";
  std::set<std::string> ids, names;
  std::vector<std::string> targets;  ///< kind and URL: "node#n"
  std::uint64_t doubts = 0;
};

}  // namespace

std::uint64_t doubtful_ids(const ColladaXml& document) {
  IdWalker all;
  ColladaXml(document).traverse(all);
  for (const std::string& target : all.targets) all.doubts += all.names.contains(target) ? 1 : 0;
  return all.doubts;
}

void read_collada_nodes(const ColladaXml& document, ExactScene& scene) {
  scene.is_known = true;
  for (const ColladaXml library : document.children("library_controllers")) {
    if (library.find_child([](const ColladaXml& controller) { return !controller.child("morph").empty(); }))
      scene.unread = "a mesh has morph targets (<morph>), which are not read from COLLADA";
  }
  try {
    const ColladaXml instance = document.child("scene").child("instance_visual_scene");
    const std::string shown = collada_target(instance.attribute("url").value());
    std::ptrdiff_t scenes = 0;
    for (const ColladaXml library : document.children("library_visual_scenes")) {
      const auto all = library.children("visual_scene");
      scenes += std::distance(all.begin(), all.end());
      const ColladaXml visual = library.find_child_by_attribute("visual_scene", "id", shown.c_str());
      if (!visual) continue;
      NodeTree tree(document, scene.unfollowed);
      scene.root = tree.of(visual);
      if (tree.sheared()) scene.unread = "a node has <skew>, which programs read in different ways or leave out";
      scene.root->transform = to_metres(document.child("asset"));
    }
    if (scenes > 1) ++scene.unfollowed.missing;
  } catch (const ColladaUnfit&) {
    scene.root = {};  // Assimp's nodes are taken
  }
}

}  // namespace bp
