#include "tools/lod/scene/visual_options.h"

#include "lib/core/error.h"
#include "tools/lod/choices.h"

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
