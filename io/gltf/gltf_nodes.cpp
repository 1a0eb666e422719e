#include "io/gltf/gltf_nodes.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"

namespace bp {

bool has_record(const GltfObject& root) {
  static const GltfJson::json_pointer record("/asset/extras/provenance");
  return root.json().contains(record) && root.json().at(record).is_array();
}

std::optional<UpAxis> gltf_up(const GltfObject& root) {
  if (!has_record(root)) return {};
  const GltfObject asset = root.object("asset");
  for (const char* const name : kUpNames) {
    if (asset.holds_text("extras", "up", name)) return up_axis_named(name);
  }
  return {};
}

// Turns files of this suite, which stand upright in glTF's y-up world, back to their own coordinates.
Affine gltf_world(const GltfObject& root) {
  if (gltf_rtc_center(root) != Vec3d{}) root.unfit("is moved by CESIUM_RTC, which only contents of a tileset may be");
  return affine_of(to_y_up(gltf_up(root).value_or(UpAxis::y)).inverse());
}

Vec3d gltf_rtc_center(const GltfObject& root) {
  if (!root.has_extension("CESIUM_RTC")) return {};
  return root.object("extensions").object("CESIUM_RTC").numbers<3>("center", {0, 0, 0});
}

// Turns differ from those of scenes if x is up: a quarter turn around y.
Affine gltf_in_tile(UpAxis up) {
  if (up == UpAxis::x) return affine_of(AxisTurn{{2, 1, 0}, {true, false, false}});
  return affine_of(to_y_up(UpAxis::z).inverse()) * affine_of(to_y_up(up));
}

bool has_no_default_scene(const GltfObject& root) {
  const std::size_t scenes = root.array("scenes").size();
  return scenes == 0 || (scenes > 1 && !root.has("scene"));
}

bool gltf_hides(const GltfObject& node) {
  constexpr const char* kName = "KHR_node_visibility";
  if (!node.has_extension(kName)) return false;
  const GltfObject visibility = node.object("extensions").object(kName);
  return visibility.has("visible") && !visibility.flag("visible");
}

Affine gltf_matrix(const GltfObject& object, const char* key) {
  const auto m = object.numbers<16>(key, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  Affine a;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) a.m[i][j] = m[4 * j + i];
  }
  return a;
}

namespace {

/// Returns for each node whether it is a child of another.
std::vector<bool> gltf_children(const GltfObject& root) {
  const std::size_t nodes = root.array("nodes").size();
  std::vector<bool> child(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    const GltfObject node = root.item("nodes", i);
    for (std::size_t k = 0; k < node.array("children").size(); ++k) {
      if (node.index("children", k) < nodes) child[std::size_t(node.index("children", k))] = true;
    }
  }
  return child;
}

}  // namespace

std::uint64_t children_among(const GltfObject& root, const std::vector<std::uint64_t>& nodes) {
  const std::vector<bool> child = gltf_children(root);
  return std::uint64_t(std::count_if(
      nodes.begin(), nodes.end(), [&](std::uint64_t node) { return node < child.size() && child[std::size_t(node)]; }));
}

std::size_t gltf_targets(const GltfObject& mesh) {
  return mesh.array("primitives").empty() ? 0 : mesh.item("primitives", 0).array("targets").size();
}

std::vector<std::uint64_t> gltf_roots(const GltfObject& root) {
  std::vector<std::uint64_t> roots;
  if (root.array("scenes").empty()) {
    const std::vector<bool> child = gltf_children(root);
    for (std::size_t i = 0; i < child.size(); ++i) {
      if (!child[i]) roots.push_back(i);
    }
    return roots;
  }
  const GltfObject scene = root.item("scenes", root.number("scene", 0));
  for (std::size_t k = 0; k < scene.array("nodes").size(); ++k) roots.push_back(scene.index("nodes", k));
  return roots;
}

bool is_sheared(const GltfObject& node) {
  constexpr double kMostOff = 2e-4;  // cosine of an angle between axes; numbers of four digits are off by 5e-5
  if (!node.has("matrix")) return false;
  const Affine a = gltf_matrix(node, "matrix");
  const auto column = [&](std::size_t i) { return Vec3d{a.m[0][i], a.m[1][i], a.m[2][i]}; };
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d u = column(i), v = column((i + 1) % 3);
    if (!(std::abs(dot(u, v)) <= kMostOff * length(u) * length(v))) return true;
  }
  return false;
}

Affine gltf_transform(const GltfObject& node, const ScenePose::Node* pose) {
  if (node.has("matrix")) {
    for (const char* key : {"translation", "rotation", "scale"})
      if (node.has(key))
        node.unfit(std::string("has a matrix and a ") + key + ", and programs disagree on what that means");
    const auto m = node.numbers<16>("matrix", {});
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) node.unfit("has a matrix whose last row is not 0 0 0 1");
    return gltf_matrix(node, "matrix");
  }
  const ScenePose::Node rest, &moved = pose != nullptr ? *pose : rest;
  return affine_of(moved.translation.value_or(node.numbers<3>("translation", {0, 0, 0})),
                   moved.rotation.value_or(node.numbers<4>("rotation", {0, 0, 0, 1})),
                   moved.scale.value_or(node.numbers<3>("scale", {1, 1, 1})));
}

}  // namespace bp
