#include "tools/run/inputs.h"

#include <algorithm>
#include <filesystem>

#include "io/scene/scene_format.h"
#include "lib/core/error.h"

namespace bp {

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

std::string tileset_in(const std::string& path) {
  std::error_code none;
  const std::filesystem::path tileset = std::filesystem::path(path) / "tileset.json";
  return std::filesystem::is_regular_file(tileset, none) ? tileset.string() : path;
}

void check_stream_name(const std::string& output) {
  if (!scene_format_of(output).empty())
    fail(ErrorCode::bad_argument, "{}: this would be a stream of voxels, not a mesh; bpmesh makes meshes of streams",
         output);
}

}  // namespace bp
