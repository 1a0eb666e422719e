#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "io/gltf/detail/gltf_copy.h"
#include "io/gltf/gltf_nodes.h"
#include "io/scene/points/scene_points.h"
#include "lib/core/vec3.h"

// glTF and GLB: the accessors POSITION, NORMAL and TANGENT of every mesh that a node shows are written anew, in their
// places, and the bounds of POSITION in the JSON. All must lie in the first buffer. What cannot follow so is refused: a
// mesh that stands in two places, skins, morph targets, positions that are quantized, sparse or compressed.

namespace bp {

namespace {

/// Vertices that share an accessor, and the node that they stand in.
struct Vertices {
  std::uint64_t number = 0;  ///< of the accessor POSITION
  Accessor position;
  std::optional<Accessor> normal, tangent;
  std::array<std::uint64_t, 2> others{};  ///< numbers of these accessors, plus 1; 0: none
  Affine to_world, from_world;
};

Vec3d linear(const Affine& a, const Vec3d& v) {
  return {a.m[0][0] * v[0] + a.m[0][1] * v[1] + a.m[0][2] * v[2],
          a.m[1][0] * v[0] + a.m[1][1] * v[1] + a.m[1][2] * v[2],
          a.m[2][0] * v[0] + a.m[2][1] * v[1] + a.m[2][2] * v[2]};
}

Vec3d transposed(const Affine& a, const Vec3d& v) {
  return {a.m[0][0] * v[0] + a.m[1][0] * v[1] + a.m[2][0] * v[2],
          a.m[0][1] * v[0] + a.m[1][1] * v[1] + a.m[2][1] * v[2],
          a.m[0][2] * v[0] + a.m[1][2] * v[1] + a.m[2][2] * v[2]};
}

/// The linear part alone.
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

Vec3d unit(const Vec3d& v) {
  const double size = length(v);
  return size > 0 ? (1 / size) * v : v;
}

/// Finds all vertices that can move, or says why some cannot.
class VertexFinder {
 public:
  explicit VertexFinder(GltfDocument& doc) : doc_(doc), root_(doc.root()) {}

  std::vector<Vertices> find() {
    for (const std::uint64_t node : gltf_roots(root_)) open_.push_back({node, gltf_world(gltf_up(root_))});
    std::reverse(open_.begin(), open_.end());
    while (!open_.empty()) {
      const Open next = open_.back();
      open_.pop_back();
      if (seen_.insert(next.node).second) add_node(next);
    }
    check_shared_bytes();
    return std::move(found_);
  }

 private:
  struct Open {
    std::uint64_t node;
    Affine parent;
  };
  void add_node(const Open& next);
  void add_primitive(const GltfObject& primitive, const Affine& transform);
  Accessor floats(std::uint64_t number, std::size_t components);
  void check_shared_bytes() const;

  GltfDocument& doc_;
  GltfObject root_;
  std::vector<Open> open_;
  std::set<std::uint64_t> seen_, meshes_;
  std::map<std::uint64_t, std::size_t> known_;
  std::vector<Vertices> found_;
};

/// Coarser levels (MSFT_lod) stand where their node stands.
void VertexFinder::add_node(const Open& next) {
  const GltfObject node = root_.item("nodes", next.node);
  const Affine transform = next.parent * gltf_transform(node);
  for (std::size_t k = node.array("children").size(); k-- > 0;) open_.push_back({node.index("children", k), transform});
  if (node.has("extensions")) {
    const GltfObject extensions = node.object("extensions");
    if (extensions.has("EXT_mesh_gpu_instancing"))
      node.broken("stands in many places, and each would bend another way");
    if (extensions.has("MSFT_lod")) {
      const GltfObject lod = extensions.object("MSFT_lod");
      for (std::size_t k = lod.array("ids").size(); k-- > 0;) open_.push_back({lod.index("ids", k), next.parent});
    }
  }
  if (!node.has("mesh")) return;
  if (node.has("skin")) node.broken("has a skin, whose joints would move it again; export it without");
  const std::uint64_t number = node.number("mesh");
  const GltfObject mesh = root_.item("meshes", number);
  if (!meshes_.insert(number).second) mesh.broken("stands in two places, and each would bend another way; make it two");
  for (std::size_t k = 0; k < mesh.array("primitives").size(); ++k)
    add_primitive(mesh.item("primitives", k), transform);
}

Accessor VertexFinder::floats(std::uint64_t number, std::size_t components) {
  const GltfObject object = root_.item("accessors", number);
  if (object.has("sparse") || !object.has("bufferView")) object.broken("is sparse, and vertices that move must not be");
  const GltfObject view = root_.item("bufferViews", object.number("bufferView"));
  if (view.has("extensions") && view.object("extensions").has("EXT_meshopt_compression"))
    view.broken("is compressed, and vertices that move must not be: unpack it, for instance with gltf-transform");
  if (view.number("buffer") != 0) view.broken("lies in a second buffer; pack all buffers into one");
  const Accessor accessor = doc_.accessor(number, components);
  if (accessor.type != ComponentType::f32)
    object.broken("is quantized, and would be rounded: write floats, for instance with gltf-transform dequantize");
  return accessor;
}

void VertexFinder::add_primitive(const GltfObject& primitive, const Affine& transform) {
  const GltfObject attributes = primitive.object("attributes");
  if (primitive.has("extensions") && primitive.object("extensions").has("KHR_draco_mesh_compression"))
    primitive.broken("is compressed (KHR_draco_mesh_compression): unpack it, for instance with gltf-transform");
  if (!attributes.has("POSITION")) return;
  if (primitive.has("targets")) primitive.broken("has morph targets, which would not fit any more; export it without");
  Vertices v;
  v.number = attributes.number("POSITION");
  v.to_world = transform;
  if (attributes.has("NORMAL")) v.others[0] = attributes.number("NORMAL") + 1;
  if (attributes.has("TANGENT")) v.others[1] = attributes.number("TANGENT") + 1;
  const auto [at, is_new] = known_.try_emplace(v.number, found_.size());
  if (!is_new) {
    const Vertices& known = found_[at->second];
    if (known.others != v.others || known.to_world.m != transform.m)
      primitive.broken("shares its positions with another part, but not their place or their normals");
    return;
  }
  v.position = floats(v.number, 3);
  if (v.others[0] > 0) v.normal = floats(v.others[0] - 1, 3);
  if (v.others[1] > 0) v.tangent = floats(v.others[1] - 1, 4);
  if ((v.normal && v.normal->count != v.position.count) || (v.tangent && v.tangent->count != v.position.count))
    attributes.broken("have different counts");
  const std::optional<Affine> inverse = inverse_of(transform);
  if (!inverse) attributes.broken("stand in a node that flattens them");
  v.from_world = *inverse;
  found_.push_back(std::move(v));
}

/// Numbers that two accessors hold would be written twice. Interleaved ones lie side by side.
void VertexFinder::check_shared_bytes() const {
  struct Range {
    std::uint64_t begin, end, stride, size;
  };
  std::vector<Range> ranges;
  const auto add = [&](const Accessor& a) {
    const std::uint64_t size = 4 * a.components;
    if (a.count > 0) ranges.push_back({a.address, a.address + (a.count - 1) * a.stride + size, a.stride, size});
  };
  for (const Vertices& v : found_) {
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

class GltfPoints final : public ScenePoints {
 public:
  GltfPoints(SceneFilePtr file, const SceneOptions& options)
      : file_(std::move(file)), options_(options), doc_(file_, options_) {
    detail::check_container(*file_);
    vertices_ = VertexFinder(doc_).find();
  }
  bool read(std::vector<Vec3d>& out) override {
    out.clear();
    for (; at_ < vertices_.size(); ++at_, first_ = 0) {
      const Vertices& v = vertices_[at_];
      const auto n = std::size_t(std::min<std::uint64_t>(kBatch, v.position.count - first_));
      if (n == 0) continue;
      take(*doc_.bytes(), v.position, first_, n, out);
      for (Vec3d& p : out) p = v.to_world(p);
      first_ += n;
      return true;
    }
    return false;
  }
  void write(const MovePoints& move, OutputFile& out) override {
    const std::uint64_t bytes = vertices_.empty() ? 0 : doc_.root().item("buffers", 0).number("byteLength");
    detail::GltfCopy copy(file_, *doc_.bytes(), std::min(bytes, doc_.bytes()->size()), options_);
    for (const Vertices& v : vertices_) {
      Bounds3d bounds;
      for (std::uint64_t first = 0; first < v.position.count; first += kBatch)
        write_batch(v, first, std::size_t(std::min<std::uint64_t>(kBatch, v.position.count - first)), move, copy,
                    bounds);
      copy.set_bounds(v.number, bounds);
    }
    copy.write(out);
  }

 private:
  void write_batch(const Vertices& v, std::uint64_t first, std::size_t n, const MovePoints& move,
                   detail::GltfCopy& copy, Bounds3d& bounds);
  /// The first three components; the bytes stay in bytes_.
  template <class File>
  void take(const File& file, const Accessor& a, std::uint64_t first, std::size_t n, std::vector<Vec3d>& out) {
    bytes_.resize((n - 1) * a.stride + 4 * a.components);
    file.read_at(a.address + first * a.stride, std::span(bytes_));
    out.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      std::array<float, 3> values;
      std::memcpy(values.data(), bytes_.data() + i * a.stride, sizeof values);
      out[i] = {values[0], values[1], values[2]};
    }
  }
  /// Of what take() took. Values that stay keep their bytes.
  void put(detail::GltfCopy& copy, const Accessor& a, std::uint64_t first, const std::vector<Vec3d>& values) {
    take(copy, a, first, values.size(), scratch_);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::array<float, 3> now{float(values[i][0]), float(values[i][1]), float(values[i][2])};
      if (values[i] != scratch_[i]) std::memcpy(bytes_.data() + i * a.stride, now.data(), sizeof now);
    }
    copy.write_at(a.address + first * a.stride, bytes_);
  }

  SceneFilePtr file_;
  const SceneOptions options_;
  GltfDocument doc_;
  std::vector<Vertices> vertices_;
  std::size_t at_ = 0;
  std::uint64_t first_ = 0;
  std::vector<std::byte> bytes_;
  std::vector<Vec3d> scratch_;
};

void GltfPoints::write_batch(const Vertices& v, std::uint64_t first, std::size_t n, const MovePoints& move,
                             detail::GltfCopy& copy, Bounds3d& bounds) {
  PointBatch local, world;
  take(copy, v.position, first, n, local.positions);
  for (const Vec3d& p : local.positions) world.positions.push_back(v.to_world(p));
  if (v.normal) take(copy, *v.normal, first, n, local.normals);
  for (const Vec3d& d : local.normals) world.normals.push_back(unit(transposed(v.from_world, d)));
  if (v.tangent) take(copy, *v.tangent, first, n, local.tangents);
  for (const Vec3d& d : local.tangents) world.tangents.push_back(linear(v.to_world, d));
  const PointBatch before = world;
  move(world);
  for (std::size_t i = 0; i < n; ++i) {
    local.positions[i] = local.positions[i] + linear(v.from_world, world.positions[i] - before.positions[i]);
    for (double& c : local.positions[i]) c = double(float(c));
    bounds.add(local.positions[i]);
  }
  for (std::size_t i = 0; i < local.normals.size(); ++i) {
    if (world.normals[i] != before.normals[i]) local.normals[i] = unit(transposed(v.to_world, world.normals[i]));
  }
  for (std::size_t i = 0; i < local.tangents.size(); ++i) {
    if (world.tangents[i] != before.tangents[i]) local.tangents[i] = unit(linear(v.from_world, world.tangents[i]));
  }
  put(copy, v.position, first, local.positions);
  if (v.normal) put(copy, *v.normal, first, local.normals);
  if (v.tangent) put(copy, *v.tangent, first, local.tangents);
}

}  // namespace

std::unique_ptr<ScenePoints> gltf_points(SceneFilePtr file, const SceneOptions& options) {
  return std::make_unique<GltfPoints>(std::move(file), options);
}

}  // namespace bp
