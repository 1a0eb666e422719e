#include "io/gltf/detail/gltf_sketch.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "io/gltf/detail/data_uri.h"
#include "io/gltf/detail/gltf_copy.h"

namespace bp::detail {

namespace {

/// Follows the parser through meshes[].primitives[].attributes and nodes[].mesh.
class SketchReader final : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit SketchReader(std::uint64_t most_meshes) : most_meshes_(most_meshes) {}

  bool null() override { return value(kWord); }
  bool boolean(bool) override { return value(kWord); }
  bool number_integer(std::int64_t) override { return value(kNumber); }
  bool number_unsigned(std::uint64_t x) override {
    if (in_nodes_ && depth_ == kItem && key_ == "mesh" && x < most_meshes_) ++mesh(x).nodes;
    return value(kNumber);
  }
  bool number_float(double, const std::string&) override { return value(kNumber); }
  bool string(std::string& text) override { return value(written_bytes(text)); }
  bool binary(binary_t&) override { return value(0); }
  bool start_object(std::size_t) override {
    if (++depth_ == kPrimitive && in_meshes_ && in_primitives_) ++mesh(meshes_met_ - 1).primitives;
    if (depth_ == kItem && in_meshes_) ++meshes_met_;
    return value(kBrackets);
  }
  bool end_object() override { return leave(); }
  bool start_array(std::size_t) override {
    ++depth_;
    return value(kBrackets);
  }
  bool end_array() override { return leave(); }
  bool key(std::string& text) override {
    key_ = text;
    if (depth_ == kRoot) in_nodes_ = text == "nodes", in_meshes_ = text == "meshes";
    if (depth_ == kItem) in_primitives_ = text == "primitives";
    if (depth_ == kPrimitive) in_attributes_ = text == "attributes";
    if (depth_ == kAttributes && in_meshes_ && in_primitives_ && in_attributes_) attribute(text);
    return value(written_bytes(text));
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

  /// Adds all places, as if each had a mesh and accessors of its own.
  void add_to(GltfSketch& sketch) const {
    for (const Mesh& m : all_) {
      sketch.places += m.nodes * m.primitives;
      sketch.copied_bytes += m.nodes * (m.accessor_bytes + GltfCopy::kMeshBytes + GltfCopy::kPerByte * m.text_bytes);
      sketch.target_bytes += m.nodes * (m.target_bytes + m.primitives * GltfCopy::kPrimitiveTargetBytes);
    }
  }

 private:
  static constexpr int kRoot = 1, kItem = 3, kPrimitive = 5, kAttributes = 6;  // nesting depth of these objects
  static constexpr std::uint64_t kWord = 5, kNumber = 24, kBrackets = 2, kSeparator = 1;  // bytes of text, at most
  struct Mesh {
    std::uint64_t nodes = 0, primitives = 0, text_bytes = 0, accessor_bytes = 0, target_bytes = 0;
  };

  static std::uint64_t written_bytes(const std::string& text) {
    constexpr std::uint64_t kQuotes = 2, kEscaped = 6;
    std::uint64_t bytes = kQuotes;
    for (const char c : text) bytes += std::uint8_t(c) < ' ' || c == '"' || c == '\\' ? kEscaped : 1;
    return bytes;
  }
  Mesh& mesh(std::uint64_t i) {
    if (i >= all_.size()) all_.resize(i + 1);
    return all_[i];
  }
  void attribute(const std::string& name) {
    Mesh& m = mesh(meshes_met_ - 1);
    if (name == "POSITION") {
      m.accessor_bytes += GltfCopy::kViewBytes + GltfCopy::kPositionBytes;
      m.target_bytes += GltfCopy::kTargetViewBytes + GltfCopy::kPositionTargetBytes;
    } else if (name == "NORMAL" || name == "TANGENT") {
      m.accessor_bytes += GltfCopy::kViewBytes + GltfCopy::kOtherBytes;
      if (name == "NORMAL") m.target_bytes += GltfCopy::kNormalTargetBytes;
    }
  }
  bool value(std::uint64_t bytes) {
    if (in_meshes_ && depth_ >= kItem && meshes_met_ > 0) mesh(meshes_met_ - 1).text_bytes += bytes + kSeparator;
    return true;
  }
  bool leave() {
    --depth_;
    return true;
  }

  const std::uint64_t most_meshes_;  // larger numbers name no mesh
  std::vector<Mesh> all_;
  int depth_ = 0;
  std::uint64_t meshes_met_ = 0;
  std::string key_;
  bool in_nodes_ = false, in_meshes_ = false, in_primitives_ = false, in_attributes_ = false;
};

}  // namespace

GltfSketch sketch_of(std::string text) {
  GltfSketch sketch{text.size(), bytes_to_parse(text)};
  for (char& c : text) {
    if (static_cast<unsigned char>(c) >= 128) c = '?';  // names in Latin-1 are no valid JSON, but are read
  }
  SketchReader reader(text.size());
  (void)nlohmann::json::sax_parse(text, &reader);
  reader.add_to(sketch);
  return sketch;
}

}  // namespace bp::detail
