#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/grid/stream.h"
#include "tools/cli/args.h"

/// The options of scenes and of their voxels, as bpvox and bplod declare them.
namespace bp {

/// Declares --format for a tool that reads scenes or meshes. before: the beginning of its help.
void add_scene_format(Args& args, std::string& format, const std::string& before = "");

struct VoxelOptions {
  std::vector<std::string> scenes;
  std::string format;           ///< for stdin, and for files whose names do not tell
  std::optional<Length> voxel;  ///< edge of a voxel; at most one of this and the resolution is given
  std::optional<std::int64_t> resolution;
  FillMode fill = FillMode::flood;
  std::optional<UpAxis> up;  ///< empty: what the scene tells, else y

  /// Declares the argument SCENE... and --format. scenes_help: "scenes, voxelized together".
  void add_scenes(Args& args, const std::string& scenes_help);
  /// Declares the other options. resolution_default: the help text, "256".
  void add_to(Args& args, const std::string& resolution_default);
  /// Declares --voxel and --resolution only.
  void add_size(Args& args, const std::string& resolution_default);
  /// As add_to(), with `--fill inside`, for a tool that works on the inside of the scene.
  void add_with_inside(Args& args, const std::string& resolution_default);
  /// Checks the options after args.parse(). Throws bad_argument if options contradict each other. A folder becomes the
  /// tileset in it. Keeps the scenes from being overwritten.
  void check();
  void check_size() const;  ///< does it for --voxel and --resolution only
  /// Returns true if the axis up is known: by --up, or because all scenes are glTF, which has y up. It is not known for
  /// stdin without --format, and without files.
  [[nodiscard]] bool tell_up() const;
};

}  // namespace bp
