#include "io/gltf/gltf_document.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "io/files/uri.h"
#include "io/gltf/detail/data_uri.h"
#include "io/gltf/json_fault.h"
#include "io/gltf/json_text.h"

namespace bp {

namespace {

constexpr std::uint64_t kMaxNumber = std::uint64_t(1) << 53;

std::uint32_t word_at(const SceneFile& file, std::uint64_t offset) {
  std::uint32_t word = 0;
  if (file.read_at(offset, std::as_writable_bytes(std::span(&word, 1))) != sizeof word)
    fail(ErrorCode::bad_input, "{}: ends in the header at byte {}; the file is truncated", file.name(), file.size());
  return word;
}

std::uint64_t bytes_made(std::string_view text, const MadeOfJson& made) {
  std::uint64_t count = 0;
  if (made.word.empty()) return 0;
  for (std::size_t at = 0; (at = text.find(made.word, at)) != std::string_view::npos; at += made.word.size()) ++count;
  return count * made.bytes;
}

/// Returns about how many bytes the InstancedScene of a glTF takes, rather too many.
std::uint64_t description_bytes(std::string_view text) {
  return bytes_made(text, {"\"mesh\"", sizeof(MeshNode)}) + bytes_made(text, {"\"attributes\"", sizeof(Primitive)}) +
         bytes_made(text, {"\"EXT_mesh_gpu_instancing\"", sizeof(InstanceArray)});
}

CountedJson parsed(const std::string& text, const std::string& name, const SceneOptions& options, std::uint64_t held,
                   const MadeOfJson& made = {}, const MadeOfJson& later = {}) {
  const std::uint64_t bytes = bytes_to_parse(text), all = options.document.bytes;
  check_document(options, name, "its JSON", text.size() + bytes + bytes_made(text, made), all - std::min(all, held),
                 bytes_made(text, later));
  if (text.empty()) fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: is empty", name);
  try {
    return {parse_json(text, name), bytes};
  } catch (const GltfJson::exception& e) {
    fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: broken JSON: {}", name, detail::json_fault(e));
  }
}

}  // namespace

CountedJson read_json(const SceneFilePtr& file, const SceneOptions& options, std::uint64_t held, const MadeOfJson& made,
                      const MadeOfJson& later) {
  return parsed(read_lean_json(file, 0, file->size(), temp_dir_of(options), false).text, file->name(), options, held,
                made, later);
}

ComponentType component_type(const GltfObject& o) {
  const std::uint64_t type = o.number("componentType");
  if (type < 5120 || (type > 5126 && type != 5130) || type == 5124)
    o.broken(fmt::format("has the unknown componentType {}", type));
  return ComponentType(type);
}

// --- GltfObject
// --------------------------------------------------------------------------------------------------------

void GltfObject::unfit(const std::string& what) const {
  throw Unfit(fmt::format("{}: {} {}", file_, place_.empty() ? "the document" : place_, what));
}

void GltfObject::broken(const std::string& what) const {
  fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: {} {}", file_, place_.empty() ? "the document" : place_, what);
}

const GltfJson& GltfObject::at(const char* key) const {
  const auto found = json_->find(key);
  if (found == json_->end()) broken(fmt::format("has no '{}'", key));
  return *found;
}

std::uint64_t GltfObject::number(const char* key) const {
  const GltfJson& value = at(key);
  const double number = value.is_number() ? value.get<double>() : -1;
  if (!(number >= 0 && number <= double(kMaxNumber)) || number != std::floor(number))
    broken(fmt::format("has a '{}' that is not a whole number", key));
  return std::uint64_t(number);
}

std::uint64_t GltfObject::number(const char* key, std::uint64_t otherwise) const {
  return has(key) ? number(key) : otherwise;
}

double GltfObject::real(const char* key) const {
  const GltfJson& value = at(key);
  if (!value.is_number()) broken(fmt::format("has a '{}' that is not a number", key));
  return value.get<double>();
}

bool GltfObject::holds_text(const char* key, const char* inner_key, const char* value) const {
  const auto found = json_->find(key);
  if (found == json_->end() || !found->is_object()) return false;
  const auto inner = found->find(inner_key);
  return inner != found->end() && inner->is_string() && inner->get<std::string>() == value;
}

std::string GltfObject::text(const char* key) const {
  const GltfJson& value = at(key);
  if (!value.is_string()) broken(fmt::format("has a '{}' that is not a text", key));
  return value.get<std::string>();
}

bool GltfObject::flag(const char* key) const {
  if (!has(key)) return false;
  if (!at(key).is_boolean()) broken(fmt::format("has a '{}' that is neither true nor false", key));
  return at(key).get<bool>();
}

GltfObject GltfObject::object(const char* key) const {
  return GltfObject(at(key), file_, place_.empty() ? key : place_ + "." + key);
}

const GltfJson& GltfObject::array(const char* key) const {
  static const GltfJson kEmpty = GltfJson::array();
  if (!has(key)) return kEmpty;
  if (!at(key).is_array()) broken(fmt::format("has a '{}' that is not an array", key));
  return at(key);
}

GltfObject GltfObject::item(const char* key, std::uint64_t i) const {
  const GltfJson& items = array(key);
  if (i >= items.size()) broken(fmt::format("names {}[{}], but has {} of them", key, i, items.size()));
  return GltfObject(items[std::size_t(i)], file_, fmt::format("{}{}{}[{}]", place_, place_.empty() ? "" : ".", key, i));
}

std::uint64_t GltfObject::index(const char* key, std::uint64_t i) const {
  const GltfJson& value = array(key)[std::size_t(i)];
  if (!value.is_number_unsigned()) broken(fmt::format("'{}' holds something else than indices", key));
  return value.get<std::uint64_t>();
}

// --- GltfDocument: the container
// ---------------------------------------------------------------------------------------

GltfDocument::GltfDocument(const SceneFilePtr& file, const SceneOptions& options)
    : file_(file), options_(options), temp_dir_(temp_dir_of(options)) {
  char magic[4] = {};
  file->read_at(0, std::as_writable_bytes(std::span(magic)));
  if (std::memcmp(magic, "glTF", 4) == 0) {
    open_glb();
  } else {
    parse(0, file->size());
  }
  check_root();
  buffers_.resize(root().array("buffers").size());
}

void GltfDocument::open_glb() {
  constexpr std::uint32_t kJson = 0x4E4F534A, kBin = 0x004E4942;
  const std::uint32_t version = word_at(*file_, 4), total = word_at(*file_, 8);
  if (version != 2)
    fail(ErrorCode::bad_input, "{}: is GLB version {}, and only version 2 is read", file_->name(), version);
  if (total > file_->size()) {
    fail(ErrorCode::bad_input, "{}: promises {} bytes and has {}; the file is truncated", file_->name(), total,
         file_->size());
  }
  bool has_json = false;
  for (std::uint64_t at = 12; at + 8 <= total;) {
    const std::uint64_t size = word_at(*file_, at), type = word_at(*file_, at + 4);
    at += 8;
    if (size > total - at)
      fail(ErrorCode::bad_input, "{}: byte {}: a chunk of {} bytes does not fit into the file", file_->name(), at,
           size);
    if (size % 4 != 0 && at + size < total)
      fail(ErrorCode::bad_input, {Remedy::repair_file},
           "{}: byte {}: a chunk of {} bytes, and programs disagree on lengths that are no multiple of 4",
           file_->name(), at, size);
    if (!has_json) {
      if (type != kJson) break;  // it must come first: other programs look nowhere else
      parse(at, size);
      has_json = true;
    } else if (type == kBin && !glb_data_) {
      glb_data_ = part_of(file_, at, size);
    }
    at += (size + 3) / 4 * 4;
  }
  if (!has_json)
    fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: does not begin with a JSON chunk", file_->name());
}

void GltfDocument::parse(std::uint64_t offset, std::uint64_t size) {
  LeanJson lean = read_lean_json(file_, offset, size, temp_dir_, options_.textures != nullptr);
  lifted_ = std::move(lean.data);
  const std::uint64_t described = description_bytes(lean.text);
  document_bytes_ = lean.text.size() + bytes_to_parse(lean.text);
  try {
    CountedJson all = parsed(lean.text, file_->name(), options_, 0);
    json_ = std::move(all.json);
    json_bytes_ = all.bytes;
  } catch (const NeedsMemory& e) {  // the list of nodes comes next, and must fit, too
    throw Error(e.code(), e.what(), e.remedies(),
                std::max(e.memory_bytes(), limit_of_description(described, options_)));
  }
}

void GltfDocument::check_root() const {
  if (root().has("geometricError"))
    fail(ErrorCode::bad_input, "{}: a tileset of 3D Tiles; it is read as a file whose name ends in .json",
         file_->name());
  const std::string version = root().object("asset").text("version");
  if (version.compare(0, 2, "2.") != 0)
    fail(ErrorCode::bad_input, "{}: is glTF version {}, and only version 2 is read", file_->name(), version);
  const GltfObject asset = root().object("asset");
  if (asset.has("minVersion") && asset.text("minVersion") != "2.0")
    fail(ErrorCode::bad_input, "{}: asks for readers of glTF {}, and only version 2.0 is read", file_->name(),
         asset.text("minVersion"));
  check_required_extensions(root());
}

// --- GltfDocument: buffers and accessors
// ---------------------------------------------------------------------------------

UriFile GltfDocument::file_beside(const std::string& uri) const {
  const std::string path = file_->path();
  const std::size_t slash = path.find_last_of('/');
  return file_of_uri(uri, slash == std::string::npos ? "" : path.substr(0, std::max<std::size_t>(slash, 1)));
}

/// Returns the content of a string that was lifted from the JSON; null for any other string.
SceneFilePtr GltfDocument::lifted(const std::string& uri) const {
  constexpr std::string_view kLifted = "data:lifted,";
  if (!uri.starts_with(kLifted)) return nullptr;
  std::size_t number = 0;
  std::from_chars(uri.data() + kLifted.size(), uri.data() + uri.size(), number);
  return number < lifted_.size() ? lifted_[number] : nullptr;
}

ImagePlace GltfDocument::image(std::uint64_t i) {
  const GltfObject object = root().item("images", i);
  ImagePlace place{fmt::format("{}: images[{}]", file_->name(), i), nullptr, ""};
  if (object.has("bufferView")) {
    const View v = view(object.number("bufferView"));
    place.bytes = bytes_->part(v.address, v.size);
  } else if (object.has("uri")) {
    const std::string uri = object.text("uri");
    place.bytes = lifted(uri);
    const bool beside = !place.bytes && !file_->path().empty();
    const UriFile file = beside ? file_beside(uri) : UriFile{};
    if (!file.path.empty()) place.path = place.name = file.path;
  }
  return place;
}

SceneFilePtr GltfDocument::open_beside(const GltfObject& buffer, const std::string& uri) const {
  if (file_->path().empty()) buffer.broken("lies in another file, which stdin cannot name");
  const UriFile file = file_beside(uri);
  if (!file.fault.empty()) buffer.unfit(file.fault);
  try {
    return open_scene_file(file.path, temp_dir_, NamedBy::file);
  } catch (const Error& e) {
    fail_as(e, "{}: its data are missing: {}; put that file beside it", file_->name(), e.what());
  }
}

SceneFilePtr GltfDocument::open_buffer(std::uint64_t i) {
  const GltfObject buffer = root().item("buffers", i);
  if (!buffer.has("uri")) {
    if (i != 0 || !glb_data_) buffer.broken("has no data");
    return glb_data_;
  }
  const std::string uri = buffer.text("uri");
  if (SceneFilePtr data = lifted(uri)) return data;
  if (uri.compare(0, 5, "data:") == 0) buffer.broken("has embedded data that is not base64");
  return open_beside(buffer, uri);
}

const GltfDocument::Data& GltfDocument::buffer(std::uint64_t i) {
  const GltfObject object = root().item("buffers", i);
  std::optional<Data>& data = buffers_[std::size_t(i)];
  if (!data) {
    const SceneFilePtr file = open_buffer(i);
    data = Data{bytes_->add(file), std::min(file->size(), object.number("byteLength"))};
  }
  return *data;
}

GltfDocument::View GltfDocument::view(std::uint64_t i) {
  const GltfObject object = root().item("bufferViews", i);
  for (const char* name : kMeshoptNames) {
    if (object.has_extension(name)) return unpacked(i, object.object("extensions").object(name));
  }
  return part_of_buffer(object);
}

/// Returns the view of a buffer that an object describes: a bufferView, or the packed bytes of one.
GltfDocument::View GltfDocument::part_of_buffer(const GltfObject& object) {
  const Data& data = buffer(object.number("buffer"));
  const std::uint64_t offset = object.number("byteOffset", 0), size = object.number("byteLength");
  if (offset > data.size || size > data.size - offset) {
    object.broken(fmt::format("spans bytes {} to {} of a buffer that has {}, so the data are truncated", offset,
                              offset + size, data.size));
  }
  return {data.address + offset, size, object.number("byteStride", 0)};
}

void GltfDocument::check_stride(const GltfObject& object, const Accessor& a, std::uint64_t size, std::uint64_t packed) {
  if (packed != 0 && packed != a.stride)
    object.unfit(fmt::format("has elements each {} bytes, and they were compressed each {} bytes", a.stride, packed));
  if (a.stride != size && (a.components == 1 || a.components == kMatrixNumbers))
    object.unfit("lies in a bufferView with a byteStride, which is for vertices only");
  if (a.stride < size) object.broken(fmt::format("has elements of {} bytes, one each {} bytes", size, a.stride));
}

Accessor GltfDocument::accessor(std::uint64_t i, std::size_t components) {
  const GltfObject object = root().item("accessors", i);
  const std::string type = object.text("type");
  const char* const expected = components == kMatrixNumbers ? "MAT4" : kVectorTypes[components - 1];
  if (type != expected) object.broken(fmt::format("has the type {} where {} is needed", type, expected));
  Accessor a;
  a.count = object.number("count");
  a.type = component_type(object);
  a.components = components;
  a.normalized = object.flag("normalized") && a.type < ComponentType::u32;
  if (object.flag("normalized") && a.type == ComponentType::u32) object.unfit("normalizes integers of 32 bits");
  const std::uint64_t size = bytes_of(a.type) * components;
  const auto numbers = unpacked_numbers_.find(i);
  if (numbers != unpacked_numbers_.end()) {
    a.address = numbers->second.address;
    a.count = numbers->second.count;
    a.stride = size;
  } else if (object.has("bufferView")) {
    const View v = view(object.number("bufferView"));
    const std::uint64_t offset = object.number("byteOffset", 0);
    a.stride = v.stride > 0 ? v.stride : size;
    check_stride(object, a, size, v.packed_stride);
    if (a.count > 0 &&
        (offset > v.size || size > v.size - offset || (a.count - 1) > (v.size - offset - size) / a.stride))
      object.broken(fmt::format("has {} elements, more than its bufferView holds", a.count));
    a.address = v.address + offset;
  }
  if (object.has("sparse")) read_sparse(object.object("sparse"), a);
  // An accessor without data is zero except for its replaced elements: legal, of little use, and its count is bounded
  // by the file only.
  if (a.address == Accessor::kZeros && a.replaced_count == 0 && a.count > 0) object.broken("has no data");
  const std::uint64_t there = file_->size() + bytes_->size();
  if (a.address == Accessor::kZeros && a.count > there) {
    object.broken(fmt::format("has {} elements, and data for {} of them in a file of {} bytes", a.count,
                              a.replaced_count, there));
  }
  return a;
}

std::vector<double> GltfDocument::numbers(std::uint64_t i, std::size_t components, const char* what) {
  return numbers(accessor(i, components), what);
}

std::vector<double> GltfDocument::numbers(const Accessor& accessor, const char* what) const {
  check_memory(what, accessor.count * accessor.components * sizeof(double));
  return read_numbers(bytes_, accessor);
}

void GltfDocument::check_memory(const char* what, std::uint64_t bytes) const {
  check_document(options_, file_->name(), what, bytes, options_.document.bytes);
}

void GltfDocument::read_sparse(const GltfObject& sparse, Accessor& a) {
  const GltfObject numbers = sparse.object("indices"), values = sparse.object("values");
  const std::uint64_t count = sparse.number("count");
  a.number_type = component_type(numbers);
  const auto place = [&](const GltfObject& o, std::uint64_t size) {
    const View v = view(o.number("bufferView"));
    const std::uint64_t offset = o.number("byteOffset", 0);
    if (offset > v.size || count > (v.size - offset) / size)
      o.broken(fmt::format("has {} elements, more than its bufferView holds", count));
    return v.address + offset;
  };
  a.replaced_numbers = place(numbers, bytes_of(a.number_type));
  a.replaced_values = place(values, bytes_of(a.type) * a.components);
  a.replaced_count = count;
  check_sparse_numbers(numbers, a);
}

}  // namespace bp
