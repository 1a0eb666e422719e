#include "tools/mesh/mesh_options.h"

#include <cmath>

#include "io/scene/scene_reader.h"
#include "lib/core/error.h"
#include "tools/run/inputs.h"

namespace bp {

MeshOptions parse_mesh_options(Args& args) {
  MeshOptions o;
  args.about("Makes a coarse mesh of a stream of voxels: closed, free of self-intersections, and around the scene.");
  args.positional("INPUT", o.in, "stream of voxels; - is stdin");
  args.group("Files");
  args.option("-o,--output", "FILE", o.out, "proxy, as .glb .gltf .ply .obj or .stl; - is stdout, as GLB");
  o.levels.add_of_stream(args);
  args.option("--volume", "RATIO", o.volume, "largest volume, as a multiple of the voxels' volume; 0: no limit");
  args.option(
      "--edge-factor", "N", o.edge_factor,
      "longest edge, as a multiple of the scale along it, whatever --faces asks for (default: 4 where the scale "
      "differs from place to place; longer near the closing, and where --faces needs it)");
  o.proxy.add_of_stream(args);
  args.flag("--quads", o.quads, "join triangles to quads, safe for either diagonal; for .obj and .ply");
  args.removed("--format", "the name of the output tells it; -o - writes GLB");
  args.removed("--edge-length", "--error bounds the shape");
  args.removed("--no-tighten", "bpmesh always makes the proxy tighter");
  args.removed("--inset", "a fit lies half a voxel inside the voxels' surface, as the scene does on average");
  args.removed("--least-part", "parts below a thousandth of the largest are left out of a proxy inside");
  args.removed("--measure", "--report has volume and edges, and bpcheck measures distances");
  o.common.add_to(args, CommonOptions::all_parts & ~unsigned(CommonOptions::device_part));
  args.example("bpvox scene.glb --resolution 256 | bpclose --scale 2% | bpmesh --faces 1000 -o proxy.glb");
  args.often({"--output", "--faces", "--error", "--mode", "--enclose", "--overwrite"});
  args.parse();
  if (!args.given("--output"))
    fail(ErrorCode::bad_argument, "name the output with -o{}",
         stdout_is_pipe() ? "; bpmesh comes last in the pipe, after bpvox and bpclose" : "");
  if (o.edge_factor && !(*o.edge_factor > 0 && *o.edge_factor < HUGE_VAL))
    fail(ErrorCode::bad_argument, "--edge-factor {}: not above 0", *o.edge_factor);
  o.proxy.mode_given = args.given("--mode");
  o.proxy.check();
  std::vector<std::string> inputs = o.proxy.enclose.files;
  inputs.push_back(o.in);
  check_stdin_once(inputs);
  keep_inputs(inputs);
  return o;
}

std::string level_name(const MeshOptions& o, std::size_t level) {
  if (o.levels.faces.size() < 2) return o.out;
  const std::size_t dot = o.out.rfind('.');
  if (o.out == "-") {
    fail(ErrorCode::bad_argument,
         "-o -: {} levels are as many files; name them with -o proxy.glb, for proxy.0.glb and so on, or ask for one "
         "number of --faces",
         o.levels.faces.size());
  }
  return o.out.substr(0, dot) + "." + std::to_string(level) + o.out.substr(dot);
}

MeshFormat output_format(const MeshOptions& o) {
  const MeshFormat format = o.out == "-" ? MeshFormat::glb : mesh_format_of(o.out);
  if (o.quads && format != MeshFormat::obj && format != MeshFormat::ply)
    fail(ErrorCode::bad_argument, "--quads: only .obj and .ply hold quads");
  return format;
}

}  // namespace bp
