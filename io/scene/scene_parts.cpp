#include "io/scene/scene_parts.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <string_view>

#include "io/files/file.h"
#include "io/files/kept_files.h"
#include "io/files/uri.h"
#include "io/scene/scene_format.h"
#include "lib/core/error.h"

namespace bp {

namespace {

constexpr std::size_t kMostJson = std::size_t(64) << 20, kMostObj = std::size_t(64) << 10,
                      kMostMtl = std::size_t(1) << 20;

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

/// f(key, rest) for each line of a text file that has both.
template <class F>
void for_each_line(const std::string& text, F&& f) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    constexpr const char* kBlank = " \t\r";
    line.erase(0, line.find_first_not_of(kBlank));
    line.erase(line.find_last_not_of(kBlank) + 1);
    const std::size_t end = line.find_first_of(kBlank);
    if (end != std::string::npos) f(line.substr(0, end), line.substr(line.find_first_not_of(kBlank, end)));
  }
}

std::vector<std::string> named_by_obj(const std::string& text) {
  std::vector<std::string> names;
  for_each_line(text, [&](const std::string& key, const std::string& rest) {
    if (key == "mtllib") names.push_back(rest);
  });
  return names;
}

/// Options of a texture ("-s 1 1 1") stand before its name, which may have blanks: the whole, and its last word.
std::vector<std::string> named_by_mtl(const std::string& text) {
  std::vector<std::string> names;
  for_each_line(text, [&](const std::string& key, const std::string& rest) {
    constexpr std::array<std::string_view, 5> kOthers{"bump", "disp", "decal", "refl", "norm"};
    if (!key.starts_with("map_") && std::find(kOthers.begin(), kOthers.end(), key) == kOthers.end()) return;
    names.push_back(rest);
    if (rest.starts_with('-')) names.push_back(rest.substr(rest.find_last_of(" \t") + 1));
  });
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

/// Of names in a file: their paths.
std::vector<std::string> beside(const std::string& file, std::vector<std::string> names) {
  for (std::string& name : names) {
    if (!name.starts_with('/')) name.insert(0, folder_of(file) + "/");
  }
  return names;
}

bool is_file(const std::string& path) {
  std::error_code unknown;  // a pipe would be waited for, or robbed of its first bytes
  return std::filesystem::is_regular_file(path, unknown);
}

std::vector<std::string> materials_of(const std::string& obj) {
  return beside(obj, named_by_obj(head_of(obj, kMostObj)));
}

}  // namespace

std::vector<std::string> parts_of_scene(const std::string& path) {
  const std::string format = scene_format_of(path);
  if (!is_file(path)) return {};
  try {
    if (format == "gltf") return beside(path, named_by_gltf(head_of(path, kMostJson)));
    if (format == "glb") return beside(path, named_by_gltf(json_of_glb(head_of(path, kMostJson))));
    if (format != "obj") return {};
    std::vector<std::string> parts = materials_of(path);
    for (const std::string& materials : std::vector<std::string>(parts)) {
      if (!is_file(materials)) continue;
      const std::vector<std::string> textures = beside(materials, named_by_mtl(head_of(materials, kMostMtl)));
      parts.insert(parts.end(), textures.begin(), textures.end());
    }
    return parts;
  } catch (const Error&) {
    return {};
  }
}

std::vector<std::string> missing_materials(const std::string& path) {
  if (scene_format_of(path) != "obj" || !is_file(path)) return {};
  std::vector<std::string> missing;
  try {
    missing = materials_of(path);
  } catch (const Error&) {
    return {};
  }
  std::erase_if(missing, [](const std::string& file) {
    std::error_code unknown;
    return std::filesystem::exists(file, unknown);
  });
  return missing;
}

void keep_scene(const std::string& path) {
  keep_file_and_parts(path, parts_of_scene);
}

}  // namespace bp
