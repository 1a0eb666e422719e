#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/fuzz/hostile_scene.h"

namespace fuzz {

namespace {

using Json = nlohmann::ordered_json;

/// A whole number, or one at a limit.
Json number(Choices& c, std::uint64_t sound) {
  if (!c.once_in(32)) return sound;
  switch (c.below(4)) {
    case 0:
      return extreme_integer(c);
    case 1:
      return std::uint64_t(extreme_integer(c));
    case 2:
      return "@" + extreme_text(c);  // a bare word, see raw_numbers()
    default:
      return c.of({Json(nullptr), Json("0"), Json::array({0}), Json::object(), Json(true), Json(0.5), Json(-1)});
  }
}

/// As bare text in JSON: JSON has no word for what is not finite.
Json real(Choices& c, double sound) {
  return c.once_in(16) ? Json("@" + text_of(extreme_number(c))) : Json(sound);
}

Json reals(Choices& c, std::initializer_list<double> sound) {
  Json list = Json::array();
  for (const double x : sound) list.push_back(real(c, x));
  if (c.once_in(48)) list.push_back(1);
  return list;
}

/// "@text" becomes text.
std::string raw_numbers(const std::string& json) {
  std::string out;
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (json.compare(i, 2, "\"@") != 0) {
      out += json[i];
      continue;
    }
    for (i += 2; i < json.size() && json[i] != '"'; ++i) out += json[i];
  }
  return out;
}

/// The document, its buffer, and the accessors in it.
struct Document {
  Choices& c;
  Json json;
  std::string data = {};
  std::vector<std::size_t> vertices = {};  // of each primitive

  template <class T>
  std::uint64_t view(const std::vector<T>& values) {
    while (data.size() % 4 != 0) data += '\0';
    const std::size_t offset = data.size();
    data.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    Json v = {
        {"buffer", number(c, 0)}, {"byteOffset", number(c, offset)}, {"byteLength", number(c, data.size() - offset)}};
    if (c.once_in(24)) v["byteStride"] = number(c, c.of<std::uint64_t>({12, 16, 4, 0, 252, 256}));
    json["bufferViews"].push_back(v);
    return json["bufferViews"].size() - 1;
  }
  std::uint64_t accessor(Json a) {
    json["accessors"].push_back(std::move(a));
    return json["accessors"].size() - 1;
  }
  Json accessor_of(std::uint64_t view, int component, const char* type, std::size_t count) {
    Json a = {{"bufferView", number(c, view)},
              {"componentType", c.once_in(24) ? number(c, 5120 + c.below(8)) : Json(component)},
              {"count", number(c, count)},
              {"type", c.once_in(48) ? c.of<std::string>({"SCALAR", "VEC2", "VEC4", "MAT4", ""}) : type}};
    if (c.once_in(16)) a["byteOffset"] = number(c, c.of<std::uint64_t>({0, 4, 12, 3}));
    if (c.once_in(24)) a["normalized"] = true;
    return a;
  }
  void add_sparse(Json& a) {
    const std::uint64_t places = view(std::vector<std::uint16_t>{0, std::uint16_t(c.below(4)), 2});
    const std::uint64_t values = view(std::vector<float>(9, float(c.below(5))));
    if (c.once_in(3)) a.erase("bufferView");
    a["sparse"] = {{"count", number(c, 1 + c.below(3))},
                   {"indices", {{"bufferView", number(c, places)}, {"componentType", number(c, 5123)}}},
                   {"values", {{"bufferView", number(c, values)}}}};
  }
  void add_instances(Json& node);
  void add_targets(Json& primitive, std::size_t vertices);
  void add_joints(Json& attributes, std::size_t vertices);
  void add_skin();
  Json primitive();
  Json node(std::uint64_t nodes);
  void build();
};

void Document::add_instances(Json& node) {
  std::vector<float> places;
  const std::uint32_t n = c.below(4);
  for (std::uint32_t i = 0; i < 3 * n; ++i)
    places.push_back(c.once_in(8) ? float(extreme_number(c)) : float(c.below(6)));
  Json attributes = {{"TRANSLATION", number(c, accessor(accessor_of(view(places), 5126, "VEC3", n)))}};
  if (c.once_in(3)) {
    Json scale = {{"componentType", 5126}, {"count", number(c, n)}, {"type", "VEC3"}};  // zeros
    if (c.once_in(2)) add_sparse(scale);
    attributes["SCALE"] = accessor(std::move(scale));
  }
  node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
}

/// Adds the bounds of the finite numbers: without them, nothing of a file is decided.
void add_bounds(const std::vector<float>& points, Json& positions) {
  std::array<float, 3> min{}, max{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i])) continue;
    min[i % 3] = i < 3 ? points[i] : std::min(min[i % 3], points[i]);
    max[i % 3] = i < 3 ? points[i] : std::max(max[i % 3], points[i]);
  }
  positions["min"] = min;
  positions["max"] = max;
}

Json Document::primitive() {
  const Shape s = hostile_shape(c);
  std::vector<float> points;
  std::vector<std::uint16_t> indices;
  for (const auto& p : s.points) {
    for (const double x : p) points.push_back(float(x));
  }
  for (const auto& t : s.triangles) {
    for (const std::uint32_t v : t)
      indices.push_back(c.once_in(64) ? std::uint16_t(extreme_integer(c)) : std::uint16_t(v));
  }
  Json positions = accessor_of(view(points), 5126, "VEC3", s.points.size());
  add_bounds(points, positions);
  if (c.once_in(8)) add_sparse(positions);
  vertices.push_back(s.points.size());
  Json p = {{"attributes", {{"POSITION", number(c, accessor(positions))}}}};
  if (!c.once_in(12)) p["indices"] = number(c, accessor(accessor_of(view(indices), 5123, "SCALAR", indices.size())));
  if (c.once_in(8)) p["mode"] = number(c, c.below(7));
  if (c.once_in(12)) p["attributes"]["COLOR_0"] = number(c, p["attributes"]["POSITION"].is_number() ? 0 : 1);
  return p;
}

void Document::add_targets(Json& primitive, std::size_t corners) {
  for (std::uint32_t i = c.below(3); i > 0; --i) {
    Json positions = accessor_of(view(std::vector<float>(3 * corners, float(c.below(4)))), 5126, "VEC3", corners);
    if (c.once_in(4)) add_sparse(positions);
    primitive["targets"].push_back({{"POSITION", number(c, accessor(positions))}});
  }
}

void Document::add_joints(Json& attributes, std::size_t corners) {
  std::vector<std::uint8_t> joints;
  std::vector<float> weights;
  for (std::size_t i = 0; i < 4 * corners; ++i) {
    joints.push_back(c.once_in(64) ? std::uint8_t(extreme_integer(c)) : std::uint8_t(c.below(2)));
    weights.push_back(c.once_in(24) ? float(extreme_number(c)) : float(c.below(3)));
  }
  attributes["JOINTS_0"] = number(c, accessor(accessor_of(view(joints), 5121, "VEC4", corners)));
  attributes["WEIGHTS_0"] = number(c, accessor(accessor_of(view(weights), 5126, "VEC4", corners)));
}

/// Adds joints and morph targets to the existing meshes.
void Document::add_skin() {
  const std::uint32_t nodes = std::uint32_t(json["nodes"].size());
  const bool skin = c.once_in(2);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Json& p = json["meshes"][0]["primitives"][i];
    if (skin) add_joints(p["attributes"], vertices[i]);
    add_targets(p, vertices[i]);
  }
  if (c.once_in(2)) json["meshes"][0]["weights"] = reals(c, {0.5, double(c.below(3))});
  if (c.once_in(4)) json["nodes"][0]["weights"] = reals(c, {-1, 2});
  if (!skin) return;
  json["skins"] = Json::array({{{"joints", {number(c, c.below(nodes)), number(c, c.below(nodes))}}}});
  if (c.once_in(2)) {
    std::vector<float> matrices(32);
    for (std::size_t i = 0; i < 32; i += 5) matrices[i] = c.once_in(8) ? float(extreme_number(c)) : 1;
    json["skins"][0]["inverseBindMatrices"] = number(c, accessor(accessor_of(view(matrices), 5126, "MAT4", 2)));
  }
  for (Json& node : json["nodes"])
    if (!c.once_in(4)) node["skin"] = number(c, 0);
}

Json Document::node(std::uint64_t nodes) {
  Json n = Json::object();
  if (!c.once_in(6)) n["mesh"] = number(c, 0);
  if (c.once_in(3)) n["translation"] = reals(c, {double(c.below(4)), 0, 0});
  if (c.once_in(6)) n["rotation"] = reals(c, {0, 0.6, 0, 0.8});
  if (c.once_in(4)) n["scale"] = reals(c, {1, 2, -1});
  if (c.once_in(6)) n["matrix"] = reals(c, {1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 3, 0, 0, 1});
  if (c.once_in(4)) n["children"] = Json::array({number(c, c.below(std::uint32_t(nodes))), number(c, nodes - 1)});
  if (c.once_in(8)) n["extensions"]["MSFT_lod"]["ids"] = Json::array({number(c, nodes - 1), number(c, c.below(4))});
  if (c.once_in(6)) add_instances(n);
  return n;
}

void Document::build() {
  json["asset"]["version"] = c.once_in(48) ? extreme_text(c) : "2.0";
  if (c.once_in(8)) json["asset"]["extras"]["up"] = c.of<std::string>({"z", "y", "x"});
  if (!c.once_in(8)) {
    json["scene"] = number(c, 0);
    json["scenes"] = Json::array({Json{{"nodes", Json::array({number(c, 0)})}}});
  }
  Json mesh = {{"primitives", Json::array()}};
  for (std::uint32_t i = 1 + c.below(4) % 2; i > 0; --i) mesh["primitives"].push_back(primitive());
  json["meshes"] = Json::array({mesh});
  const std::uint64_t nodes = 1 + c.below(4);
  for (std::uint64_t i = 0; i < nodes; ++i) json["nodes"].push_back(node(nodes));
  if (c.once_in(3)) add_skin();
}

std::string text_of(const Json& json) {
  return raw_numbers(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void put(std::string& out, std::uint32_t value) {
  out.append(reinterpret_cast<const char*>(&value), 4);
}

std::string base64(const std::string& data) {
  static const char* const kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < data.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < data.size() ? std::uint8_t(data[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k > data.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63u];
  }
  return out;
}

}  // namespace

std::string hostile_gltf(Choices& c) {
  Document d{c, {}};
  d.build();
  const std::string uri = c.once_in(32) ? extreme_text(c) : "data:application/octet-stream;base64," + base64(d.data);
  d.json["buffers"] = Json::array({Json{{"byteLength", number(c, d.data.size())}, {"uri", uri}}});
  return text_of(d.json);
}

std::string hostile_glb(Choices& c) {
  Document d{c, {}};
  d.build();
  d.json["buffers"] = Json::array({Json{{"byteLength", number(c, d.data.size())}}});
  std::string json = text_of(d.json), out;
  while (json.size() % 4 != 0) json += ' ';
  while (d.data.size() % 4 != 0) d.data += '\0';
  const auto size = [&](std::size_t sound) {
    return c.once_in(32) ? std::uint32_t(extreme_integer(c)) : std::uint32_t(sound);
  };
  put(out, 0x46546c67);
  put(out, size(2));
  put(out, size(28 + json.size() + d.data.size()));
  put(out, size(json.size()));
  out += "JSON" + json;
  put(out, size(d.data.size()));
  out += std::string("BIN\0", 4) + d.data;
  return out;
}

}  // namespace fuzz
