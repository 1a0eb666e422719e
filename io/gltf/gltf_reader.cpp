#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <algorithm>
#include <set>
#include <utility>

#include "io/gltf/detail/gltf_instances.h"
#include "io/gltf/detail/gltf_meshes.h"
#include "io/gltf/gltf_document.h"
#include "io/gltf/gltf_nodes.h"
#include "io/gltf/gltf_unread.h"
#include "io/scene/part_names.h"

// glTF 2.0 and GLB (Khronos, glTF 2.0 specification, section 3.7 on geometry, 3.5 on nodes). Only what says where
// triangles are is looked at: the default scene, nodes, POSITION and indices, sparse accessors, quantized positions
// (KHR_mesh_quantization), what is compressed (KHR_draco_mesh_compression, EXT_meshopt_compression) and instance arrays
// (EXT_mesh_gpu_instancing), and, if asked for, colours; of nodes with levels (MSFT_lod) one, the finest unless asked.
// Vertices stand where a viewer shows them before it plays an animation: the file's weights move morph targets
// (section 3.7.2.2), and joints a skin (3.7.3.3), or a pose does that is asked for (SceneOptions::pose).

namespace bp {

namespace {

// Returns the place of a content in its tile. Tiles have z up. CESIUM_RTC of older files moves contents.
Affine placed(const GltfObject& root, const ContentPlace& place) {
  Affine centre;
  const Vec3d at = gltf_rtc_center(root);
  for (std::size_t i = 0; i < 3; ++i) centre.m[i][3] = at[i];
  return place.tile * centre * gltf_in_tile(place.up);
}

// Returns the nodes that are coarser levels of others. If a scene lists them as well, they are not drawn.
std::set<std::uint64_t> coarser_nodes(const GltfObject& root) {
  std::set<std::uint64_t> nodes;
  for (std::size_t i = 0; i < root.array("nodes").size(); ++i) {
    const GltfObject node = root.item("nodes", i);
    if (!node.has_extension("MSFT_lod")) continue;
    const GltfObject lod = node.object("extensions").object("MSFT_lod");
    for (std::size_t k = 0; k < lod.array("ids").size(); ++k) nodes.insert(lod.index("ids", k));
  }
  return nodes;
}

const ScenePose::Node* pose_of(const ScenePose* whole, std::uint64_t node) {
  if (whole == nullptr) return nullptr;
  const auto found = whole->nodes.find(node);
  return found == whole->nodes.end() ? nullptr : &found->second;
}

// Returns the morph weights of a node's mesh; empty: none. `whole`: the pose asked for; `pose`: of the node; both may
// be null.
std::vector<double> weights_of(const GltfObject& root, const GltfObject& node, const ScenePose* whole,
                               const ScenePose::Node* pose) {
  std::vector<double> weights;
  if (whole != nullptr && whole->base) return weights;
  if (pose != nullptr && pose->weights) return *pose->weights;
  if (whole != nullptr && whole->target) {
    weights.resize(*whole->target + 1);
    weights.back() = 1;
    return weights;
  }
  const GltfObject owner = node.has("weights") ? node : root.item("meshes", node.number("mesh"));
  for (const GltfJson& w : owner.array("weights")) {
    if (!w.is_number()) owner.broken("'weights' holds something else than numbers");
    weights.push_back(w.get<double>());
  }
  const std::size_t targets = gltf_targets(root.item("meshes", node.number("mesh")));
  if (owner.has("weights") && weights.size() != targets)
    owner.unfit(fmt::format("has {} weights, and the mesh has {} morph targets", weights.size(), targets));
  if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; })) weights.clear();
  return weights;
}

/// Returns the name of a node with a mesh, or the mesh's name, or its number.
std::string name_of(const GltfObject& root, const GltfObject& node) {
  const GltfObject mesh = root.item("meshes", node.number("mesh"));
  for (const GltfObject& named : {node, mesh}) {
    if (named.has("name") && !named.text("name").empty()) return named.text("name");
  }
  return node.place();
}

class SceneBuilder {
 public:
  SceneBuilder(const SceneFilePtr& file, const SceneOptions& options, const std::optional<ContentPlace>& place)
      : doc_(file, options),
        root_(doc_.root()),
        walls_only_(options.walls_only),
        pose_(options.pose.get()),
        options_(options),
        parts_(options.parts, options.part_names),
        level_(options.level),
        place_(place),
        meshes_(doc_, file->name(), options, parts_, places_, scene_) {}

  InstancedScene build() {
    scene_.nodes.reserve(root_.array("nodes").size());
    places_.resize(root_.array("nodes").size());
    if (!place_) scene_.up = gltf_up(root_);
    if (place_) scene_.unread = gltf_unread(root_);
    const std::vector<std::uint64_t> roots = gltf_roots(root_);
    scene_.unfollowed.transforms += children_among(root_, roots);
    add_nodes(roots, place_ ? placed(root_, *place_) : gltf_world(root_));
    scene_.unfollowed.variants += has_no_default_scene(root_) || root_.array("animations").size() > 0 ? 1 : 0;
    for (const Skinned& skinned : skinned_) add_skinned(skinned);
    scene_.animations = root_.array("animations").size();
    scene_.bytes = doc_.bytes();
    scene_.differing = doc_.differing();
    scene_.document_bytes = doc_.document_bytes();
    if (parts_.asks_for_triangles()) note_parts();
    return std::move(scene_);
  }

 private:
  struct Pending {
    std::uint64_t node;
    Affine parent;
    bool wanted;  // it is below a node whose name fits
    bool hidden;  // it is below a node that hides it
  };
  struct Skinned {
    std::uint64_t node;
    bool wanted;
    MeshMotion motion;
  };
  void add_nodes(const std::vector<std::uint64_t>& roots, const Affine& world);
  std::uint64_t level_of(std::uint64_t i);
  void add_mesh_node(const GltfObject& node, const Affine& transform, bool wanted, const MeshMotion& motion);
  void add_skinned(const Skinned& skinned);
  void note_parts();
  std::optional<std::uint32_t> instance_array(const GltfObject& node);

  GltfDocument doc_;
  GltfObject root_;
  const bool walls_only_;
  const ScenePose* const pose_;  // null: as the file shows it
  const SceneOptions& options_;
  const PartFilter parts_;
  const std::size_t level_;
  const std::optional<ContentPlace> place_;
  InstancedScene scene_;
  std::vector<std::string> names_;             // names of scene_.nodes, if parts_ asks for triangles
  std::vector<std::optional<Affine>> places_;  // places of the nodes that were reached
  std::vector<Skinned> skinned_;               // nodes with skins, which wait until all joints are placed
  GltfMeshes meshes_;
};

// Depth first, without recursion: a chain of nodes may be as long as the file.
void SceneBuilder::add_nodes(const std::vector<std::uint64_t>& roots, const Affine& world) {
  std::vector<Pending> stack;
  const std::set<std::uint64_t> coarser = level_ > 0 ? coarser_nodes(root_) : std::set<std::uint64_t>{};
  for (std::size_t i = roots.size(); i-- > 0;) {
    if (!coarser.contains(roots[i])) stack.push_back({roots[i], world, parts_.takes_all(), false});
  }
  while (!stack.empty()) {
    Pending next = stack.back();
    stack.pop_back();
    next.node = level_of(next.node);
    const GltfObject node = root_.item("nodes", next.node);
    std::optional<Affine>& place = places_[std::size_t(next.node)];
    if (place) node.broken("is reached twice, and nodes must form trees");
    const ScenePose::Node* const pose = pose_of(pose_, next.node);
    const Affine transform = next.parent * gltf_transform(node, pose);
    const bool turns = is_unit_rotation(node.numbers<4>("rotation", {0, 0, 0, 1}));
    if (!turns || is_sheared(node)) ++scene_.unfollowed.transforms;
    place = transform;
    const bool wanted = name_fits(parts_, node) || next.wanted, hidden = gltf_hides(node) || next.hidden;
    const bool is_drawn = node.has("mesh") && !(walls_only_ && hidden);
    if (is_drawn && hidden) ++scene_.unfollowed.hidden;
    if (is_drawn && node.has("skin")) {
      skinned_.push_back({next.node, wanted, {weights_of(root_, node, pose_, pose), node.number("skin")}});
    } else if (is_drawn) {
      add_mesh_node(node, transform, wanted, {weights_of(root_, node, pose_, pose)});
    }
    for (std::size_t k = node.array("children").size(); k-- > 0;)
      stack.push_back({node.index("children", k), transform, wanted, hidden});
  }
}

// Returns the node that represents node i at the level asked for; its last level if it has fewer.
std::uint64_t SceneBuilder::level_of(std::uint64_t i) {
  const GltfObject node = root_.item("nodes", i);
  if (!node.has_extension("MSFT_lod")) return i;
  const GltfObject lod = node.object("extensions").object("MSFT_lod");
  const std::size_t coarser = lod.array("ids").size();
  scene_.levels = std::max(scene_.levels, 1 + coarser);
  return level_ == 0 || coarser == 0 ? i : lod.index("ids", std::min(level_, coarser) - 1);
}

void SceneBuilder::add_mesh_node(const GltfObject& node, const Affine& transform, bool wanted,
                                 const MeshMotion& motion) {
  const GltfMeshes::Range range = meshes_.add(node.number("mesh"), wanted, motion);
  if (range.first == range.end) return;
  scene_.nodes.push_back({transform, range.first, range.end, instance_array(node)});
  if (parts_.asks_for_triangles()) names_.push_back(name_of(root_, node));
}

/// Reads the triangles of each node separately. Names are asked for only when something is wrong with a scene, so the
/// memory of nodes has no room for names otherwise.
void SceneBuilder::note_parts() {
  for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
    MeshNode node = scene_.nodes[i];
    InstancedScene part;
    part.bytes = scene_.bytes;
    part.primitives.assign(scene_.primitives.begin() + node.first, scene_.primitives.begin() + node.end);
    if (node.instances) part.arrays.push_back(scene_.arrays[*std::exchange(node.instances, 0U)]);
    node.end -= std::exchange(node.first, 0U);
    part.nodes.push_back(node);
    const RawSourcePtr source = stream_instances(std::move(part), options_);
    bool noted = false;
    for (std::vector<TriangleD> some; !noted && source->read(some);)
      noted = std::any_of(some.begin(), some.end(), [&](const TriangleD& t) { return parts_.note(names_[i], t); });
  }
}

// Adds a mesh with a skin. Only its joints decide where it is.
void SceneBuilder::add_skinned(const Skinned& skinned) {
  const GltfObject node = root_.item("nodes", skinned.node);
  if (node.has_extension(kInstancing))
    node.unfit("has a skin and stands in many places: write a node for each, without EXT_mesh_gpu_instancing");
  add_mesh_node(node, {}, skinned.wanted, skinned.motion);
}

std::optional<std::uint32_t> SceneBuilder::instance_array(const GltfObject& node) {
  if (!node.has_extension(kInstancing)) return {};
  if (!requires_extension(root_, kInstancing)) ++scene_.unfollowed.transforms;
  scene_.arrays.push_back(gltf_instances(doc_, node));
  return std::uint32_t(scene_.arrays.size() - 1);
}

}  // namespace

RawSourcePtr open_gltf(SceneFilePtr file, const SceneOptions& options, const std::optional<ContentPlace>& place) {
  InstancedScene scene = SceneBuilder(file, options, place).build();
#ifdef __GLIBC__
  ::malloc_trim(0);  // gives the document's memory back: the next steps need it
#endif
  return stream_instances(std::move(scene), options);
}

}  // namespace bp
