#include "tools/cli/options/voxel.h"

#include "lib/core/error.h"
#include "tools/cli/common_options.h"
#include "tools/run/inputs.h"

namespace bp {

namespace {

constexpr const char* kFillHelp = "what counts as inside, in addition to the voxels that the surface touches";
constexpr Args::Choice<FillMode> kFlood = {"flood", FillMode::flood, "all that the outside cannot reach"};
constexpr Args::Choice<FillMode> kWinding = {"winding", FillMode::winding,
                                             "where the winding number is not 0; cavities stay empty"};
constexpr Args::Choice<FillMode> kNone = {"none", FillMode::none, "nothing"};
constexpr Args::Choice<FillMode> kInsideFill = {
    "inside", FillMode::inside,
    "as flood, but without the voxels that the surface touches: for a proxy "
    "inside the scene"};

void add_up(VoxelOptions& o, Args& args) {
  args.option("--up", "x|y|z|-x|-y|-z", o.up,
              "axis of the scene that points up; glTF is turned by it (default: what the scene tells, else y)");
  args.words({{"x", ""}, {"y", ""}, {"z", ""}, {"-x", ""}, {"-y", ""}, {"-z", ""}});
}

}  // namespace

void add_scene_format(Args& args, std::string& format, const std::string& before) {
  args.option("--format", "NAME", format,
              before + "format of stdin, or of files whose names do not tell: ply stl obj off gltf glb ...");
  args.words({{"ply", ""}, {"stl", ""}, {"obj", ""}, {"off", ""}, {"gltf", ""}, {"glb", ""}});
}

void VoxelOptions::add_scenes(Args& args, const std::string& scenes_help) {
  args.positional("SCENE", scenes, scenes_help + "; - is stdin, where some formats need --format");
  args.group("Files");
  add_scene_format(args, format);
}

void VoxelOptions::add_size(Args& args, const std::string& resolution_default) {
  args.group("Voxels");
  args.option("--voxel", "LENGTH", voxel,
              "edge length of a voxel, as 0.5 or 0.5%: scene units, or a share of the scene's diagonal");
  args.option(
      "--resolution", "N", resolution,
      "number of voxels along the longest side of the scene, instead of --voxel (default: " + resolution_default + ")");
}

void VoxelOptions::add_to(Args& args, const std::string& resolution_default) {
  add_size(args, resolution_default);
  args.option("--fill", {kFlood, kWinding, kNone}, fill, kFillHelp);
  add_up(*this, args);
}

void VoxelOptions::add_with_inside(Args& args, const std::string& resolution_default) {
  add_size(args, resolution_default);
  args.option("--fill", {kFlood, kWinding, kNone, kInsideFill}, fill, kFillHelp);
  add_up(*this, args);
}

bool VoxelOptions::tell_up() const {
  return up || (!scenes.empty() && are_gltf(format, scenes));
}

void VoxelOptions::check() {
  for (std::string& scene : scenes) scene = tileset_in(scene);
  check_scene_format(format, scenes);
  keep_inputs(scenes);
  check_size();
}

void VoxelOptions::check_size() const {
  if (voxel && resolution) fail(ErrorCode::bad_argument, "--voxel and --resolution exclude each other");
  if (voxel && voxel->unit == Length::Unit::voxels)
    fail(ErrorCode::bad_argument, "--voxel {}: a voxel is not measured in voxels", voxel->text());
  if (voxel && !(voxel->value > 0)) fail(ErrorCode::bad_argument, "--voxel {}: must be above 0", voxel->text());
  if (resolution && *resolution < 1) fail(ErrorCode::bad_argument, "--resolution 0: at least 1 voxel is needed");
}

}  // namespace bp
