#include "io/gltf/detail/gltf_copy.h"

#include <algorithm>
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
  std::uint64_t begin = 0, size = 0;  ///< range of its content
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

/// Calls f(bytes) with the first `size` bytes of a file, block by block. All blocks but the last are multiples of 3.
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

JsonPlace json_place(const SceneFile& file) {
  if (!is_glb(file)) return {0, file.size()};
  const Chunk json = chunk_at(file, kFirst);
  return {json.begin, json.size};
}

void check_container(const SceneFile& file) {
  if (!is_glb(file)) return;
  const Chunk json = chunk_at(file, kFirst), data = chunk_at(file, json.end());
  if (json.type != kJson || data.type != kBin || data.end() < file.size())
    fail(ErrorCode::bad_input, "{}: is no GLB of JSON and one binary chunk", file.name());
}

GltfCopy::GltfCopy(SceneFilePtr file, const SceneFile& buffer, std::uint64_t bytes, std::uint64_t held,
                   const SceneOptions& options)
    : file_(std::move(file)),
      data_(std::make_unique<ScratchFile>(temp_dir_of(options))),
      options_(options),
      held_(held) {
  const JsonPlace json = json_place(*file_);
  add_memory(kPerByte * json.size, "its JSON, read and written");
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

void GltfCopy::add_memory(std::uint64_t bytes, const char* what) {
  json_bytes_ += bytes;
  check_document(options_, file_->name(), what, json_bytes_,
                 options_.document.bytes - std::min(options_.document.bytes, held_));
}

void GltfCopy::plan_copies(const GltfPlan& plan) {
  std::uint64_t sum = 0;
  for (const GltfVertices& v : plan.vertices) {
    for (std::size_t i = 0; i < v.numbers.size() && v.is_copy; ++i)
      sum += v.numbers[i] == 0 ? 0 : kViewBytes + (i == 0 ? kPositionBytes : kOtherBytes);
  }
  std::map<std::uint64_t, std::uint64_t> mesh_bytes;
  std::uint64_t node = ~std::uint64_t(0);  // edits of one node follow each other
  for (const GltfEdit& e : plan.edits) {
    if (!e.own_mesh || e.node == node) continue;
    node = e.node;
    const auto [bytes, is_new] = mesh_bytes.try_emplace(e.mesh);
    if (is_new) bytes->second = kMeshBytes + kPerByte * json_["meshes"][e.mesh].dump().size();
    sum += bytes->second;
  }
  add_memory(sum, "its JSON with a mesh for each place");
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

std::size_t GltfCopy::add_scalars(std::uint64_t offset) {
  const std::uint64_t bytes = size() - offset;
  json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
  return add_floats(json_["bufferViews"].size() - 1, 0, bytes / sizeof(float), "SCALAR");
}

void GltfCopy::plan_targets(const std::vector<GltfVertices>& parts, std::size_t targets) {
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::size_t> known;
  for (const GltfVertices& v : parts) {
    known.emplace(std::pair(v.numbers[0], v.numbers[1]), parts_.size());
    parts_.push_back({v.position.count, v.numbers[1] > 0, {}});
  }
  for (GltfOutJson& mesh : json_["meshes"]) {
    for (GltfOutJson& primitive : mesh["primitives"]) {
      const auto number = [&](const char* name) { return primitive["attributes"].value(name, ~std::uint64_t(0)) + 1; };
      const auto part = known.find({number("POSITION"), number("NORMAL")});
      if (part != known.end()) parts_[part->second].primitives.push_back(&primitive);
    }
  }
  add_memory(targets * bytes_of_targets(), "its JSON with a morph target of each part for each cage");
}

/// Returns the bytes of the morph targets of all parts for one cage.
std::uint64_t GltfCopy::bytes_of_targets() const {
  std::uint64_t of_each = 0, stride = 0;
  for (const Part& part : parts_) {
    if (part.stride() != stride) of_each += kTargetViewBytes;
    stride = part.stride();
    of_each += kPositionTargetBytes + (part.has_normals ? kNormalTargetBytes : 0) +
               part.primitives.size() * kPrimitiveTargetBytes;
  }
  return of_each;
}

std::size_t GltfCopy::view_of_targets(std::uint64_t bytes, std::uint64_t stride) {
  GltfOutJson& views = json_["bufferViews"];
  if (targets_view_ == stride) {
    views.back()["byteLength"] = views.back()["byteLength"].get<std::uint64_t>() + bytes;
  } else {
    views.push_back({{"buffer", 0},
                     {"byteOffset", size() - bytes},
                     {"byteLength", bytes},
                     {"byteStride", stride},
                     {"target", kVertexData}});
    targets_view_ = stride;
  }
  return views.size() - 1;
}

void GltfCopy::add_target(std::size_t number, const Bounds3d& bounds) {
  constexpr std::uint64_t kThreeFloats = 12;
  const Part& part = parts_[number];
  const std::uint64_t bytes = part.count * part.stride();
  const std::size_t view = view_of_targets(bytes, part.stride());
  const std::uint64_t at = size() - bytes - json_["bufferViews"].back()["byteOffset"].get<std::uint64_t>();
  GltfOutJson target{{"POSITION", add_floats(view, at, part.count, "VEC3")}};
  set_bounds(json_["accessors"].size() - 1, bounds);
  if (part.has_normals) target["NORMAL"] = add_floats(view, at + kThreeFloats, part.count, "VEC3");
  for (GltfOutJson* primitive : part.primitives) (*primitive)["targets"].push_back(target);
}

void GltfCopy::add_animation(std::size_t targets, double seconds) {
  std::vector<float> row(targets);
  for (std::size_t i = 0; i < targets; ++i) row[i] = float(double(i) * seconds);
  const std::array<float, 2> range{row.front(), row.back()};
  const std::uint64_t times = size();
  append(std::as_bytes(std::span(row)));
  const std::size_t input = add_scalars(times);
  const std::uint64_t weights = size();
  for (std::size_t i = 0; i < targets; ++i) {
    row.assign(targets, 0);
    row[i] = 1;
    append(std::as_bytes(std::span(row)));
  }
  const std::size_t output = add_scalars(weights);
  json_["accessors"][input]["min"] = {range[0]};
  json_["accessors"][input]["max"] = {range[1]};
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
       {"channels", std::move(channels)}});
}

void GltfCopy::write(OutputFile& out) {
  if (data_->size() > 0) json_["buffers"][0]["byteLength"] = data_->size();
  if (!is_glb(*file_)) return write_json(out);
  out.write(glb_head(json_.dump(), data_->size(), out.name()));
  each_block(*data_, data_->size(), [&](std::span<const std::byte> b) { out.write(b); });
}

/// Writes the JSON, with the buffer at the place of a mark that occurs nowhere else. Only one text exists at a time.
void GltfCopy::write_json(OutputFile& out) {
  constexpr int kIndent = 2;
  std::string mark = "base64,", text = json_.dump(kIndent);
  while (text.find(mark) != std::string::npos) mark += '_';
  if (data_->size() == 0) return out.write(text + "\n");
  json_["buffers"][0]["uri"] = "data:application/octet-stream;" + mark;
  text = std::string();
  text = json_.dump(kIndent);
  const std::size_t at = text.find(mark);
  const auto all = std::as_bytes(std::span(text));
  out.write(all.first(at));
  out.write("base64,");
  each_block(*data_, data_->size(), [&](std::span<const std::byte> b) {
    out.write(base64_of(std::string(reinterpret_cast<const char*>(b.data()), b.size())));
  });
  out.write(all.subspan(at + mark.size()));
  out.write("\n");
}

}  // namespace bp::detail
