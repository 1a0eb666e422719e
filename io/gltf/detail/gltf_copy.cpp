#include "io/gltf/detail/gltf_copy.h"

#include <array>
#include <cstring>

#include "io/gltf/base64.h"
#include "io/gltf/json_fault.h"
#include "io/scene/raw_source.h"
#include "lib/core/error.h"

namespace bp::detail {

namespace {

constexpr std::uint32_t kJson = 0x4E4F534A, kBin = 0x004E4942;
constexpr std::uint64_t kFirst = 12;
constexpr int kVertexData = 34962;

struct Chunk {
  std::uint64_t begin = 0, size = 0;  ///< of its content
  std::uint32_t type = 0;
  [[nodiscard]] std::uint64_t end() const { return begin + (size + 3) / 4 * 4; }
};

Chunk chunk_at(const SceneFile& file, std::uint64_t at) {
  std::array<std::uint32_t, 2> words{};
  if (file.read_at(at, std::as_writable_bytes(std::span(words))) != sizeof words) return {};
  return {at + 8, words[0], words[1]};
}

bool is_glb(const SceneFile& file) {
  std::array<char, 4> magic{};
  file.read_at(0, std::as_writable_bytes(std::span(magic)));
  return std::memcmp(magic.data(), "glTF", magic.size()) == 0;
}

/// Calls f(bytes) with the first `size` bytes of a file, block by block; blocks but the last are multiples of 3.
template <class File, class F>
void each_block(const File& file, std::uint64_t size, const F& f) {
  std::vector<std::byte> block(std::size_t(3) << 18);
  for (std::uint64_t at = 0; at < size; at += block.size()) {
    block.resize(std::size_t(std::min<std::uint64_t>(block.size(), size - at)));
    file.read_at(at, std::span(block));
    f(std::span<const std::byte>(block));
  }
}

}  // namespace

void check_container(const SceneFile& file) {
  if (!is_glb(file)) return;
  const Chunk json = chunk_at(file, kFirst), data = chunk_at(file, json.end());
  if (json.type != kJson || data.type != kBin || data.end() < file.size())
    fail(ErrorCode::bad_input, "{}: is no GLB of JSON and one binary chunk", file.name());
}

GltfCopy::GltfCopy(SceneFilePtr file, const SceneFile& buffer, std::uint64_t bytes, const SceneOptions& options)
    : file_(std::move(file)), data_(std::make_unique<ScratchFile>(temp_dir_of(options))) {
  constexpr std::uint64_t kPerByte = 12;  // of JSON: memory of what it becomes
  const Chunk json = is_glb(*file_) ? chunk_at(*file_, kFirst) : Chunk{0, file_->size(), kJson};
  check_document(options, file_->name(), "its JSON", kPerByte * json.size, options.document.bytes);
  std::string text(json.size, ' ');
  file_->read_at(json.begin, std::as_writable_bytes(std::span(text)));
  try {
    json_ = GltfOutJson::parse(text);
  } catch (const GltfOutJson::exception& e) {
    fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: broken JSON: {}", file_->name(), json_fault(e));
  }
  each_block(buffer, bytes, [&](std::span<const std::byte> b) { data_->append(b); });
  data_->append(std::vector<std::byte>(std::size_t((4 - bytes % 4) % 4)));
}

std::uint64_t GltfCopy::add_accessor(std::uint64_t like, std::uint64_t offset, std::uint64_t bytes) {
  json_["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}, {"target", kVertexData}});
  GltfOutJson accessor = json_["accessors"][like];
  accessor["bufferView"] = json_["bufferViews"].size() - 1;
  accessor.erase("byteOffset");
  json_["accessors"].push_back(std::move(accessor));
  return json_["accessors"].size() - 1;
}

std::uint64_t GltfCopy::mesh_of_its_own(std::uint64_t node, std::uint64_t mesh) {
  const auto [known, is_new] = own_meshes_.try_emplace(node, json_["meshes"].size());
  if (is_new) {
    json_["meshes"].push_back(GltfOutJson(json_["meshes"][mesh]));
    json_["nodes"][node]["mesh"] = known->second;
  }
  return known->second;
}

void GltfCopy::set_accessors(std::uint64_t mesh, std::uint64_t primitive, const std::array<std::uint64_t, 3>& numbers) {
  constexpr const char* kNames[] = {"POSITION", "NORMAL", "TANGENT"};
  for (std::size_t i = 0; i < 3; ++i) {
    if (numbers[i] > 0) json_["meshes"][mesh]["primitives"][primitive]["attributes"][kNames[i]] = numbers[i] - 1;
  }
}

void GltfCopy::set_bounds(std::uint64_t accessor, const Bounds3d& bounds) {
  if (bounds.empty()) return;
  json_["accessors"][accessor]["min"] = bounds.min;
  json_["accessors"][accessor]["max"] = bounds.max;
}

std::size_t GltfCopy::add_floats(std::size_t view, std::uint64_t offset, std::uint64_t count, const char* type) {
  constexpr int kFloat = 5126;
  json_["accessors"].push_back({{"bufferView", view}, {"componentType", kFloat}, {"count", count}, {"type", type}});
  if (offset > 0) json_["accessors"].back()["byteOffset"] = offset;
  return json_["accessors"].size() - 1;
}

std::size_t GltfCopy::add_scalars(const std::vector<float>& values) {
  json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", size()}, {"byteLength", 4 * values.size()}});
  append(std::as_bytes(std::span(values)));
  return add_floats(json_["bufferViews"].size() - 1, 0, values.size(), "SCALAR");
}

void GltfCopy::add_target(const std::array<std::uint64_t, 3>& numbers, std::uint64_t offset, std::uint64_t count,
                          const Bounds3d& bounds) {
  constexpr std::uint64_t kThreeFloats = 12;
  const bool has_normals = numbers[1] > 0;
  const std::uint64_t stride = has_normals ? 2 * kThreeFloats : kThreeFloats;
  GltfOutJson view{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", count * stride}};
  if (has_normals) view["byteStride"] = stride;
  view["target"] = kVertexData;
  json_["bufferViews"].push_back(std::move(view));
  const std::size_t at = json_["bufferViews"].size() - 1;
  GltfOutJson target{{"POSITION", add_floats(at, 0, count, "VEC3")}};
  set_bounds(json_["accessors"].size() - 1, bounds);
  if (has_normals) target["NORMAL"] = add_floats(at, kThreeFloats, count, "VEC3");
  for (GltfOutJson& mesh : json_["meshes"]) {
    for (GltfOutJson& primitive : mesh["primitives"]) {
      const GltfOutJson& attributes = primitive["attributes"];
      if (attributes.value("POSITION", ~std::uint64_t(0)) + 1 == numbers[0] &&
          attributes.value("NORMAL", ~std::uint64_t(0)) + 1 == numbers[1])
        primitive["targets"].push_back(target);
    }
  }
}

void GltfCopy::add_animation(std::size_t targets, double seconds) {
  std::vector<float> times, weights(targets * targets);
  for (std::size_t i = 0; i < targets; ++i) times.push_back(float(double(i) * seconds)), weights[i * targets + i] = 1;
  const std::size_t input = add_scalars(times), output = add_scalars(weights);
  json_["accessors"][input]["min"] = {times.front()};
  json_["accessors"][input]["max"] = {times.back()};
  GltfOutJson channels = GltfOutJson::array();
  for (std::size_t n = 0; n < json_["nodes"].size(); ++n) {
    if (!json_["nodes"][n].contains("mesh")) continue;
    GltfOutJson& mesh = json_["meshes"][json_["nodes"][n]["mesh"].get<std::size_t>()];
    if (!mesh["primitives"][0].contains("targets")) continue;
    mesh["weights"] = std::vector<int>(targets, 0);
    channels.push_back({{"sampler", 0}, {"target", {{"node", n}, {"path", "weights"}}}});
  }
  json_["animations"].push_back(
      {{"samplers", GltfOutJson::array({{{"input", input}, {"output", output}, {"interpolation", "LINEAR"}}})},
       {"channels", channels}});
}

void GltfCopy::write(OutputFile& out) {
  if (data_->size() > 0) json_["buffers"][0]["byteLength"] = data_->size();
  if (!is_glb(*file_)) return write_json(out);
  out.write(glb_head(json_.dump(), data_->size(), out.name()));
  each_block(*data_, data_->size(), [&](std::span<const std::byte> b) { out.write(b); });
}

/// The buffer goes to the place of a mark that stands nowhere else.
void GltfCopy::write_json(OutputFile& out) {
  constexpr int kIndent = 2;
  std::string mark = "base64,", text = json_.dump(kIndent);
  while (text.find(mark) != std::string::npos) mark += '_';
  if (data_->size() == 0) return out.write(text + "\n");
  json_["buffers"][0]["uri"] = "data:application/octet-stream;" + mark;
  text = json_.dump(kIndent);
  const std::size_t at = text.find(mark);
  out.write(text.substr(0, at) + "base64,");
  each_block(*data_, data_->size(), [&](std::span<const std::byte> b) {
    out.write(base64_of(std::string(reinterpret_cast<const char*>(b.data()), b.size())));
  });
  out.write(text.substr(at + mark.size()) + "\n");
}

}  // namespace bp::detail
