#include "tools/run/mesh_extras.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <sstream>

#include "io/files/file.h"
#include "io/files/json_shape.h"
#include "tools/cli/report.h"

namespace bp {

namespace {

constexpr std::size_t kHeadBytes = 65536;  // comments stand at the start of a file
constexpr std::size_t kMaxJsonBytes = 64u << 20;

/// Returns up to `n` bytes from `offset`.
std::string bytes_at(const InputFile& file, std::uint64_t offset, std::size_t n) {
  std::string bytes(n, '\0');
  bytes.resize(file.read_at(offset, std::as_writable_bytes(std::span(bytes))));
  return bytes;
}

/// Reads comments. Where lines tell a contract or an origin in different ways, the file tells none.
MeshExtras from_comments(const std::string& head) {
  MeshExtras extras;
  std::set<std::string> contracts;
  std::set<Vec3d> origins;
  std::istringstream lines(head);
  for (std::string line; std::getline(lines, line);) {
    for (const std::string start : {"comment provenance: ", "# provenance: "}) {
      if (line.compare(0, start.size(), start) == 0) extras.provenance.push_back(line.substr(start.size()));
    }
    for (const std::string start : {"comment contract: ", "# contract: "}) {
      if (line.compare(0, start.size(), start) == 0) contracts.insert(line.substr(start.size()));
    }
    for (const std::string start : {"comment origin: ", "# origin: "}) {
      Vec3d p;
      if (line.compare(0, start.size(), start) == 0 &&
          std::istringstream(line.substr(start.size())) >> p[0] >> p[1] >> p[2])
        origins.insert(p);
    }
  }
  if (contracts.size() == 1) extras.contract = *contracts.begin();
  if (origins.size() == 1) extras.origin = *origins.begin();
  extras.recorded = !extras.provenance.empty();
  return extras;
}

std::vector<std::string> gltf_provenance(const Json& document) {
  const Json none = Json::array();
  const Json* steps = &document;
  for (const char* key : {"asset", "extras", "provenance"}) {
    if (!steps->is_object() || !steps->contains(key)) return {};
    steps = &steps->at(key);
  }
  std::vector<std::string> lines;
  for (const Json& step : steps->is_array() ? *steps : none) {
    std::string line;
    for (const char* key : {"tool", "version", "options"}) {
      if (!step.is_object() || !step.contains(key) || !step.at(key).is_string()) return {};
      if (!line.empty()) line += ' ';
      line += step.at(key).get<std::string>();
    }
    if (step.contains("input") && step.at("input").is_string()) line += " input " + step.at("input").get<std::string>();
    lines.push_back(line);
  }
  return lines;
}

/// Returns the largest number of levels of a node, itself included.
std::size_t gltf_levels(const Json& document) {
  static const Json::json_pointer ids("/extensions/MSFT_lod/ids");
  std::size_t most = 1;
  if (!document.is_object() || !document.contains("nodes")) return most;
  for (const Json& node : document.at("nodes")) {
    if (node.is_object() && node.contains(ids)) most = std::max(most, node.at(ids).size() + 1);
  }
  return most;
}

std::optional<Vec3d> gltf_origin(const Json& document) {
  static const Json::json_pointer key("/asset/extras/origin");
  if (!document.is_object() || !document.contains(key)) return {};
  const Json& numbers = document.at(key);
  Vec3d p;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!numbers.is_array() || numbers.size() != 3 || !numbers[i].is_number()) return {};
    p[i] = numbers[i].get<double>();
  }
  return p;
}

std::string gltf_contract(const Json& document) {
  static const Json::json_pointer key("/asset/extras/contract");
  if (!document.is_object() || !document.contains(key) || !document.at(key).is_string()) return "";
  return document.at(key).get<std::string>();
}

std::optional<std::string> gltf_up(const Json& document) {
  static const Json::json_pointer key("/asset/extras/up");
  if (!document.is_object() || !document.contains(key)) return {};
  const Json& up = document.at(key);
  return up.is_string() ? up.get<std::string>() : up.dump();
}

/// Returns half of the step of 32-bit floats at `x`.
double half_step(double x) {
  int exponent = 0;
  (void)std::frexp(x, &exponent);
  return x == 0 ? 0 : std::ldexp(0.5, exponent - std::numeric_limits<float>::digits);
}

/// Returns how far 32-bit floats move a coordinate of a node with a translation and a scale, without parent and
/// children. `bounds`: an accessor with min and max.
double rounding_of(const Json& node, const Json& bounds) {
  double most = 0;
  const auto number = [](const Json& object, const char* key, std::size_t i, double otherwise) {
    const auto found = object.find(key);
    const bool has = found != object.end() && found->is_array() && found->size() == 3 && (*found)[i].is_number();
    return has ? (*found)[i].get<double>() : otherwise;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const double at = number(node, "translation", i, 0), scale = number(node, "scale", i, 1);
    double rounding = 0;
    for (const char* const end : {"min", "max"}) {
      const double p = scale * number(bounds, end, i, 0);
      const double scaled = scale == 1 ? 0 : half_step(p) + (double(float(scale)) == scale ? 0 : half_step(p));
      rounding = std::max(rounding, at == 0 ? scaled : scaled + half_step(at + p));
    }
    if (double(float(at)) != at) rounding += half_step(at);
    most = std::max(most, rounding);
  }
  return most;
}

double gltf_rounding(const Json& document) {
  double rounding = 0;
  const auto object = [&](const char* array, const Json& i) -> const Json* {
    if (!i.is_number_unsigned() || !document.contains(array) || !document.at(array).is_array()) return nullptr;
    const auto n = i.get<std::size_t>();
    return n < document.at(array).size() && document.at(array)[n].is_object() ? &document.at(array)[n] : nullptr;
  };
  if (!document.is_object() || !document.contains("nodes") || !document.at("nodes").is_array()) return 0;
  for (const Json& node : document.at("nodes")) {
    if (!node.is_object() || node.contains("matrix") || node.contains("rotation") || node.contains("children"))
      return 0;
    const Json* const mesh = node.contains("mesh") ? object("meshes", node.at("mesh")) : nullptr;
    if (mesh == nullptr || !mesh->contains("primitives")) continue;
    static const Json::json_pointer position("/attributes/POSITION");
    for (const Json& primitive : mesh->at("primitives")) {
      if (!primitive.is_object() || !primitive.contains(position)) return 0;
      const Json* const accessor = object("accessors", primitive.at(position));
      if (accessor == nullptr) return 0;
      rounding = std::max(rounding, rounding_of(node, *accessor));
    }
  }
  return rounding;
}

std::size_t gltf_animations(const Json& document) {
  return document.is_object() && document.contains("animations") ? document.at("animations").size() : 0;
}

/// Returns the largest number of morph targets of a primitive.
std::size_t gltf_morph_targets(const Json& document) {
  std::size_t most = 0;
  if (!document.is_object() || !document.contains("meshes")) return most;
  for (const Json& mesh : document.at("meshes")) {
    if (!mesh.is_object() || !mesh.contains("primitives")) continue;
    for (const Json& primitive : mesh.at("primitives")) {
      if (primitive.is_object() && primitive.contains("targets")) most = std::max(most, primitive.at("targets").size());
    }
  }
  return most;
}

std::size_t gltf_skins(const Json& document) {
  return document.is_object() && document.contains("skins") ? document.at("skins").size() : 0;
}

/// Returns the largest number of joints of a skin.
std::size_t gltf_joints(const Json& document) {
  std::size_t most = 0;
  if (gltf_skins(document) == 0) return most;
  for (const Json& skin : document.at("skins"))
    if (skin.is_object() && skin.contains("joints")) most = std::max(most, skin.at("joints").size());
  return most;
}

bool has_hulls(const Json& document) {
  if (!document.is_object() || !document.contains("nodes") || !document.at("nodes").is_array()) return false;
  return std::any_of(document.at("nodes").begin(), document.at("nodes").end(), [](const Json& node) {
    return node.is_object() && node.contains("name") && node.at("name").is_string() &&
           node.at("name").get_ref<const std::string&>().starts_with("UCX_");
  });
}

MeshExtras from_gltf(const std::string& text) {
  const char* const keys[] = {"\"extras\"", "\"MSFT_lod\"", "\"UCX_", "\"animations\"", "\"targets\"", "\"skins\""};
  if (std::none_of(std::begin(keys), std::end(keys),
                   [&](const char* key) { return text.find(key) != std::string::npos; }))
    return {};
  if (json_shape(text).is_too_deep()) return {};
  const Json document = Json::parse(text, nullptr, false);
  static const Json::json_pointer tile("/asset/extras/tile_origin");
  MeshExtras extras;
  extras.provenance = gltf_provenance(document);
  extras.origin = gltf_origin(document);
  extras.contract = gltf_contract(document);
  extras.up = gltf_up(document);
  static const Json::json_pointer record("/asset/extras/provenance");
  extras.recorded = document.is_object() && document.contains(record) && document.at(record).is_array();
  extras.rounding = gltf_rounding(document);
  extras.tile = document.is_object() && document.contains(tile);
  extras.levels = gltf_levels(document);
  extras.hulls = has_hulls(document);
  extras.animations = gltf_animations(document);
  extras.morph_targets = gltf_morph_targets(document);
  extras.skins = gltf_skins(document);
  extras.joints = gltf_joints(document);
  return extras;
}

}  // namespace

MeshExtras mesh_extras(const std::string& path) {
  if (path == "-") return {};
  const InputFile file(path);
  if (!file.seekable()) return {};
  const std::string head = bytes_at(file, 0, kHeadBytes);
  if (head.compare(0, 4, "glTF") == 0 && head.size() >= 20) {
    std::uint32_t json_bytes;
    std::memcpy(&json_bytes, head.data() + 12, 4);
    return json_bytes > kMaxJsonBytes ? MeshExtras{} : from_gltf(bytes_at(file, 20, json_bytes));
  }
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && head[first] == '{')
    return file.size() > kMaxJsonBytes ? MeshExtras{} : from_gltf(bytes_at(file, 0, file.size()));
  return from_comments(head);
}

std::string hash_of_scene(const MeshExtras& extras) {
  constexpr std::size_t kDigits = 32;
  static const std::string key = " input ";
  if (extras.provenance.empty()) return "";
  const std::string& first = extras.provenance.front();
  const std::string tool = first.substr(0, first.find(' '));
  const std::size_t at = first.rfind(key);
  if ((tool != "bpvox" && tool != "bplod") || at == std::string::npos) return "";
  const std::string hash = first.substr(at + key.size());
  return hash.size() == kDigits && hash.find_first_not_of("0123456789abcdef") == std::string::npos ? hash : "";
}

std::string made_by(const MeshExtras& extras) {
  if (extras.provenance.empty()) return "";
  const std::string& last = extras.provenance.back();
  const std::string tool = last.substr(0, last.find(' '));
  return tool == "bpmesh" || tool == "bplod" ? tool : "";
}

std::string mode_of(const MeshExtras& extras) {
  if (made_by(extras).empty()) return "";
  static const std::string key = " mode=";
  const std::string& last = extras.provenance.back();
  const std::size_t at = last.find(key);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + key.size();
  return last.substr(begin, last.find(' ', begin) - begin);
}

}  // namespace bp
