#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <algorithm>
#include <cmath>
#include <compare>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "io/gltf/detail/gltf_instances.h"
#include "io/gltf/detail/gltf_materials.h"
#include "io/gltf/detail/gltf_skin.h"
#include "io/gltf/detail/told_bounds.h"
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

class SceneBuilder {
 public:
  SceneBuilder(const SceneFilePtr& file, const SceneOptions& options, const std::optional<ContentPlace>& place)
      : doc_(file, options),
        root_(doc_.root()),
        file_(file),
        colors_(options.colors),
        textures_(options.textures.get()),
        surface_(options.surface),
        materials_(doc_, file->name(), options),
        walls_only_(options.walls_only),
        pose_(options.pose.get()),
        options_(options),
        parts_(options.parts, options.part_names),
        level_(options.level),
        place_(place) {}

  InstancedScene build() {
    scene_.nodes.reserve(root_.array("nodes").size());
    places_.resize(root_.array("nodes").size());
    if (!place_) scene_.up = gltf_up(root_);
    if (place_) scene_.unread = gltf_unread(root_);
    const std::vector<std::uint64_t> roots = gltf_roots(root_);
    scene_.unfollowed.transforms += children_among(root_, roots);
    add_nodes(roots, place_ ? placed() : gltf_world(root_));
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
  struct Range {
    std::uint32_t first, end;
  };
  static constexpr std::uint64_t kNoSkin = ~std::uint64_t(0);
  struct Pending {
    std::uint64_t node;
    Affine parent;
    bool wanted;  // it is below a node whose name fits
    bool hidden;  // it is below a node that hides it
  };
  /// The morph weights and skin that move a mesh before its node places it.
  struct Moved {
    std::vector<double> weights;  // weights of its morph targets; empty: none
    std::uint64_t skin = kNoSkin;
    auto operator<=>(const Moved&) const = default;
  };
  struct Skinned {
    std::uint64_t node;
    bool wanted;
    Moved moved;
  };
  /// A mesh with its weights and skin: all of its parts, or only those whose names fit.
  using MovedMesh = std::tuple<std::uint64_t, bool, Moved>;
  [[nodiscard]] Affine placed() const;
  void add_nodes(const std::vector<std::uint64_t>& roots, const Affine& world);
  std::uint64_t level_of(std::uint64_t i);
  [[nodiscard]] std::set<std::uint64_t> coarser_nodes() const;
  [[nodiscard]] const ScenePose::Node* pose_of(std::uint64_t node) const;
  [[nodiscard]] std::vector<double> weights_of(const GltfObject& node, const ScenePose::Node* pose) const;
  void add_mesh_node(const GltfObject& node, const Affine& transform, bool wanted, const Moved& moved);
  void add_skinned(const Skinned& skinned);
  const GltfSkin& skin(std::uint64_t i);
  Range mesh(std::uint64_t i, bool wanted, const Moved& moved);
  [[nodiscard]] bool fits(const GltfObject& named) const;
  [[nodiscard]] std::string name_of(const GltfObject& node) const;
  void note_parts();
  [[nodiscard]] bool has_material_that_fits(const GltfObject& primitive) const;
  void add_primitive(const GltfObject& p, const Moved& moved);
  void add_positions(const GltfObject& p, const Moved& moved, bool packed, Primitive& primitive);
  void add_normals(const GltfObject& p, const Moved& moved, Primitive& primitive);
  void add_colors(const GltfObject& p, const GltfObject& attributes, Primitive& primitive);
  void try_texture(std::uint64_t material, const GltfObject& attributes, Primitive& primitive);
  std::optional<std::uint32_t> instance_array(const GltfObject& node);

  GltfDocument doc_;
  GltfObject root_;
  SceneFilePtr file_;
  const bool colors_;
  TextureTable* const textures_;  // null: images are not asked for
  const bool surface_;
  GltfMaterials materials_;
  const bool walls_only_;
  const ScenePose* const pose_;  // null: as the file shows it
  const SceneOptions& options_;
  const PartFilter parts_;
  const std::size_t level_;
  const std::optional<ContentPlace> place_;
  InstancedScene scene_;
  std::vector<std::string> names_;  // names of scene_.nodes, if parts_ asks for triangles
  std::map<MovedMesh, Range> meshes_;
  std::vector<std::optional<Affine>> places_;  // places of the nodes that were reached
  std::vector<Skinned> skinned_;               // nodes with skins, which wait until all joints are placed
  std::map<std::uint64_t, GltfSkin> skins_;
};

// Returns the place of a content in its tile. Tiles have z up. CESIUM_RTC of older files moves contents.
Affine SceneBuilder::placed() const {
  Affine centre;
  const Vec3d at = gltf_rtc_center(root_);
  for (std::size_t i = 0; i < 3; ++i) centre.m[i][3] = at[i];
  return place_->tile * centre * gltf_in_tile(place_->up);
}

// Depth first, without recursion: a chain of nodes may be as long as the file.
void SceneBuilder::add_nodes(const std::vector<std::uint64_t>& roots, const Affine& world) {
  std::vector<Pending> stack;
  const std::set<std::uint64_t> coarser = level_ > 0 ? coarser_nodes() : std::set<std::uint64_t>{};
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
    const ScenePose::Node* const pose = pose_of(next.node);
    const Affine transform = next.parent * gltf_transform(node, pose);
    const bool turns = is_unit_rotation(node.numbers<4>("rotation", {0, 0, 0, 1}));
    if (!turns || is_sheared(node)) ++scene_.unfollowed.transforms;
    place = transform;
    const bool wanted = fits(node) || next.wanted, hidden = gltf_hides(node) || next.hidden;
    const bool is_drawn = node.has("mesh") && !(walls_only_ && hidden);
    if (is_drawn && hidden) ++scene_.unfollowed.hidden;
    if (is_drawn && node.has("skin")) {
      skinned_.push_back({next.node, wanted, {weights_of(node, pose), node.number("skin")}});
    } else if (is_drawn) {
      add_mesh_node(node, transform, wanted, {weights_of(node, pose)});
    }
    for (std::size_t k = node.array("children").size(); k-- > 0;)
      stack.push_back({node.index("children", k), transform, wanted, hidden});
  }
}

// Returns the nodes that are coarser levels of others. If a scene lists them as well, they are not drawn.
std::set<std::uint64_t> SceneBuilder::coarser_nodes() const {
  std::set<std::uint64_t> nodes;
  for (std::size_t i = 0; i < root_.array("nodes").size(); ++i) {
    const GltfObject node = root_.item("nodes", i);
    if (!node.has_extension("MSFT_lod")) continue;
    const GltfObject lod = node.object("extensions").object("MSFT_lod");
    for (std::size_t k = 0; k < lod.array("ids").size(); ++k) nodes.insert(lod.index("ids", k));
  }
  return nodes;
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

bool SceneBuilder::fits(const GltfObject& named) const {
  return named.has("name") && parts_.fits(named.text("name"));
}

bool SceneBuilder::has_material_that_fits(const GltfObject& primitive) const {
  return primitive.has("material") && fits(root_.item("materials", primitive.number("material")));
}

const ScenePose::Node* SceneBuilder::pose_of(std::uint64_t node) const {
  if (pose_ == nullptr) return nullptr;
  const auto found = pose_->nodes.find(node);
  return found == pose_->nodes.end() ? nullptr : &found->second;
}

// Returns the morph weights of a node's mesh; empty: none.
std::vector<double> SceneBuilder::weights_of(const GltfObject& node, const ScenePose::Node* pose) const {
  std::vector<double> weights;
  if (pose_ != nullptr && pose_->base) return weights;
  if (pose != nullptr && pose->weights) return *pose->weights;
  if (pose_ != nullptr && pose_->target) {
    weights.resize(*pose_->target + 1);
    weights.back() = 1;
    return weights;
  }
  const GltfObject owner = node.has("weights") ? node : root_.item("meshes", node.number("mesh"));
  for (const GltfJson& w : owner.array("weights")) {
    if (!w.is_number()) owner.broken("'weights' holds something else than numbers");
    weights.push_back(w.get<double>());
  }
  const std::size_t targets = gltf_targets(root_.item("meshes", node.number("mesh")));
  if (owner.has("weights") && weights.size() != targets)
    owner.unfit(fmt::format("has {} weights, and the mesh has {} morph targets", weights.size(), targets));
  if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; })) weights.clear();
  return weights;
}

void SceneBuilder::add_mesh_node(const GltfObject& node, const Affine& transform, bool wanted, const Moved& moved) {
  const Range range = mesh(node.number("mesh"), wanted, moved);
  if (range.first == range.end) return;
  scene_.nodes.push_back({transform, range.first, range.end, instance_array(node)});
  if (parts_.asks_for_triangles()) names_.push_back(name_of(node));
}

/// Returns the name of a node with a mesh, or the mesh's name, or its number.
std::string SceneBuilder::name_of(const GltfObject& node) const {
  const GltfObject mesh = root_.item("meshes", node.number("mesh"));
  for (const GltfObject& named : {node, mesh}) {
    if (named.has("name") && !named.text("name").empty()) return named.text("name");
  }
  return node.place();
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
  add_mesh_node(node, {}, skinned.wanted, skinned.moved);
}

const GltfSkin& SceneBuilder::skin(std::uint64_t i) {
  const auto known = skins_.find(i);
  if (known != skins_.end()) return known->second;
  return skins_.emplace(i, GltfSkin(doc_, root_.item("skins", i), places_)).first->second;
}

SceneBuilder::Range SceneBuilder::mesh(std::uint64_t i, bool wanted, const Moved& moved) {
  const MovedMesh key{i, wanted, moved};
  const auto known = meshes_.find(key);
  if (known != meshes_.end()) return known->second;
  const GltfObject mesh = root_.item("meshes", i);
  wanted = fits(mesh) || wanted;
  Range range{std::uint32_t(scene_.primitives.size()), 0};
  bool posed = moved.skin != kNoSkin;
  for (std::size_t k = 0; k < mesh.array("primitives").size(); ++k) {
    const GltfObject primitive = mesh.item("primitives", k);
    posed = posed || !primitive.array("targets").empty();
    if (has_material_that_fits(primitive) || wanted) add_primitive(primitive, moved);
  }
  range.end = std::uint32_t(scene_.primitives.size());
  scene_.posed += posed && range.first < range.end ? 1 : 0;
  meshes_.emplace(key, range);
  return range;
}

void SceneBuilder::add_primitive(const GltfObject& p, const Moved& moved) {
  constexpr std::uint64_t kTriangles = 4, kStrip = 5, kFan = 6;
  const std::uint64_t mode = p.number("mode", kTriangles);
  if (mode > kFan) p.broken(fmt::format("has the unknown mode {}", mode));
  const GltfObject attributes = p.object("attributes");
  if (!attributes.has("POSITION")) return;
  if (mode == 0) scene_.points += root_.item("accessors", attributes.number("POSITION")).number("count", 0);
  if (mode > 0 && mode < kTriangles) ++scene_.lines;
  if (mode < kTriangles) return;  // points and lines
  if (walls_only_ && p.has("material") && materials_.see_through(p.number("material"))) return;
  Primitive primitive;
  const bool plain = doc_.unpack(p);  // true if it was packed: its triangles form no strip then
  primitive.mode = plain            ? Primitive::Mode::triangles
                   : mode == kFan   ? Primitive::Mode::fan
                   : mode == kStrip ? Primitive::Mode::strip
                                    : Primitive::Mode::triangles;
  add_positions(p, moved, plain, primitive);
  if (p.has("indices")) {
    primitive.indices = doc_.accessor(p.number("indices"), 1);
    const ComponentType type = primitive.indices->type;
    if (type != ComponentType::u8 && type != ComponentType::u16 && type != ComponentType::u32)
      p.broken("has indices that are not unsigned integers");
  }
  if (colors_) add_colors(p, attributes, primitive);
  if (textures_ != nullptr && p.has("material")) try_texture(p.number("material"), attributes, primitive);
  if (surface_ && attributes.has("NORMAL")) add_normals(p, moved, primitive);
  scene_.primitives.push_back(primitive);
}

/// Adds the positions, and the bounds that the file tells of them. A pose may move them out of these bounds, which are
/// then those of the positions before.
void SceneBuilder::add_positions(const GltfObject& p, const Moved& moved, bool packed, Primitive& primitive) {
  const GltfObject attributes = p.object("attributes");
  const std::uint64_t number = attributes.number("POSITION");
  primitive.positions = doc_.accessor(number, 3);
  primitive.told = told_bounds(root_.item("accessors", number), primitive.positions, packed);
  primitive.moved = !moved.weights.empty() || moved.skin != kNoSkin;
  const bool lies = !primitive.told || (primitive.moved && !lies_in(doc_, primitive.positions, *primitive.told));
  scene_.unfollowed.culled += lies ? 1 : 0;
  primitive.positions = doc_.morphed(p, "POSITION", primitive.positions, moved.weights);
  if (moved.skin == kNoSkin) return;
  if (!skin(moved.skin).are_whole(attributes, primitive.positions.count)) ++scene_.unfollowed.skins;
  primitive.positions = skin(moved.skin).points(attributes, primitive.positions);
}

void SceneBuilder::add_normals(const GltfObject& p, const Moved& moved, Primitive& primitive) {
  const GltfObject attributes = p.object("attributes");
  const Accessor normals = doc_.accessor(attributes.number("NORMAL"), 3);
  if (normals.count != primitive.positions.count) return;
  primitive.normals = doc_.morphed(p, "NORMAL", normals, moved.weights);
  if (moved.skin != kNoSkin) primitive.normals = skin(moved.skin).normals(attributes, *primitive.normals);
}

// Adds the colours of vertices, in linear light, which the factor multiplies (section 3.9.2).
void SceneBuilder::add_colors(const GltfObject& p, const GltfObject& attributes, Primitive& primitive) {
  if (p.has("material")) {
    const std::array<double, 4> rgba = materials_.base_color(p.number("material"));
    primitive.base_color = {rgba[0], rgba[1], rgba[2]};
  }
  if (!attributes.has("COLOR_0")) return;
  const std::uint64_t i = attributes.number("COLOR_0");
  const bool three = root_.item("accessors", i).text("type") == "VEC3";
  primitive.colors = doc_.accessor(i, three ? 3 : 4);
  if (primitive.colors->count != primitive.positions.count)
    attributes.broken(
        fmt::format("have {} colours for {} positions", primitive.colors->count, primitive.positions.count));
}

/// Adds a material's images. Faults of an image's coordinates are noted, and are no reason to refuse the triangles.
void SceneBuilder::try_texture(std::uint64_t material, const GltfObject& attributes, Primitive& primitive) {
  try {
    materials_.add_texture(material, attributes, primitive);
  } catch (const Error& e) {
    if (e.code() != ErrorCode::bad_input) throw;
    primitive.uv.reset();
    primitive.has_image = false;
    primitive.material = TriangleTexture::kNoMaterial;
    textures_->add_fault(std::string(e.what()) + "; its material's colour is used");
  }
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
