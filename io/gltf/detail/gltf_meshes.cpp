#include "io/gltf/detail/gltf_meshes.h"

#include "io/gltf/detail/told_bounds.h"
#include "io/gltf/gltf_nodes.h"

namespace bp {

bool name_fits(const PartFilter& parts, const GltfObject& named) {
  return named.has("name") && parts.fits(named.text("name"));
}

const GltfSkin& GltfMeshes::skin(std::uint64_t i) {
  const auto known = skins_.find(i);
  if (known != skins_.end()) return known->second;
  return skins_.emplace(i, GltfSkin(doc_, root_.item("skins", i), places_)).first->second;
}

GltfMeshes::Range GltfMeshes::add(std::uint64_t i, bool wanted, const MeshMotion& motion) {
  const std::tuple key{i, wanted, motion};
  const auto known = meshes_.find(key);
  if (known != meshes_.end()) return known->second;
  const GltfObject mesh = root_.item("meshes", i);
  wanted = name_fits(parts_, mesh) || wanted;
  Range range{std::uint32_t(scene_.primitives.size()), 0};
  bool posed = motion.skin != MeshMotion::kNoSkin;
  for (std::size_t k = 0; k < mesh.array("primitives").size(); ++k) {
    const GltfObject primitive = mesh.item("primitives", k);
    posed = posed || !primitive.array("targets").empty();
    const bool fits =
        primitive.has("material") && name_fits(parts_, root_.item("materials", primitive.number("material")));
    if (fits || wanted) add_primitive(primitive, motion);
  }
  range.end = std::uint32_t(scene_.primitives.size());
  scene_.posed += posed && range.first < range.end ? 1 : 0;
  meshes_.emplace(key, range);
  return range;
}

void GltfMeshes::add_primitive(const GltfObject& p, const MeshMotion& motion) {
  constexpr std::uint64_t kTriangles = 4, kStrip = 5, kFan = 6;
  const std::uint64_t mode = p.number("mode", kTriangles);
  if (mode > kFan) p.broken(fmt::format("has the unknown mode {}", mode));
  const GltfObject attributes = p.object("attributes");
  if (!attributes.has("POSITION")) return;
  if (mode == 0) scene_.points += root_.item("accessors", attributes.number("POSITION")).number("count", 0);
  if (mode > 0 && mode < kTriangles) ++scene_.lines;
  if (mode < kTriangles) return;  // points and lines
  if (options_.walls_only && p.has("material") && materials_.see_through(p.number("material"))) return;
  Primitive primitive;
  const bool plain = doc_.unpack(p);  // true if it was packed: its triangles form no strip then
  primitive.mode = plain            ? Primitive::Mode::triangles
                   : mode == kFan   ? Primitive::Mode::fan
                   : mode == kStrip ? Primitive::Mode::strip
                                    : Primitive::Mode::triangles;
  add_positions(p, motion, plain, primitive);
  if (p.has("indices")) add_indices(p, primitive);
  if (options_.colors) add_colors(p, attributes, primitive);
  if (options_.textures != nullptr && p.has("material")) try_texture(p.number("material"), attributes, primitive);
  if (options_.surface && attributes.has("NORMAL")) add_normals(p, motion, primitive);
  scene_.primitives.push_back(primitive);
}

/// Adds the positions, and the bounds that the file tells of them. A pose may move them out of these bounds, which are
/// then those of the positions before.
void GltfMeshes::add_positions(const GltfObject& p, const MeshMotion& motion, bool packed, Primitive& primitive) {
  const GltfObject attributes = p.object("attributes");
  const std::uint64_t number = attributes.number("POSITION");
  primitive.positions = doc_.accessor(number, 3);
  primitive.told = told_bounds(root_.item("accessors", number), primitive.positions, packed);
  primitive.moved = !motion.weights.empty() || motion.skin != MeshMotion::kNoSkin;
  const bool lies = !primitive.told || (primitive.moved && !lies_in(doc_, primitive.positions, *primitive.told));
  scene_.unfollowed.culled += lies ? 1 : 0;
  primitive.positions = doc_.morphed(p, "POSITION", primitive.positions, motion.weights);
  if (motion.skin == MeshMotion::kNoSkin) return;
  if (!skin(motion.skin).are_whole(attributes, primitive.positions.count)) ++scene_.unfollowed.skins;
  primitive.positions = skin(motion.skin).points(attributes, primitive.positions);
}

void GltfMeshes::add_normals(const GltfObject& p, const MeshMotion& motion, Primitive& primitive) {
  const GltfObject attributes = p.object("attributes");
  const Accessor normals = doc_.accessor(attributes.number("NORMAL"), 3);
  if (normals.count != primitive.positions.count) return;
  primitive.normals = doc_.morphed(p, "NORMAL", normals, motion.weights);
  if (motion.skin != MeshMotion::kNoSkin) primitive.normals = skin(motion.skin).normals(attributes, *primitive.normals);
}

// Adds the colours of vertices, in linear light, which the factor multiplies (section 3.9.2).
void GltfMeshes::add_colors(const GltfObject& p, const GltfObject& attributes, Primitive& primitive) {
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
void GltfMeshes::try_texture(std::uint64_t material, const GltfObject& attributes, Primitive& primitive) {
  try {
    materials_.add_texture(material, attributes, primitive);
  } catch (const Error& e) {
    if (e.code() != ErrorCode::bad_input) throw;
    primitive.uv.reset();
    primitive.has_image = false;
    primitive.material = TriangleTexture::kNoMaterial;
    options_.textures->add_fault(std::string(e.what()) + "; its material's colour is used");
  }
}

void GltfMeshes::add_indices(const GltfObject& p, Primitive& primitive) {
  primitive.indices = doc_.accessor(p.number("indices"), 1);
  const ComponentType type = primitive.indices->type;
  if (type != ComponentType::u8 && type != ComponentType::u16 && type != ComponentType::u32)
    p.broken("has indices that are not unsigned integers");
}

}  // namespace bp
