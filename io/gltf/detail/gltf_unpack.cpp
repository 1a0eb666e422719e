#include <algorithm>
#include <cstring>

#include "io/gltf/draco_codec.h"
#include "io/gltf/gltf_document.h"
#include "io/gltf/meshopt_codec.h"

// Reads compressed views and primitives. Unpacked bytes go to a scratch file, so that memory does not grow with them.

namespace bp {

namespace {

MeshoptView meshopt_view(const GltfObject& packed) {
  MeshoptView view;
  view.count = packed.number("count");
  view.stride = packed.number("byteStride");
  const std::string mode = packed.text("mode");
  const std::string filter = packed.has("filter") ? packed.text("filter") : "NONE";
  if (mode != "ATTRIBUTES" && mode != "TRIANGLES" && mode != "INDICES")
    packed.broken(fmt::format("has the unknown mode {}", mode));
  view.mode = mode == "TRIANGLES" ? MeshoptMode::triangles
              : mode == "INDICES" ? MeshoptMode::indices
                                  : MeshoptMode::attributes;
  if (filter == "NONE") return view;
  if (filter != "OCTAHEDRAL" && filter != "QUATERNION" && filter != "EXPONENTIAL")
    packed.broken(fmt::format("has the unknown filter {}", filter));
  view.filter = filter == "OCTAHEDRAL"   ? MeshoptFilter::octahedral
                : filter == "QUATERNION" ? MeshoptFilter::quaternion
                                         : MeshoptFilter::exponential;
  return view;
}

/// Returns the unpacked size of a view in bytes, at most 2^62. Impossible sizes do not overflow here; they are refused
/// later.
std::uint64_t unpacked_bytes(const MeshoptView& view) {
  return std::uint64_t(std::min(0x1p62, double(view.count) * double(view.stride)));
}

constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr int kSets = 8;  // most sets of texture coordinates and of joints

DracoAttribute attribute_of(const GltfObject& accessor, std::uint64_t id) {
  const std::string type = accessor.text("type");
  const auto known = std::find(kVectorTypes.begin(), kVectorTypes.end(), type);
  if (known == kVectorTypes.end()) accessor.broken("has a type that vertices do not have: " + type);
  return {std::uint32_t(id), component_type(accessor), std::size_t(known - kVectorTypes.begin()) + 1, {}};
}

std::vector<std::string> attribute_names() {
  std::vector<std::string> names{"POSITION", "NORMAL", "TANGENT", "COLOR_0"};
  for (int i = 0; i < kSets; ++i) {
    for (const char* const name : {"TEXCOORD_", "JOINTS_", "WEIGHTS_"}) names.push_back(name + std::to_string(i));
  }
  return names;
}

/// The bytes of a view are read in pieces of this size: whole triangles of either type of index.
constexpr std::size_t kPieceBytes = 12 << 12;

std::uint32_t index_at(std::span<const std::byte> bytes, std::size_t size, std::size_t i) {
  std::uint32_t index = 0;
  std::memcpy(&index, bytes.data() + i * size, size);
  return index;
}

/// Returns whether two lists hold the same triangles. Compression may rotate the corners of a triangle.
bool same_triangles(std::span<const std::byte> a, std::span<const std::byte> b, std::size_t size) {
  for (std::size_t i = 0; i + 3 <= a.size() / size; i += 3) {
    const auto turned_by = [&](std::size_t turn) {
      return index_at(a, size, i) == index_at(b, size, i + turn) &&
             index_at(a, size, i + 1) == index_at(b, size, i + (1 + turn) % 3) &&
             index_at(a, size, i + 2) == index_at(b, size, i + (2 + turn) % 3);
    };
    if (!turned_by(0) && !turned_by(1) && !turned_by(2)) return false;
  }
  return true;
}

/// Returns whether `file` holds the unpacked bytes from `address` on. Views with a filter of directions are not
/// compared, since they hold no positions.
bool same_data(const SceneFile& file, std::uint64_t address, const MeshoptView& what,
               std::span<const std::byte> unpacked) {
  if (what.filter == MeshoptFilter::octahedral || what.filter == MeshoptFilter::quaternion) return true;
  const bool triangles = what.mode == MeshoptMode::triangles && (what.stride == 2 || what.stride == 4);
  std::vector<std::byte> piece;
  for (std::size_t at = 0; at < unpacked.size(); at += piece.size()) {
    const std::span<const std::byte> here = unpacked.subspan(at, std::min(kPieceBytes, unpacked.size() - at));
    piece.resize(here.size());
    if (file.read_at(address + at, piece) != piece.size()) return false;
    if (triangles ? !same_triangles(here, piece, what.stride) : !std::equal(here.begin(), here.end(), piece.begin()))
      return false;
  }
  return true;
}

std::vector<std::byte> in_type(const std::vector<std::uint32_t>& indices, ComponentType type) {
  std::vector<std::byte> out(indices.size() * bytes_of(type));
  for (std::size_t i = 0; i < indices.size(); ++i)
    std::copy_n(reinterpret_cast<const std::byte*>(&indices[i]), bytes_of(type), out.data() + i * bytes_of(type));
  return out;
}

/// Throws Unfit for a primitive of Draco that is no list of triangles.
void refuse_strip(const GltfObject& primitive) {
  constexpr std::uint64_t kTriangles = 4;
  if (primitive.number("mode", kTriangles) != kTriangles)
    primitive.unfit("is a strip or a fan that Draco compressed, which programs unpack in different ways");
}

}  // namespace

std::vector<std::byte> GltfDocument::packed_bytes(const View& view) const {
  std::vector<std::byte> bytes(view.size);
  if (bytes_->read_at(view.address, bytes) != view.size)
    fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: ends within compressed data", file_->name());
  return bytes;
}

std::uint64_t GltfDocument::keep(std::span<const std::byte> plain) {
  if (!scratch_) scratch_ = std::make_shared<ScratchFile>(temp_dir_);
  const std::uint64_t begin = scratch_->append(plain);
  return bytes_->add(part_of(view_of(scratch_, file_->name(), begin + plain.size()), begin, plain.size()));
}

Accessor GltfDocument::keep_vectors(const std::vector<double>& numbers, double off) {
  Accessor out;
  out.off = off;
  out.components = 3;
  out.count = numbers.size() / out.components;
  out.type = ComponentType::f64;
  out.stride = out.components * sizeof(double);
  out.address = keep(std::as_bytes(std::span(numbers)));
  return out;
}

bool GltfDocument::requires_one_of(std::span<const char* const> extensions) const {
  const GltfJson& all = root().array("extensionsRequired");
  return std::any_of(all.begin(), all.end(), [&](const GltfJson& name) {
    return name.is_string() &&
           std::find(extensions.begin(), extensions.end(), name.get<std::string>()) != extensions.end();
  });
}

/// Returns view i as a reader without the extension sees it; none if it holds no data, as a placeholder.
std::optional<GltfDocument::View> GltfDocument::plain_view(std::uint64_t i) {
  const GltfObject object = root().item("bufferViews", i);
  const std::uint64_t number = object.number("buffer");
  if (!root().item("buffers", number).has("uri") && (number != 0 || !glb_data_)) return {};
  try {
    return part_of_buffer(object);
  } catch (const Error& e) {
    if (e.code() != ErrorCode::bad_input) throw;
    return {};
  }
}

GltfDocument::View GltfDocument::unpacked(std::uint64_t i, const GltfObject& packed) {
  const auto known = unpacked_.find(i);
  if (known != unpacked_.end()) return known->second;
  const MeshoptView what = meshopt_view(packed);
  const View bytes = part_of_buffer(packed);
  check_document(options_, file_->name(), "a view that is compressed", bytes.size + unpacked_bytes(what),
                 options_.document.bytes);
  std::vector<std::byte> plain;
  const std::string wrong = decode_meshopt(what, packed_bytes(bytes), plain);
  if (!wrong.empty()) packed.broken("holds data that " + wrong);
  if (!requires_one_of(kMeshoptNames)) {
    const std::optional<View> own = plain_view(i);
    const bool same = !own || (own->size >= plain.size() && (own->stride == 0 || own->stride == what.stride) &&
                               same_data(*bytes_, own->address, what, plain));
    if (!same) ++differing_;
  }
  const View view{keep(plain), plain.size(), root().item("bufferViews", i).number("byteStride", 0), what.stride};
  unpacked_.emplace(i, view);
  return view;
}

void GltfDocument::note_use(const GltfObject& primitive, std::uint64_t accessor, std::uint64_t packed_in) {
  const auto [use, is_first] = packed_in_.emplace(accessor, packed_in);
  if (!is_first && use->second != packed_in)
    primitive.unfit(
        fmt::format("shares accessors[{}] with a primitive whose data are compressed in another place", accessor));
}

void GltfDocument::note_plain_use(const GltfObject& primitive) {
  const GltfObject attributes = primitive.object("attributes");
  if (primitive.has("indices")) note_use(primitive, primitive.number("indices"), kNotPacked);
  for (const std::string& name : attribute_names()) {
    if (attributes.has(name.c_str())) note_use(primitive, attributes.number(name.c_str()), kNotPacked);
  }
}

bool GltfDocument::unpack(const GltfObject& primitive) {
  const GltfObject attributes = primitive.object("attributes");
  if (!primitive.has_extension(kDraco)) {
    note_plain_use(primitive);
    return false;
  }
  const GltfObject packed = primitive.object("extensions").object(kDraco), ids = packed.object("attributes");
  refuse_strip(primitive);
  const std::uint64_t numbers = primitive.number("indices"), packed_in = packed.number("bufferView");
  note_use(primitive, numbers, packed_in);
  const GltfObject indices = root().item("accessors", numbers);
  const std::uint64_t triangles = indices.number("count") / 3;
  const View bytes = view(packed_in);
  check_document(options_, file_->name(), "a primitive that is compressed",
                 bytes.size + std::min(triangles, std::uint64_t(1) << 50) * kDracoBytesPerTriangle,
                 options_.document.bytes);
  std::vector<DracoAttribute> values;
  std::vector<std::uint64_t> accessors;
  const bool known = unpacked_numbers_.contains(numbers);
  for (const std::string& name : attribute_names()) {
    if (!ids.has(name.c_str()) || !attributes.has(name.c_str())) continue;
    accessors.push_back(attributes.number(name.c_str()));
    note_use(primitive, accessors.back(), packed_in);
    if (unpacked_numbers_.contains(accessors.back()) != known)
      packed.broken("shares some of its accessors with another primitive, and not all");
    values.push_back(attribute_of(root().item("accessors", accessors.back()), ids.number(name.c_str())));
  }
  if (known) return true;
  if (!requires_one_of(std::array{kDraco}) && indices.has("bufferView")) ++differing_;
  DracoMesh mesh;
  const std::string wrong = decode_draco(packed_bytes(bytes), triangles, mesh, values);
  if (!wrong.empty()) packed.broken("holds data that " + wrong);
  const ComponentType type = component_type(indices);
  if (type != ComponentType::u32 && mesh.vertices > std::uint64_t(1) << (8 * bytes_of(type)))
    indices.broken(fmt::format("cannot number {} vertices", mesh.vertices));
  for (std::size_t k = 0; k < values.size(); ++k)
    unpacked_numbers_[accessors[k]] = {keep(values[k].values), mesh.vertices};
  unpacked_numbers_[numbers] = {keep(in_type(mesh.indices, type)), mesh.indices.size()};
  return true;
}

/// Throws bad_input unless the numbers rise and stay below the accessor's count (glTF 2.0, section 3.6.2.3): readers
/// differ on files that break this rule.
void GltfDocument::check_sparse_numbers(const GltfObject& numbers, const Accessor& a) const {
  constexpr std::uint64_t kAtOnce = 4096;
  const std::size_t size = bytes_of(a.number_type);
  if (a.number_type != ComponentType::u8 && a.number_type != ComponentType::u16 && a.number_type != ComponentType::u32)
    numbers.broken("are not unsigned integers");
  std::vector<std::byte> some(kAtOnce * size);
  std::uint64_t least = 0;
  for (std::uint64_t first = 0; first < a.replaced_count; first += kAtOnce) {
    const std::uint64_t n = std::min(kAtOnce, a.replaced_count - first);
    bytes_->read_at(a.replaced_numbers + first * size, std::span(some).first(n * size));
    for (std::uint64_t k = 0; k < n; ++k) {
      std::uint64_t number = 0;
      std::memcpy(&number, some.data() + k * size, size);
      if (number < least || number >= a.count)
        numbers.broken(fmt::format("hold {} where numbers from {} to {} must rise", number, least, a.count));
      least = number + 1;
    }
  }
}

}  // namespace bp
