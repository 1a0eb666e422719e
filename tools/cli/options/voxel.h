#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/grid/stream.h"
#include "tools/cli/args.h"

/// The scenes, and the voxels that are made of them: bpvox and bplod declare the same options.
namespace bp {

/// --format of a tool that reads scenes or meshes. before: begins its help.
void add_scene_format(Args& args, std::string& format, const std::string& before = "");

struct VoxelOptions {
  std::vector<std::string> scenes;
  std::string format;           ///< of stdin, or of files whose names do not tell
  std::optional<Length> voxel;  ///< this, or the resolution, or neither
  std::optional<std::int64_t> resolution;
  FillMode fill = FillMode::flood;
  std::optional<UpAxis> up;  ///< empty: what the scene tells, else y

  /// The argument SCENE..., and --format. scenes_help: "scenes, voxelized together".
  void add_scenes(Args& args, const std::string& scenes_help);
  /// resolution_default: the text for help, "256".
  void add_to(Args& args, const std::string& resolution_default);
  /// The same with `--fill inside`, which takes a tool that works on the inside of the scene.
  void add_with_inside(Args& args, const std::string& resolution_default);
  /// After args.parse(). Throws bad_argument if options contradict each other. A folder becomes the tileset in it.
  /// Keeps the scenes from being overwritten.
  void check();
  /// Whether --up says which axis is up, or all scenes are glTF, which has y up; not known of stdin without --format.
  [[nodiscard]] bool tell_up() const;
};

}  // namespace bp
