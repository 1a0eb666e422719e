#include "io/mesh/lod_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "io/mesh/detail/glb_leaf.h"
#include "io/mesh/detail/gltf_place.h"
#include "io/mesh/detail/mesh_writers.h"
#include "lib/atlas/tangents.h"
#include "lib/core/error.h"
#include "lib/core/vec3.h"
#include "lib/mesh/shaded_mesh.h"

namespace bp {

namespace {

using Json = GltfOutJson;

constexpr std::int64_t kShortInteger = 32767;

/// Converts a tile's vertices to lattice steps from its origin, turned to y up.
class TilePlace {
 public:
  TilePlace(const LatticeMesh& mesh, LatticeCoord origin) : turn_(to_y_up(mesh.frame.up)), origin_(origin) {
    for (const LatticeCoord v : mesh.vertices) {
      for (int i = 0; i < 3; ++i) reach_ = std::max(reach_, std::abs(v[i] - origin[i]));
    }
  }
  [[nodiscard]] std::int64_t reach() const { return reach_; }
  template <class Number>
  [[nodiscard]] std::array<Number, 3> at(LatticeCoord v) const {
    const LatticeCoord d = turn_(v - origin_);
    return {Number(d.x), Number(d.y), Number(d.z)};
  }

 private:
  const AxisTurn turn_;
  const LatticeCoord origin_;
  std::int64_t reach_ = 0;
};

/// The numbers of POSITION, with their bounds. at(v): the position of vertex v.
template <class Number>
struct Positions {
  std::string bytes;
  std::array<Number, 3> min, max;

  template <class At>
  Positions(const LatticeMesh& mesh, const std::vector<std::uint32_t>& order, std::size_t stride, const At& at) {
    min.fill(std::numeric_limits<Number>::max());
    max.fill(std::numeric_limits<Number>::lowest());
    bytes.reserve(order.size() * stride);
    for (const std::uint32_t i : order) {
      const std::array<Number, 3> p = at(mesh.vertices[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        min[k] = std::min(min[k], p[k]);
        max[k] = std::max(max[k], p[k]);
      }
      bytes.append(reinterpret_cast<const char*>(p.data()), sizeof p);
      bytes.resize((bytes.size() + stride - 1) / stride * stride, '\0');
    }
  }
};

/// Returns the normals of the copies in `order`.
std::vector<std::array<float, 3>> normals_of(const ShadedMesh& mesh, const std::vector<std::uint32_t>& order,
                                             UpAxis up) {
  std::vector<std::array<float, 3>> normals;
  normals.reserve(order.size());
  for (const std::uint32_t i : order) normals.push_back(to_y_up(up)(mesh.normals[i]));
  return normals;
}

/// Returns the vectors of the copies in `order`.
std::vector<std::array<float, 4>> in_order(const std::vector<std::array<float, 4>>& all,
                                           const std::vector<std::uint32_t>& order, UpAxis up) {
  std::vector<std::array<float, 4>> tangents;
  tangents.reserve(order.size());
  for (const std::uint32_t i : order) {
    const std::array<float, 3> t = to_y_up(up)(std::array<float, 3>{all[i][0], all[i][1], all[i][2]});
    tangents.push_back({t[0], t[1], t[2], all[i][3]});
  }
  return tangents;
}

std::string color_bytes(const ShadedMesh& mesh, const std::vector<std::uint32_t>& order) {
  std::string bytes;
  bytes.reserve(4 * order.size());
  for (const std::uint32_t i : order) {
    for (const std::uint8_t c : linear_bytes(mesh.colors[i])) bytes.push_back(char(c));
    bytes.push_back(char(255));
  }
  return bytes;
}

void check_mesh(const NamedMesh& named) {
  if (named.mesh->triangles.empty()) fail(ErrorCode::bad_argument, "{}: the mesh has no triangle", named.name);
}

template <class Number>
Json positions_accessor(const Positions<Number>& p, std::size_t count) {
  return {{"count", count}, {"type", "VEC3"}, {"min", p.min}, {"max", p.max}};
}

/// Adds positions. at(v): the float32 numbers of vertex v.
template <class At>
std::size_t add_positions(GlbData& data, const LatticeMesh& mesh, const std::vector<std::uint32_t>& order,
                          const At& at) {
  const Positions<float> p(mesh, order, 12, at);
  return data.add_floats(p.bytes, 12, positions_accessor(p, order.size()));
}

std::size_t add_tile_positions(GlbData& data, const LatticeMesh& mesh, const std::vector<std::uint32_t>& order,
                               const TilePlace& place) {
  if (!data.is_compressed() || place.reach() > kShortInteger) {
    return add_positions(data, mesh, order, [&](LatticeCoord v) { return place.at<float>(v); });
  }
  data.quantize();
  const Positions<std::int16_t> p(mesh, order, 8, [&](LatticeCoord v) { return place.at<std::int16_t>(v); });
  Json accessor = positions_accessor(p, order.size());
  accessor["componentType"] = kGltfShort;
  return data.add_attributes(p.bytes, 8, std::move(accessor));
}

/// Returns the texture coordinates of the copies in `order`. If `compressed`: 16-bit integers for [0, 1], a
/// 16th of a texel.
std::string uv_bytes(const ShadedMesh& mesh, const std::vector<std::uint32_t>& order, bool compressed) {
  std::string bytes;
  if (mesh.uv.empty()) return bytes;
  for (const std::uint32_t i : order) {
    for (const float x : mesh.uv[i]) {
      const auto integer = std::uint16_t(std::clamp(x, 0.0F, 1.0F) * 65535 + 0.5F);
      compressed ? bytes.append(reinterpret_cast<const char*>(&integer), sizeof integer)
                 : bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
    }
  }
  return bytes;
}

/// Returns what is subtracted from the triangles of a leaf in addition to the origin: 0 unless they lie far from it.
Vec3d offset_of(const SceneLeaf& leaf, const Vec3d& origin) {
  constexpr double kSizes = 8;  // so far from the origin float32 still has steps of a 2,000,000th of the scene
  const Vec3d low = leaf.bounds.min - origin, high = leaf.bounds.max - origin;
  double farthest = 0;
  for (std::size_t i = 0; i < 3; ++i) farthest = std::max({farthest, std::abs(low[i]), std::abs(high[i])});
  if (farthest <= kSizes * leaf.bounds.longest_side()) return {};
  int exponent = 0;
  (void)std::frexp(leaf.bounds.longest_side(), &exponent);
  const double step = std::ldexp(1.0, exponent);  // a point of few bits
  Vec3d offset;
  for (std::size_t i = 0; i < 3; ++i) offset[i] = std::nearbyint((low[i] + high[i]) / 2 / step) * step;
  return offset;
}

/// Returns the power of two that positions of a compressed level from the scene are multiples of: a 524,288th of the
/// level's longest side, or up to twice as fine.
double step_of(const SceneLeaf& leaf) {
  int exponent = 0;
  (void)std::frexp(leaf.bounds.longest_side(), &exponent);
  return std::ldexp(1.0, exponent - 20);
}

class GlbBuilder {
 public:
  /// `origin`: is subtracted from all coordinates, and noted in the file. Throws if the subtraction rounds.
  explicit GlbBuilder(const std::string& file, Compression compression, const Vec3d& origin = {})
      : file_(file), data_(compression == Compression::meshopt), looks_(data_), origin_(origin) {}

  /// Adds mesh and node; returns the node's number. `offset`: gltf_offset() of all meshes of the file.
  std::size_t add(const NamedMesh& named, const std::optional<Vec3d>& offset) {
    check_mesh(named);
    const LatticeMesh& mesh = *named.mesh;
    const GltfPlace place(mesh, origin_, offset, file_);
    add_mesh(named, [&](const auto& order) { return add_positions(data_, mesh, order, place); });
    Json node = node_of(named);
    place.place(node);
    json()["nodes"].push_back(std::move(node));
    return json()["nodes"].size() - 1;
  }

  /// Adds the mesh of a tile: quantized where 16 bits suffice; its node has a scale only.
  void add_tile(const NamedMesh& named, LatticeCoord origin) {
    check_mesh(named);
    const LatticeMesh& mesh = *named.mesh;
    const TilePlace place(mesh, origin);
    if (place.reach() > kFloatInteger) {
      fail(ErrorCode::bad_argument, {Remedy::larger_voxels},
           "{}: a level reaches {} voxels from its origin, and glTF's 32-bit floats hold 2^18 of them exactly", file_,
           place.reach() / kLatticePerVoxel);
    }
    add_mesh(named, [&](const auto& order) { return add_tile_positions(data_, mesh, order, place); });
    const double step = mesh.frame.voxel / kLatticePerVoxel;
    json()["nodes"].push_back(node_of(named));
    json()["nodes"].back()["scale"] = Json::array({step, step, step});
  }

  Json& node(std::size_t i) { return json()["nodes"][i]; }
  void use(const char* extension) { data_.use(extension, false); }

  /// Adds triangles of the scene, less the origin and, far from it, a point near them, which is the node's translation.
  std::size_t add_scene(const NamedMesh& named, const LeafLooks& looks, UpAxis up) {
    const SceneLeaf& leaf = *named.scene;
    const Vec3d offset = offset_of(leaf, origin_);
    const double step = data_.is_compressed() ? step_of(leaf) : 0;
    const auto place = [&](const std::array<std::int32_t, 3>& at) {
      GlbLeaves::Position p;
      for (std::size_t i = 0; i < 3; ++i) {
        const double x = leaf.origin[i] + leaf.unit * at[i] - origin_[i] - offset[i];
        p[i] = float(step > 0 ? std::nearbyint(x / step) * step : x);
      }
      return p;
    };
    if (!leaves_) leaves_.emplace(data_, looks_, looks, up);  // levels share their images
    Json primitives = leaves_->primitives(leaf, place);
    json()["meshes"].push_back({{"name", named.name}, {"primitives", std::move(primitives)}});
    Json node = node_of(named);
    if (offset != Vec3d{}) node["translation"] = to_y_up(up)(offset);
    json()["nodes"].push_back(std::move(node));
    return json()["nodes"].size() - 1;
  }

  void write(const LatticeMesh& first, const std::vector<std::size_t>& roots, const std::string& contract,
             OutputFile& out) {
    write_glb(document(gltf_asset("bplod", first.provenance, first.frame.up, origin_, contract), roots), data_.bytes(),
              out);
  }
  /// Returns the content of a tile. Its extras.up does not ask readers of this suite to turn back to the axes of the
  /// scene.
  [[nodiscard]] std::string tile_bytes(const LatticeMesh& mesh, const Vec3d& tile_origin, Contract contract) {
    Json asset = gltf_asset("bplod", mesh.provenance, UpAxis::y, {}, name_of(contract));
    asset["extras"]["tile_origin"] = tile_origin;
    return glb_head(document(std::move(asset), {0}), data_.bytes().size(), file_) + data_.bytes();
  }

 private:
  Json& json() { return data_.json(); }
  std::string document(Json asset, const std::vector<std::size_t>& roots) {
    looks_.write();
    return data_.document(std::move(asset), roots);
  }

  /// Adds a mesh. add_positions(order): adds the accessor of the vertices in this order, and returns its number.
  template <class AddPositions>
  void add_mesh(const NamedMesh& named, const AddPositions& add_positions) {
    const LatticeMesh& mesh = *named.mesh;
    ShadedMesh drawn = shaded(mesh);
    std::vector<std::array<float, 4>> tangents;
    if (mesh.texture && mesh.texture->normal.is_there()) tangents = tangents_of(mesh, drawn);
    std::vector<std::uint32_t> order = optimize_order(drawn.triangles, drawn.vertex.size());
    const std::vector<std::array<float, 3>> normals = normals_of(drawn, order, mesh.frame.up);
    const std::string uv = uv_bytes(drawn, order, data_.is_compressed()),
                      colors = mesh.colors.empty() ? "" : color_bytes(drawn, order);
    if (!tangents.empty()) tangents = in_order(tangents, order, mesh.frame.up);
    for (std::uint32_t& i : order) i = drawn.vertex[i];
    Json attributes{{"POSITION", add_positions(order)}, {"NORMAL", data_.add_normals(normals)}};
    if (!mesh.colors.empty()) attributes["COLOR_0"] = add_colors(colors);
    if (mesh.texture) attributes["TEXCOORD_0"] = add_uv(uv, order.size());
    if (!tangents.empty()) attributes["TANGENT"] = data_.add_tangents(tangents);
    const std::size_t indices = data_.add_indices(drawn.triangles, order.size());
    const Json primitive{{"attributes", attributes}, {"indices", indices}, {"material", add_material(mesh)}};
    json()["meshes"].push_back({{"name", named.name}, {"primitives", Json::array({primitive})}});
  }

  std::size_t add_colors(const std::string& bytes) {
    return data_.add_attributes(
        bytes, 4, {{"componentType", kGltfUint8}, {"normalized", true}, {"count", bytes.size() / 4}, {"type", "VEC4"}});
  }

  std::size_t add_uv(const std::string& bytes, std::size_t count) {
    Json accessor{
        {"componentType", data_.is_compressed() ? kGltfUint16 : kGltfFloat}, {"count", count}, {"type", "VEC2"}};
    if (data_.is_compressed()) accessor["normalized"] = true;
    return data_.add_attributes(bytes, data_.is_compressed() ? 4 : 8, std::move(accessor));
  }

  /// Adds a material; returns its number.
  std::size_t add_material(const LatticeMesh& mesh) {
    if (!mesh.texture) {
      if (!plain_material_) plain_material_ = looks_.add_material(gltf_material(!mesh.colors.empty()));
      return *plain_material_;
    }
    const MeshTexture& own = *mesh.texture;
    const GltfTextures textures{add_texture(own.image, own.type),
                                add_texture(own.normal.bytes, own.normal.type),
                                add_texture(own.roughness.bytes, own.roughness.type),
                                add_texture(own.emission.bytes, own.emission.type),
                                own.roughness_factor,
                                own.metal_factor};
    return looks_.add_material(gltf_textured_material(textures, own.has_holes));
  }

  /// Adds a texture; returns its number; none without an image.
  std::optional<std::size_t> add_texture(const std::string& image, const std::string& type) {
    if (image.empty()) return {};
    return looks_.add_texture(looks_.add_image(image, type), {TextureWrap::clamp, TextureWrap::clamp});
  }

  Json node_of(const NamedMesh& named) { return {{"name", named.name}, {"mesh", json()["meshes"].size() - 1}}; }

  const std::string file_;
  GlbData data_;
  GlbLooks looks_;
  std::optional<GlbLeaves> leaves_;
  const Vec3d origin_;
  std::optional<std::size_t> plain_material_;
};

/// Returns the offset for all meshes of a file, which stand together.
std::optional<Vec3d> offset_of(std::span<const NamedMesh> all, const Vec3d& origin) {
  std::vector<const LatticeMesh*> meshes;
  for (const NamedMesh& named : all) {
    if (named.scene == nullptr && !named.mesh->vertices.empty()) meshes.push_back(named.mesh);
  }
  return gltf_offset(meshes, origin);
}

}  // namespace

void write_lod_glb(std::span<const NamedMesh> levels, std::span<const double> coverage, OutputFile& out,
                   const MeshWriteOptions& options, const LeafLooks& looks) {
  GlbBuilder builder(out.name(), looks.compression, options.origin);
  const std::optional<Vec3d> offset = offset_of(levels, options.origin);
  const auto add = [&](const NamedMesh& level) {
    return level.scene != nullptr ? builder.add_scene(level, looks, level.mesh->frame.up) : builder.add(level, offset);
  };
  (void)add(levels.front());
  std::vector<std::size_t> coarser;
  for (const NamedMesh& level : levels.subspan(1)) coarser.push_back(add(level));
  if (!coarser.empty()) {
    builder.use("MSFT_lod");
    builder.node(0)["extensions"] = {{"MSFT_lod", {{"ids", coarser}}}};
    builder.node(0)["extras"] = {{"MSFT_screencoverage", std::vector<double>(coverage.begin(), coverage.end())}};
  }
  builder.write(*levels.front().mesh, {0}, contract_name(options), out);
}

void write_parts_glb(std::span<const NamedMesh> parts, OutputFile& out, const MeshWriteOptions& options) {
  GlbBuilder builder(out.name(), Compression::none, options.origin);
  const std::optional<Vec3d> offset = offset_of(parts, options.origin);
  std::vector<std::size_t> roots;
  for (const NamedMesh& part : parts) roots.push_back(builder.add(part, offset));
  builder.write(*parts.front().mesh, roots, contract_name(options), out);
}

std::string tile_glb(const NamedMesh& tile, LatticeCoord origin, Compression compression, Contract contract) {
  GlbBuilder builder(tile.name + ".glb", compression);
  builder.add_tile(tile, origin);
  return builder.tile_bytes(*tile.mesh, tile.mesh->frame.world(origin), contract);
}

LatticeCoord lattice_point(const GridFrame& frame, const Vec3d& p) {
  LatticeCoord c;
  for (int i = 0; i < 3; ++i) {
    const auto k = std::size_t(i);
    c[i] = std::int64_t(std::nearbyint(p[k] / (frame.voxel / kLatticePerVoxel))) - frame.origin[k] * kLatticePerVoxel;
  }
  if (frame.world(c) != p) fail(ErrorCode::failed, "({}, {}, {}) is no point of the lattice", p[0], p[1], p[2]);
  return c;
}

double coverage_at_one_pixel(double diameter, double error) {
  constexpr double kWidth = 1920, kHeight = 1080, kPi = 3.14159265358979323846;
  if (!(error > 0)) return 1;
  const double pixels = diameter / error;
  return std::min(1.0, kPi / 4 * pixels * pixels / (kWidth * kHeight));
}

}  // namespace bp
