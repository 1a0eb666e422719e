#include "io/scene/scene_format.h"

#include <algorithm>
#include <array>

#include "io/files/lower.h"
#include "io/scene/detail/foreign_format.h"
#include "io/scene/raw_source.h"
#include "lib/core/error.h"

namespace bp {

namespace {

bool is_read(const std::string& extension) {
  constexpr std::array<const char*, 8> kOwn{"ply", "stl", "stla", "stlb", "obj", "off", "gltf", "glb"};
  return std::find(kOwn.begin(), kOwn.end(), extension) != kOwn.end() || assimp_reads(extension);
}

}  // namespace

std::string scene_format_of(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  if (dot == std::string::npos || path[dot] != '.') return "";
  const std::string extension = lower(path.substr(dot + 1));
  return is_read(extension) ? extension : "";
}

std::string scene_format_named(const std::string& name) {
  const std::string extension = lower(name.starts_with('.') ? name.substr(1) : name);
  if (is_read(extension)) return extension;
  const std::string foreign = foreign_format("." + extension);
  if (!foreign.empty()) fail(ErrorCode::bad_argument, "'{}' {}", name, foreign);
  fail(ErrorCode::bad_argument, "'{}' is not a scene format; name one of ply stl obj off gltf glb", name);
}

bool names_parts(const std::string& format) {
  return format == "obj" || format == "gltf" || format == "glb";
}

}  // namespace bp
