#include "io/scene_parts.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>

#include "io/detail/uri.h"
#include "io/file.h"
#include "io/scene_format.h"
#include "lib/core/error.h"

namespace bp {

namespace {

constexpr std::size_t kMostJson = std::size_t(64) << 20, kMostObj = std::size_t(64) << 10;

std::vector<std::string> named_by_gltf(const std::string& text) {
  std::vector<std::string> names;
  const nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  for (const char* key : {"buffers", "images"}) {
    if (!document.is_object() || !document.contains(key) || !document.at(key).is_array()) continue;
    for (const nlohmann::json& item : document.at(key)) {
      if (!item.is_object() || !item.contains("uri") || !item.at("uri").is_string()) continue;
      const auto uri = item.at("uri").get<std::string>();
      if (!uri.starts_with("data:")) names.push_back(detail::percent_decoded(uri));
    }
  }
  return names;
}

std::vector<std::string> named_by_obj(const std::string& text) {
  static const std::string key = "mtllib";
  std::vector<std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line.erase(0, line.find_first_not_of(" \t"));
    if (!line.starts_with(key)) continue;
    const std::size_t begin = line.find_first_not_of(" \t", key.size()), end = line.find_last_not_of(" \r\t") + 1;
    if (begin > key.size() && begin < end) names.push_back(line.substr(begin, end - begin));
  }
  return names;
}

std::string head_of(const std::string& path, std::size_t bytes) {
  const InputFile file(path);
  if (!file.seekable()) return "";
  std::string text(std::size_t(std::min<std::uint64_t>(file.size(), bytes)), '\0');
  text.resize(file.read_at(0, std::as_writable_bytes(std::span(text))));
  return text;
}

/// The first chunk of a GLB.
std::string json_of_glb(const std::string& bytes) {
  constexpr std::size_t kBegin = 20;
  if (!bytes.starts_with("glTF") || bytes.size() < kBegin) return "";
  std::uint32_t size;
  std::memcpy(&size, bytes.data() + 12, sizeof size);
  return bytes.substr(kBegin, size);
}

}  // namespace

std::vector<std::string> parts_of_scene(const std::string& path) {
  const std::string format = scene_format_of(path);
  std::vector<std::string> names;
  std::error_code unknown;  // a pipe would be waited for, or robbed of its first bytes
  if (!std::filesystem::is_regular_file(path, unknown)) return names;
  try {
    if (format == "gltf") names = named_by_gltf(head_of(path, kMostJson));
    if (format == "glb") names = named_by_gltf(json_of_glb(head_of(path, kMostJson)));
    if (format == "obj") names = named_by_obj(head_of(path, kMostObj));
  } catch (const Error&) {
    return {};
  }
  for (std::string& name : names) {
    if (!name.starts_with('/')) name.insert(0, folder_of(path) + "/");
  }
  return names;
}

}  // namespace bp
