#include "io/gltf/gltf_nodes.h"

namespace bp {

std::optional<UpAxis> gltf_up(const GltfObject& root) {
  if (!root.has("asset")) return {};
  const GltfObject asset = root.object("asset");
  for (const char* const name : kUpNames) {
    if (asset.holds_text("extras", "up", name)) return up_axis_named(name);
  }
  return {};
}

// Turns files of this suite, which stand upright in glTF's y-up world, back to their own coordinates.
Affine gltf_world(std::optional<UpAxis> up) {
  return affine_of(to_y_up(up.value_or(UpAxis::y)).inverse());
}

// Turns differ from those of scenes if x is up: a quarter turn around y.
Affine gltf_in_tile(UpAxis up) {
  if (up == UpAxis::x) return affine_of(AxisTurn{{2, 1, 0}, {true, false, false}});
  return affine_of(to_y_up(UpAxis::z).inverse()) * affine_of(to_y_up(up));
}

Affine gltf_matrix(const GltfObject& object, const char* key) {
  const auto m = object.numbers<16>(key, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  Affine a;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) a.m[i][j] = m[4 * j + i];
  }
  return a;
}

std::vector<std::uint64_t> gltf_roots(const GltfObject& root) {
  std::vector<std::uint64_t> roots;
  if (root.array("scenes").empty()) {
    const std::size_t nodes = root.array("nodes").size();
    std::vector<bool> child(nodes);
    for (std::size_t i = 0; i < nodes; ++i) {
      const GltfObject node = root.item("nodes", i);
      for (std::size_t k = 0; k < node.array("children").size(); ++k) {
        if (node.index("children", k) < nodes) child[std::size_t(node.index("children", k))] = true;
      }
    }
    for (std::size_t i = 0; i < nodes; ++i) {
      if (!child[i]) roots.push_back(i);
    }
    return roots;
  }
  const GltfObject scene = root.item("scenes", root.number("scene", 0));
  for (std::size_t k = 0; k < scene.array("nodes").size(); ++k) roots.push_back(scene.index("nodes", k));
  return roots;
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
