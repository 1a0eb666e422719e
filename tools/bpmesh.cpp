// bpmesh: brick stream in, proxy out. Manual: docs/bpmesh.1.md
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "io/brick_shelf.h"
#include "io/brick_stream.h"
#include "io/mesh_writer.h"
#include "io/scene_reader.h"
#include "lib/core/error.h"
#include "lib/stage/mesh_stage.h"
#include "tools/common/provenance.h"
#include "tools/common/report.h"
#include "tools/common/run_tool.h"

namespace {

struct Options {
  bp::CommonOptions common;
  std::string in = "-", out = "-", format;
  std::uint64_t faces = 0;
  std::optional<bp::Length> error;
  double edge_length = 0;
  std::vector<std::string> enclose;
  bool loose = false;  // --no-tighten
  bp::Vec3d origin{};
};

bp::Vec3d parse_origin(const std::string& text) {
  bp::Vec3d p{};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? text.find(',', begin) : text.size();
    if (end == std::string::npos) bp::fail(bp::ErrorCode::bad_argument, "'{}' is not three numbers X,Y,Z", text);
    p[i] = bp::parse_number(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
  }
  return p;
}

Options parse(bp::Args& args) {
  Options o;
  args.about("Meshes a brick stream into a coarse proxy that encloses its voxels and does not intersect itself.");
  args.positional("INPUT", o.in, "brick stream; - is stdin");
  args.option("-o,--output", "FILE", o.out, "proxy: .glb .gltf .ply .obj .stl; - is stdout, with --format");
  args.option("--format", "NAME", o.format, "format of the output, if its name does not tell");
  args.option("--faces", "N", o.faces, "stop at N triangles; 0: no target");
  args.option("--error", "LENGTH", o.error, "stop where merging would move the surface further (root mean square)");
  args.option("--edge-length", "C", o.edge_length, "no edge longer than C times the scale there; 0: no limit");
  args.option(
      "--enclose", "WHAT", o.enclose,
      "what stays inside while the proxy is tightened: closing, input (the voxels of the scene), or scene files");
  args.flag("--no-tighten", o.loose, "leave out the last step, which lowers the volume");
  args.option(
      "--origin", "X,Y,Z", [&o](const std::string& text) { o.origin = parse_origin(text); },
      "subtract this point from every vertex, for formats with short numbers");
  o.common.add_to(args, bp::CommonOptions::all_parts & ~unsigned(bp::CommonOptions::device_part));
  args.example("bpvox scene.glb --resolution 256 | bpclose --scale 2% | bpmesh --faces 1000 -o proxy.glb");
  args.parse();
  return o;
}

bool is_layer(const std::string& what) {
  return what == "closing" || what == "input";
}

/// The option as given, with files by name only: a path is nobody's business in a provenance chain.
std::string enclose_text(const Options& o) {
  std::string text;
  for (const std::string& what : o.enclose) text += (text.empty() ? "" : ",") + what.substr(what.rfind('/') + 1);
  return text.empty() ? "closing" : text;
}

/// Sets what must stay inside; reads the scenes named.
void set_enclosed(const Options& o, const bp::Bounds3d& bounds, bp::MeshParams& params) {
  if (o.enclose.empty() || o.enclose == std::vector<std::string>{"closing"}) return;
  if (o.enclose == std::vector<std::string>{"input"}) {
    params.enclose = bp::Enclose::input;
    return;
  }
  if (std::any_of(o.enclose.begin(), o.enclose.end(), is_layer)) {
    bp::fail(bp::ErrorCode::bad_argument, "--enclose takes closing, or input, or scene files, not a mixture");
  }
  params.enclose = bp::Enclose::scene;
  bp::SceneOptions options;
  options.temp_dir = o.common.temp;
  const auto scene = bp::open_scenes(o.enclose, options);
  for (std::vector<bp::TriangleD> chunk; scene->read(chunk);) {
    for (const bp::TriangleD& t : chunk) {  // what the voxels do not enclose cannot be kept inside
      bp::Bounds3d both = bounds;
      for (const bp::Vec3d& p : t) both.add(p);
      if (both == bounds) continue;
      bp::fail(bp::ErrorCode::bad_input, "{}: reaches beyond the scene that the stream was made from; name that scene",
               scene->name());
    }
    params.scene.insert(params.scene.end(), chunk.begin(), chunk.end());
    if (params.scene.size() * 160 > o.common.memory_bytes / 2) {
      bp::fail(bp::ErrorCode::out_of_resource, "{}: its triangles need more than half of --memory; use --enclose input",
               scene->name());
    }
  }
}

bp::Provenance provenance(const Options& o, const std::string& input) {
  bp::OptionText text;
  text.add("faces", o.faces)
      .add("error", o.error ? o.error->text() : "")
      .add("edge-length", o.edge_length)
      .add("enclose", enclose_text(o))
      .add("tighten", !o.loose);
  return bp::make_provenance("bpmesh", text, input);
}

void fill_report(bp::Report& report, const Options& o, const bp::MeshCounts& c) {
  report.options = {{"faces", o.faces},
                    {"error", o.error ? o.error->text() : ""},
                    {"edge-length", o.edge_length},
                    {"enclose", enclose_text(o)},
                    {"tighten", !o.loose}};
  const bp::SimplifyCounts& s = c.simplify;
  report.counts = {{"voxels", c.voxels},
                   {"voxels_repaired", c.repaired},
                   {"faces_dense", s.faces_in},
                   {"faces_flat_merged", s.faces_flat},
                   {"faces", s.faces_out},
                   {"collapses", s.collapses},
                   {"refused",
                    {{"link", s.refused_link},
                     {"constraints", s.refused_constraints},
                     {"shape", s.refused_shape},
                     {"length", s.refused_length},
                     {"guard", s.refused_guard}}},
                   {"moves", c.tighten.moves},
                   {"flips", c.tighten.flips},
                   {"stopped_by", bp::to_string(s.stop)},
                   {"volume", c.volume_world},
                   {"volume_of_voxels", c.solid_volume_world}};
}

/// One line if the target was out of reach: the user gets the best there is, and the reason.
void note_shortfall(bp::Report& report, const Options& o, const bp::MeshCounts& c) {
  const bp::SimplifyCounts& s = c.simplify;
  if (o.faces == 0 || s.faces_out <= o.faces || s.stop == bp::StopReason::error) return;
  const std::string note = fmt::format(
      "{} faces instead of {}: no further edge can be merged (refused last: {} by topology, {} by enclosure, {} by "
      "shape, {} by length, {} by "
      "intersection); a larger --scale joins parts and closes holes",
      s.faces_out, o.faces, s.refused_link, s.refused_constraints, s.refused_shape, s.refused_length, s.refused_guard);
  report.notes.push_back(note);
  if (o.common.progress != bp::ProgressMode::quiet) std::fprintf(stderr, "bpmesh: note: %s\n", note.c_str());
}

void run(const Options& o) {
  if (o.out == "-" && o.format.empty())
    bp::fail(bp::ErrorCode::bad_argument, "name the output with -o, or its --format");
  const bp::MeshFormat format = bp::mesh_format_of(o.format.empty() ? o.out : "x." + o.format);
  bp::Report report("bpmesh");
  report.stage("read and mesh");
  const auto output = bp::open_output(o.out, o.common.overwrite);
  bp::BrickReader source(o.in);
  const bp::StreamHeader& header = source.header();
  bp::MeshParams params;
  params.faces = o.faces;
  if (o.error) params.error_world = o.error->in_world(header.bounds.diagonal(), header.frame.voxel);
  params.edge_factor = o.edge_length;
  params.tighten = !o.loose;
  if (params.tighten) set_enclosed(o, header.bounds, params);
  bp::MeshCounts counts;
  bp::LatticeMesh proxy = bp::mesh_stream(source, bp::make_shelf_factory(o.common.memory_bytes / 2, o.common.temp),
                                          std::move(params), counts);
  report.bytes_in = source.totals().bytes;
  proxy.provenance.push_back(provenance(o, source.totals().checksum()));

  report.stage("write");
  bp::write_mesh(proxy, *output, format, {o.origin});
  output->commit();
  report.bytes_out = output->bytes();
  fill_report(report, o, counts);
  note_shortfall(report, o, counts);
  report.write(o.common);
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpmesh", argc, argv, parse, run);
}
