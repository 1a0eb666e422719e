#include "io/gltf/detail/gltf_vertices.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "io/gltf/gltf_nodes.h"
#include "io/scene/raw_source.h"
#include "lib/core/vec3.h"

namespace bp::detail {

namespace {

/// Returns the inverse of the linear part.
std::optional<Affine> inverse_of(const Affine& a) {
  const Vec3d r0{a.m[0][0], a.m[0][1], a.m[0][2]}, r1{a.m[1][0], a.m[1][1], a.m[1][2]},
      r2{a.m[2][0], a.m[2][1], a.m[2][2]};
  const Vec3d columns[] = {cross(r1, r2), cross(r2, r0), cross(r0, r1)};
  const double determinant = dot(r0, columns[0]);
  if (!(std::abs(determinant) > 0) || !std::isfinite(determinant)) return {};
  Affine inverse;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) inverse.m[i][j] = columns[j][i] / determinant;
    inverse.m[i][3] = 0;
  }
  return inverse;
}

/// Finds all vertices that can move, or tells why some cannot.
class VertexFinder {
 public:
  VertexFinder(GltfDocument& doc, const std::string& name, const SceneOptions& options)
      : doc_(doc), root_(doc.root()), name_(name), options_(options) {}

  GltfPlan find() {
    reserve();
    for (const std::uint64_t node : gltf_roots(root_)) open_.push_back({node, gltf_world(root_)});
    std::reverse(open_.begin(), open_.end());
    while (!open_.empty()) {
      const Open next = open_.back();
      open_.pop_back();
      if (seen_.insert(next.node).second) add_node(next);
    }
    check_shared_bytes();
    return std::move(plan_);
  }

 private:
  struct Open {
    std::uint64_t node;
    Affine parent;
  };
  void reserve();
  void add_node(const Open& next);
  void add_primitive(GltfEdit place, const GltfObject& primitive, const Affine& transform);
  [[nodiscard]] GltfVertices vertices_of(const GltfObject& attributes, const Affine& transform);
  Accessor floats(std::uint64_t number, std::size_t components);
  void check_shared_bytes() const;

  GltfDocument& doc_;
  GltfObject root_;
  const std::string& name_;
  const SceneOptions& options_;
  std::vector<Open> open_;
  std::set<std::uint64_t> seen_, meshes_;
  std::set<std::uint64_t> taken_;  // accessors that are overwritten
  std::map<std::pair<std::array<std::uint64_t, 3>, std::array<std::array<double, 4>, 3>>, std::size_t> known_;
  GltfPlan plan_;
};

/// Reserves memory as if all primitives of all nodes were places of their own.
void VertexFinder::reserve() {
  std::uint64_t places = 0;
  for (std::size_t n = 0; n < root_.array("nodes").size(); ++n) {
    const GltfObject node = root_.item("nodes", n);
    if (node.has("mesh")) places += root_.item("meshes", node.number("mesh")).array("primitives").size();
  }
  check_document(options_, name_, "its JSON and the list of its places",
                 doc_.memory_bytes() + places * GltfPlan::kPlaceBytes, options_.document.bytes);
  plan_.vertices.reserve(places), plan_.edits.reserve(places);
}

/// Adds a node with its coarser levels (MSFT_lod), which stand where the node stands.
void VertexFinder::add_node(const Open& next) {
  const GltfObject node = root_.item("nodes", next.node);
  const Affine transform = next.parent * gltf_transform(node);
  for (std::size_t k = node.array("children").size(); k-- > 0;) open_.push_back({node.index("children", k), transform});
  if (node.has("extensions")) {
    const GltfObject extensions = node.object("extensions");
    if (extensions.has("EXT_mesh_gpu_instancing"))
      node.unfit(
          "stands in many places, and each would bend another way: write a node for each, without "
          "EXT_mesh_gpu_instancing");
    if (extensions.has("MSFT_lod")) {
      const GltfObject lod = extensions.object("MSFT_lod");
      for (std::size_t k = lod.array("ids").size(); k-- > 0;) open_.push_back({lod.index("ids", k), next.parent});
    }
  }
  if (!node.has("mesh")) return;
  if (node.has("skin")) node.unfit("has a skin, whose joints would move it again; export it without");
  const std::uint64_t number = node.number("mesh");
  const GltfObject mesh = root_.item("meshes", number);
  const bool again = !meshes_.insert(number).second;
  for (std::size_t k = 0; k < mesh.array("primitives").size(); ++k)
    add_primitive({next.node, number, k, 0, again}, mesh.item("primitives", k), transform);
}

Accessor VertexFinder::floats(std::uint64_t number, std::size_t components) {
  const GltfObject object = root_.item("accessors", number);
  if (object.has("sparse") || !object.has("bufferView"))
    object.unfit("is sparse, and vertices that move must not be: export it without sparse accessors");
  const GltfObject view = root_.item("bufferViews", object.number("bufferView"));
  const auto packs = [&](const char* name) { return view.has_extension(name); };
  if (std::any_of(kMeshoptNames.begin(), kMeshoptNames.end(), packs))
    view.unfit("is compressed, and vertices that move must not be: unpack it, for instance with gltf-transform");
  if (view.number("buffer") != 0) view.unfit("lies in a second buffer; pack all buffers into one");
  const Accessor accessor = doc_.accessor(number, components);
  if (accessor.type != ComponentType::f32)
    object.unfit("is quantized, and would be rounded: write floats, for instance with gltf-transform dequantize");
  return accessor;
}

/// Adds a primitive. The first place of an accessor uses its bytes; every other place gets a copy.
void VertexFinder::add_primitive(GltfEdit place, const GltfObject& primitive, const Affine& transform) {
  if (primitive.has_extension("KHR_draco_mesh_compression"))
    primitive.unfit("is compressed (KHR_draco_mesh_compression): unpack it, for instance with gltf-transform");
  const GltfObject attributes = primitive.object("attributes");
  if (!attributes.has("POSITION")) return;
  if (primitive.has("targets")) primitive.unfit("has morph targets, which would not fit any more; export it without");
  GltfVertices v = vertices_of(attributes, transform);
  const auto [known, is_new] = known_.try_emplace({v.numbers, v.to_world.m}, plan_.vertices.size());
  place.vertices = known->second;
  if (is_new) {
    for (const std::uint64_t number : v.numbers) v.is_copy = (number > 0 && !taken_.insert(number).second) || v.is_copy;
    plan_.vertices.push_back(v);
  }
  if (plan_.vertices[place.vertices].is_copy) plan_.edits.push_back(place);
}

GltfVertices VertexFinder::vertices_of(const GltfObject& attributes, const Affine& transform) {
  constexpr const char* kNames[] = {"POSITION", "NORMAL", "TANGENT"};
  GltfVertices v;
  for (std::size_t i = 0; i < 3; ++i) v.numbers[i] = attributes.has(kNames[i]) ? attributes.number(kNames[i]) + 1 : 0;
  v.position = floats(v.numbers[0] - 1, 3);
  if (v.numbers[1] > 0) v.normal = floats(v.numbers[1] - 1, 3);
  if (v.numbers[2] > 0) v.tangent = floats(v.numbers[2] - 1, 4);
  if ((v.normal && v.normal->count != v.position.count) || (v.tangent && v.tangent->count != v.position.count))
    attributes.broken("have different counts");
  v.to_world = transform;
  const std::optional<Affine> inverse = inverse_of(transform);
  if (!inverse) attributes.broken("stand in a node that flattens them");
  v.from_world = *inverse;
  return v;
}

/// Refuses numbers that two accessors share, since they would be written twice. Interleaved accessors may lie side by
/// side.
void VertexFinder::check_shared_bytes() const {
  struct Range {
    std::uint64_t begin, end, stride, size;
  };
  std::vector<Range> ranges;
  const auto add = [&](const Accessor& a) {
    const std::uint64_t size = 4 * a.components;
    if (a.count > 0) ranges.push_back({a.address, a.address + (a.count - 1) * a.stride + size, a.stride, size});
  };
  for (const GltfVertices& v : plan_.vertices) {
    if (v.is_copy) continue;
    add(v.position);
    if (v.normal) add(*v.normal);
    if (v.tangent) add(*v.tangent);
  }
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.begin < b.begin; });
  std::vector<Range> open;
  for (const Range& r : ranges) {
    std::erase_if(open, [&](const Range& o) { return o.end <= r.begin; });
    for (const Range& o : open) {
      const std::uint64_t step = (r.begin - o.begin) % std::max<std::uint64_t>(o.stride, 1);
      if (o.stride != r.stride || step < o.size || step + r.size > o.stride)
        root_.broken("has accessors of vertices that share bytes");
    }
    open.push_back(r);
  }
}

}  // namespace

std::uint64_t GltfPlan::memory_bytes() const {
  return vertices.size() * (kPlaceBytes - sizeof(GltfEdit)) + edits.size() * sizeof(GltfEdit);
}

GltfPlan plan_of_vertices(GltfDocument& doc, const std::string& name, const SceneOptions& options) {
  return VertexFinder(doc, name, options).find();
}

}  // namespace bp::detail
