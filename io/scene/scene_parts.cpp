#include "io/scene/scene_parts.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <streambuf>
#include <string_view>

#include "io/files/beside.h"
#include "io/files/file.h"
#include "io/files/kept_files.h"
#include "io/files/uri.h"
#include "io/scene/scene_format.h"
#include "lib/core/error.h"

namespace bp {

namespace {

constexpr std::uint64_t kMostJson = std::uint64_t(64) << 20;
constexpr std::size_t kMostObj = std::size_t(64) << 10, kMostMtl = std::size_t(1) << 20;
// Bytes; a path has up to 4096, each of which may be written as %41.
constexpr std::size_t kMostToken = std::size_t(16) << 10;
constexpr std::size_t kMostNames = std::size_t(4) << 20;  // bytes of all names
constexpr std::size_t kMostDeep = 1000;

/// The JSON in a range of a file, piece by piece. Long strings and numbers are cut, since some hold buffers.
class JsonBytes final : public std::streambuf {
 public:
  JsonBytes(const InputFile& file, std::uint64_t begin, std::uint64_t size)
      : file_(file), at_(begin), end_(begin + std::min(size, kMostJson)), piece_(std::size_t(64) << 10, '\0') {}

 protected:
  int_type underflow() override {
    std::size_t kept = 0;
    while (kept == 0) {
      const std::uint64_t wanted = std::min<std::uint64_t>(end_ - at_, piece_.size());
      const std::size_t n = file_.read_at(at_, std::as_writable_bytes(std::span(piece_.data(), std::size_t(wanted))));
      if (n == 0) return traits_type::eof();
      at_ += n;
      for (std::size_t i = 0; i < n; ++i) {
        if (keeps(piece_[i])) piece_[kept++] = piece_[i];
      }
    }
    setg(piece_.data(), piece_.data(), piece_.data() + kept);
    return traits_type::to_int_type(piece_[0]);
  }

 private:
  /// Returns whether the next character, c, is kept.
  bool keeps(char c) {
    const bool whole = escaped_ == 0 && (c & 0xC0) != 0x80;  // c is neither inside an escape nor inside a character
    if (whole && (in_text_ ? c == '"' : std::strchr("\"[]{},: \t\r\n", c) != nullptr)) {
      in_text_ = !in_text_ && c == '"';
      cut_ = false;
      length_ = 0;
      return true;
    }
    cut_ = cut_ || (whole && length_ >= kMostToken);
    ++length_;
    if (!in_text_) return !cut_;
    if (escaped_ > 0) {
      escaped_ += c == 'u' && escaped_ == 1 ? 3 : -1;  // four digits follow
    } else if (c == '\\') {
      escaped_ = 1;
    }
    return !cut_;
  }

  const InputFile& file_;
  std::uint64_t at_, end_;
  std::string piece_;
  bool in_text_ = false, cut_ = false;
  int escaped_ = 0;         // characters of an escape that are still to come
  std::size_t length_ = 0;  // length of the string or number
};

/// Keeps buffers[].uri and images[].uri of a glTF document, and nothing else of it.
class UriCollector final : public nlohmann::json_sax<nlohmann::json> {
 public:
  std::vector<std::string> names;

  bool key(std::string& name) override {
    if (open_ == "{") listed_ = name == "buffers" || name == "images";
    if (open_ == "{[{") uri_ = name == "uri";
    return true;
  }
  bool string(std::string& text) override {
    if (open_ != "{[{" || !listed_ || !uri_ || text.size() >= kMostToken || text.starts_with("data:")) return true;
    if (UriFile file = file_of_uri(text, ""); file.fault.empty()) names.push_back(std::move(file.path));
    bytes_ += sizeof(std::string) + text.size();
    return bytes_ < kMostNames;
  }
  bool start_object(std::size_t /*size*/) override { return open('{'); }
  bool start_array(std::size_t /*size*/) override { return open('['); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(std::int64_t /*value*/) override { return true; }
  bool number_unsigned(std::uint64_t /*value*/) override { return true; }
  bool number_float(double /*value*/, const std::string& /*text*/) override { return true; }
  bool binary(nlohmann::json::binary_t& /*value*/) override { return true; }
  bool parse_error(std::size_t /*at*/, const std::string& /*token*/, const nlohmann::json::exception&) override {
    return false;  // the names found so far stay
  }

 private:
  bool open(char bracket) {
    open_ += bracket;
    return open_.size() < kMostDeep;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  std::string open_;  // brackets around the current place
  bool listed_ = false, uri_ = false;
  std::size_t bytes_ = 0;
};

std::vector<std::string> named_by_json(const InputFile& file, std::uint64_t begin, std::uint64_t size) {
  JsonBytes bytes(file, begin, size);
  std::istream text(&bytes);
  UriCollector uris;
  nlohmann::json::sax_parse(text, &uris);
  return std::move(uris.names);
}

std::vector<std::string> named_by_gltf(const std::string& path) {
  const InputFile file(path);
  if (!file.seekable()) return {};
  return named_by_json(file, 0, file.size());
}

/// Returns the names in a GLB. The first chunk holds the JSON.
std::vector<std::string> named_by_glb(const std::string& path) {
  const InputFile file(path);
  struct {
    char magic[4];
    std::uint32_t version, length, size, type;
  } head{};
  if (!file.seekable() || file.read_at(0, std::as_writable_bytes(std::span(&head, 1))) < sizeof head) return {};
  if (std::memcmp(head.magic, "glTF", sizeof head.magic) != 0) return {};
  return named_by_json(file, sizeof head, head.size);
}

/// Calls f(key, rest) for each line of a text file that has both.
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

/// Returns the names in an MTL. Options of a texture ("-s 1 1 1") stand before its name, which may have blanks: so the
/// whole text and its last word are both tried.
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

/// Returns the paths of names in a file.
std::vector<std::string> beside(const std::string& file, std::vector<std::string> names) {
  for (std::string& name : names) {
    if (!name.starts_with('/')) name.insert(0, folder_of(file) + "/");
  }
  return names;
}

/// Returns the paths of names in an OBJ or MTL, which readers also find in other spellings (find_beside()).
std::vector<std::string> found_beside(const std::string& file, std::vector<std::string> names) {
  for (std::string& name : names) name = find_beside(folder_of(file), name);
  return names;
}

std::vector<std::string> materials_of(const std::string& obj) {
  return found_beside(obj, named_by_obj(head_of(obj, kMostObj)));
}

}  // namespace

std::vector<std::string> parts_of_scene(const std::string& path) {
  const std::string format = scene_format_of(path);
  if (!is_regular_file(path)) return {};
  try {
    if (format == "gltf") return beside(path, named_by_gltf(path));
    if (format == "glb") return beside(path, named_by_glb(path));
    if (format != "obj") return {};
    std::vector<std::string> parts = materials_of(path);
    for (const std::string& materials : std::vector<std::string>(parts)) {
      if (!is_regular_file(materials)) continue;
      const std::vector<std::string> textures = found_beside(materials, named_by_mtl(head_of(materials, kMostMtl)));
      parts.insert(parts.end(), textures.begin(), textures.end());
    }
    return parts;
  } catch (const Error&) {
    return {};
  }
}

std::vector<std::string> missing_materials(const std::string& path) {
  if (scene_format_of(path) != "obj" || !is_regular_file(path)) return {};
  std::vector<std::string> missing;
  try {
    missing = materials_of(path);
  } catch (const Error&) {
    return {};
  }
  std::erase_if(missing, is_regular_file);
  for (std::string& file : missing) {
    std::error_code unknown;
    file += std::filesystem::exists(file, unknown) ? " is no regular file" : " is not there";
  }
  return missing;
}

void keep_scene(const std::string& path) {
  keep_file_and_parts(path, parts_of_scene);
}

}  // namespace bp
