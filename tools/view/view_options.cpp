#include "tools/view/view_options.h"

#include <algorithm>

#include "io/mesh/mesh_writer.h"
#include "lib/core/error.h"
#include "lib/levels/voxel_choice.h"

namespace bp {

ViewOptions parse_view_options(Args& args) {
  ViewOptions o;
  args.about(
      "Opens a page in the browser, in which the scale of the closing is brushed on the scene. The closing follows "
      "each "
      "stroke, and the proxy is proven. Rules, proxy and the command line that makes it can be saved.");
  args.example("bpview scene.glb --resolution 256");
  args.positional("SCENE", o.voxels.scenes, "files of scenes, shown and voxelized together");
  args.group("Files");
  add_scene_format(args, o.voxels.format);
  args.option("--rules", "FILE", o.rules, "rules to go on from, as bpscale reads them; saved rules replace the file");
  args.option("-o,--output", "FILE", o.out, "GLB file of the proxy, once it is saved");
  args.option("--show", "PATH", o.shown,
              "show a file beside the scene: a mesh, levels, a tileset, voxels, or a folder of them (can be repeated)");
  o.voxels.add_to(args, std::to_string(kDefaultResolution));
  o.closing.add_element(args);
  args.group("Levels");
  args.option("--faces", "N", o.faces, "triangles of the proxy to begin with");
  args.group("Page");
  args.option("--port", "N", o.port, "port of 127.0.0.1 to answer at; 0: a free one");
  args.flag(
      "--no-open", [&o] { o.opens_browser = false; }, "print the link, and open no browser");
  o.common.add_to(args, CommonOptions::all_parts & ~unsigned(CommonOptions::report_part));
  args.often({"--show", "--rules", "--output", "--voxel", "--resolution", "--faces", "--no-open", "--overwrite"});
  args.parse();
  o.rules_given = args.given("--rules");
  o.voxels.check();
  if (std::count(o.voxels.scenes.begin(), o.voxels.scenes.end(), "-") > 0)
    fail(ErrorCode::bad_argument, "bpview reads files, not stdin: the scene is read again for each proxy");
  if (mesh_format_of(o.out) != MeshFormat::glb)
    fail(ErrorCode::bad_argument, "{}: bpview saves GLB; its command line makes every format", o.out);
  if (o.faces < 4) fail(ErrorCode::bad_argument, "--faces {}: a closed surface has at least 4", o.faces);
  if (o.port > 65535) fail(ErrorCode::bad_argument, "--port {}: the largest is 65535", o.port);
  return o;
}

}  // namespace bp
