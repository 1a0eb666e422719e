#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/unit/io/scene/scene_files.h"

/// Small glTF files, right or wrong in one place.
namespace bp::test {

using Json = nlohmann::ordered_json;

constexpr int kI8 = 5120, kU8 = 5121, kI16 = 5122, kU16 = 5123, kU32 = 5125, kF32 = 5126;

/// A document that grows: each array gets its own view and accessor.
struct Document {
  Json json{{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", Json::array({{{"nodes", {0}}}})}};
  std::string bytes;

  int view(const std::string& data, int stride = 0) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    Json v{{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", data.size()}};
    if (stride > 0) v["byteStride"] = stride;
    bytes += data;
    json["bufferViews"].push_back(v);
    return int(json["bufferViews"].size()) - 1;
  }
  int accessor(Json a) {
    json["accessors"].push_back(std::move(a));
    return int(json["accessors"].size()) - 1;
  }
  template <class T>
  int array(const std::vector<T>& values, int component_type, const char* type, std::size_t count) {
    std::string data;
    for (const T v : values) data += raw(v);
    return accessor({{"bufferView", view(data)}, {"componentType", component_type}, {"count", count}, {"type", type}});
  }
  int floats(const std::vector<Vec3d>& points) {
    std::vector<float> flat;
    for (const Vec3d& p : points)
      for (const double c : p) flat.push_back(float(c));
    return array(flat, kF32, "VEC3", points.size());
  }
  int mesh(int positions, int indices = -1, int mode = -1) {
    Json p{{"attributes", {{"POSITION", positions}}}};
    if (indices >= 0) p["indices"] = indices;
    if (mode >= 0) p["mode"] = mode;
    json["meshes"].push_back({{"primitives", Json::array({p})}});
    return int(json["meshes"].size()) - 1;
  }
  int node(Json n) {
    json["nodes"].push_back(std::move(n));
    return int(json["nodes"].size()) - 1;
  }
  int quad() { return floats({kQuad[0], kQuad[1], kQuad[2], kQuad[3]}); }
  int quad_mesh() {
    const int positions = quad();
    return mesh(positions, array<std::uint8_t>({0, 1, 2, 0, 2, 3}, kU8, "SCALAR", 6));
  }

  [[nodiscard]] std::string glb() const {
    Json doc = json;
    doc["buffers"] = Json::array({{{"byteLength", bytes.size()}}});
    std::string text = doc.dump(), data = bytes;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    data.resize((data.size() + 3) / 4 * 4);
    std::string file = "glTF" + raw(2u) + raw(std::uint32_t(28 + text.size() + data.size()));
    return file + raw(std::uint32_t(text.size())) + "JSON" + text + raw(std::uint32_t(data.size())) +
           std::string("BIN\0", 4) + data;
  }
  [[nodiscard]] std::string gltf(const std::string& uri) const {
    Json doc = json;
    doc["buffers"] = Json::array({{{"byteLength", bytes.size()}, {"uri", uri}}});
    return doc.dump(2);
  }
};

}  // namespace bp::test
