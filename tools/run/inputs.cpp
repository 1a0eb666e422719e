#include "tools/run/inputs.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <string_view>

#include "io/files/file.h"
#include "io/scene/scene_format.h"
#include "lib/core/error.h"

namespace bp {

namespace {

constexpr std::size_t kNamed = 5;

/// Returns the names of the meshes in a folder, sorted.
std::vector<std::string> meshes_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (!scene_format_of(entry.path().string()).empty()) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

void check_scene_format(const std::string& format, const std::vector<std::string>& inputs) {
  if (format.empty()) return;
  const std::string named = scene_format_named(format);
  const auto needs_it = [&](const std::string& input) {
    const std::string told = scene_format_of(input);
    return told.empty() || told == named;
  };
  if (inputs.empty() || std::any_of(inputs.begin(), inputs.end(), needs_it)) return;
  fail(ErrorCode::bad_argument,
       "--format {}: is for stdin and for names that do not tell, and {} tells its format; leave it out, or rename the "
       "file",
       format, inputs.front());
}

bool are_gltf(const std::string& format, const std::vector<std::string>& inputs) {
  const std::string otherwise = format.empty() ? "" : scene_format_named(format);
  return std::all_of(inputs.begin(), inputs.end(), [&](const std::string& input) {
    const std::string told = scene_format_of(input), name = told.empty() ? otherwise : told;
    return name == "gltf" || name == "glb";
  });
}

std::string tileset_in(const std::string& path) {
  std::error_code none;
  const std::filesystem::path tileset = std::filesystem::path(path) / "tileset.json";
  if (std::filesystem::is_regular_file(tileset, none)) return tileset.string();
  if (!std::filesystem::is_directory(path, none)) return path;
  const std::vector<std::string> meshes = meshes_in(path);
  if (meshes.empty()) fail(ErrorCode::bad_input, "{}: a folder with neither a tileset nor a mesh", path);
  fail(ErrorCode::bad_input, "{}: a folder without a tileset; name one of its meshes: {}{}", path,
       fmt::join(std::span(meshes).first(std::min(kNamed, meshes.size())), " "), meshes.size() > kNamed ? " ..." : "");
}

bool begins_as_stream(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return false;
  std::array<std::byte, 4> magic{};
  (void)InputFile(path).read_at(0, magic);
  return magic == std::array{std::byte(0x5b), std::byte(0x2a), std::byte(0x4d), std::byte(0x18)};
}

}  // namespace bp
