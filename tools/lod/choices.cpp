#include "tools/lod/choices.h"

#include <algorithm>
#include <filesystem>

#include "lib/core/error.h"
#include "tools/cli/names.h"
#include "tools/run/enclosed_triangles_limit.h"

namespace bp {

namespace {

/// Refuses what tiles that are the scene's own triangles do not have: voxels, a closing, levels.
void check_scene_tiles(const Args& args, const BuildOptions& o) {
  if (!o.shows_scene()) return;
  for (const char* const name :
       {"--voxel", "--resolution", "--fill", "--scale", "--levels", "--tile", "--tiles", "--leaves"})
    if (args.given(name))
      fail(ErrorCode::bad_argument,
           "{} has no meaning with --profile 3dtiles --mode visual: tiles follow from the scene", name);
  if (o.levels.faces.size() > 1)
    fail(ErrorCode::bad_argument,
         "--faces: --profile 3dtiles --mode visual takes one number, the most triangles of each tile");
}

}  // namespace

LevelRequest request_of(const BuildOptions& o, double diagonal, double voxel) {
  LevelRequest r;
  r.levels = o.levels.levels;
  r.faces = o.levels.faces;
  r.shares = o.levels.shares;
  for (const Length& error : o.levels.errors) r.errors_world.push_back(error.in_world(diagonal, 0));
  if (o.closing.scale) r.scale_world = o.closing.scale->in_world(diagonal, voxel);
  return r;
}

LevelRequest request_for(const BuildOptions& o, std::uint64_t triangles, double diagonal, double voxel) {
  // Triangles of the scene for each face; few for a cage, since a box needs a cage that can bend, too.
  constexpr double kPerCollisionFace = 8, kPerCageFace = 0.05;
  LevelRequest request = request_of(o, diagonal, voxel);
  if (o.is_tileset() && enclosed_by(o, triangles) == Enclose::scene)
    request.most_faces = std::max(kFacesPerTriangle * triangles, kLeastFirstFaces);
  if (o.is_tileset() || o.profile == LodProfile::occluder) return request;
  LevelDefaults defaults;
  if (o.profile == LodProfile::collision) defaults = {kPerCollisionFace, kMostCollisionFaces, kLeastFirstFaces};
  if (o.proxy.visual) defaults.triangles_per_face = 1;  // a small scene is its own finest level
  if (o.profile == LodProfile::cage) defaults = {kPerCageFace, kMostCageFaces};
  defaults.by_voxels = !o.proxy.visual && o.profile != LodProfile::cage && (o.voxels.voxel || o.voxels.resolution);
  return with_defaults(request, triangles, defaults);
}

VoxelRequest voxel_request(const BuildOptions& o, double diagonal) {
  VoxelRequest voxels;
  if (o.voxels.voxel) voxels.voxel = o.voxels.voxel->in_world(diagonal, 0);
  voxels.resolution = o.voxels.resolution.value_or(0);
  if (o.is_tileset()) voxels.use = VoxelUse::tiles;
  if (o.profile == LodProfile::occluder) voxels.use = VoxelUse::occluder;
  return voxels;
}

double voxel_size(const BuildOptions& o, const SceneSize& scene) {
  const double diagonal = scene.bounds.diagonal();
  return chosen_voxel(voxel_request(o, diagonal), request_for(o, scene.triangles, diagonal), scene);
}

bool is_by_scene(const BuildOptions& o) {
  return o.is_tileset() && !o.voxels.voxel && !o.voxels.resolution && asks_for_nothing(request_of(o));
}

bool can_read_again(const BuildOptions& o) {
  return std::all_of(o.voxels.scenes.begin(), o.voxels.scenes.end(), [](const std::string& scene) {
    std::error_code none;  // a file of another kind, such as a pipe, can be read only once
    return scene != "-" && std::filesystem::is_regular_file(scene, none);
  });
}

bool may_enclose_scene(const BuildOptions& o) {
  return !o.is_cage() && o.proxy.mode == MeshMode::bounding;
}

bool may_read_again(const BuildOptions& o) {
  const bool triangles = may_enclose_scene(o) || o.proxy.mode == MeshMode::fit;
  return can_read_again(o) && (triangles || o.may_have_textures() || !o.field.empty());
}

double margin_of(const BuildOptions& o, double diagonal, double voxel) {
  return o.is_cage() ? o.margin.in_world(diagonal, voxel) : 0;
}

Enclose enclosed_by(const BuildOptions& o, std::uint64_t triangles) {
  if (const std::optional<Enclose> asked = o.proxy.enclose.what()) return *asked;
  const bool scene = may_enclose_scene(o) && can_read_again(o) && triangles <= kMostEnclosedTriangles;
  return scene ? Enclose::scene : Enclose::input;
}

OptionText option_text(const BuildOptions& o, Enclose enclosed, const LodTarget& target, std::size_t i,
                       double scale_world, const GridFrame& frame) {
  OptionText text;
  text.add("level", i).add("mode", o.mode_name());
  if (target.faces > 0) text.add("faces", target.faces);
  if (target.error_world > 0) text.add("error", target.error_world);
  text.add("scale", scale_world)
      .add("voxel", frame.voxel)
      .add("element", name_of(o.closing.element))
      .add("enclose", name_of(enclosed))
      .add("fill", name_of(o.voxels.fill))
      .add("up", name_of(frame.up))
      .add("tighten", true);
  if (o.profile == LodProfile::cage) text.add("quads", true);
  if (o.is_tileset() && o.compression() == Compression::none) text.add("compression", "none");
  return text;
}

void check_visual(const Args& args, const BuildOptions& o) {
  if (!o.proxy.visual) return;
  if (o.profile != LodProfile::gltf && !o.is_tileset())
    fail(ErrorCode::bad_argument, "--mode visual needs --profile gltf or 3dtiles");
  if (o.obj) fail(ErrorCode::bad_argument, "--mode visual writes GLB; give -o a folder");
  if (!can_read_again(o))
    fail(ErrorCode::bad_argument, "--mode visual: a scene from a pipe cannot be read again; give it as a file");
  for (const char* const name : {"--error", "--enclose", "--field"})
    if (args.given(name))
      fail(ErrorCode::bad_argument, "--mode visual takes a number of faces, and encloses nothing; leave {} out", name);
  check_scene_tiles(args, o);
}

}  // namespace bp
