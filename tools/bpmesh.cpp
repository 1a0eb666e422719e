// bpmesh: brick stream in, proxy out. Manual: docs/bpmesh.1.md
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "io/mesh/mesh_writer.h"
#include "io/scene/scene_format.h"
#include "io/scene/scene_reader.h"
#include "io/stream/brick_shelf.h"
#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "lib/pass/mesh/mesh_stage.h"
#include "lib/tighten/few_faces.h"
#include "tools/cli/face_list.h"
#include "tools/cli/names.h"
#include "tools/cli/report.h"
#include "tools/cli/run_tool.h"
#include "tools/mesh/enclosure.h"
#include "tools/mesh/mesh_memory.h"
#include "tools/mesh/scale_advice.h"
#include "tools/notes/estimate.h"
#include "tools/notes/face_notes.h"
#include "tools/notes/proportion.h"
#include "tools/notes/up_note.h"
#include "tools/run/inputs.h"
#include "tools/run/memory_shares.h"
#include "tools/run/origin.h"
#include "tools/run/provenance.h"

namespace {

/// A tenth of the diameter: what hides a hundredth of the largest part costs as many triangles.
constexpr double kLeastPart = 1e-3;

struct Options {
  bp::CommonOptions common;
  std::string in = "-", out = "-", format;
  bp::MeshMode mode = bp::MeshMode::bounding;
  std::vector<std::uint64_t> faces;  // one per level
  std::optional<bp::Length> error;
  double volume = 0, edge_length = 0;
  std::optional<double> least_part;  // 0.001 inside
  std::optional<double> inset;       // 0.5 for fits
  bp::EncloseOption enclose;
  bool loose = false;  // --no-tighten
  bool measure = false, quads = false;
  bp::OriginOption origin;
};

std::vector<std::uint64_t> faces_of(const std::string& text) {
  if (text.find('%') != std::string::npos)
    bp::fail(bp::ErrorCode::bad_argument,
             "{}: a stream does not tell how many triangles its scene has; give a number, or use bplod", text);
  return bp::parse_face_list(text);
}

Options parse(bp::Args& args) {
  Options o;
  args.about("Meshes a brick stream into a coarse proxy that encloses its voxels and does not intersect itself.");
  args.positional("INPUT", o.in, "brick stream; - is stdin");
  args.option("-o,--output", "FILE", o.out, "proxy: .glb .gltf .ply .obj .stl; - is stdout, with --format");
  args.option("--format", "NAME", o.format, "format of the output, if its name does not tell");
  args.option(
      "--mode", {{"bounding", bp::MeshMode::bounding}, {"inside", bp::MeshMode::inside}, {"fit", bp::MeshMode::fit}},
      o.mode,
      "around what is meshed; strictly inside the scene, of a stream of bpvox --fill inside; or as near as can be");
  args.option(
      "--faces", "N[,N...]", [&o](const std::string& text) { o.faces = faces_of(text); },
      "stop at N triangles; several falling numbers: a chain of levels, each enclosing the one before");
  args.option("--error", "LENGTH", o.error, "no point of the proxy farther from what it encloses; above 0");
  args.option("--volume", "RATIO", o.volume,
              "at most RATIO times the volume of the voxels that are meshed; 0: no limit");
  args.option("--edge-length", "C", o.edge_length, "no edge longer than C times the scale there; 0: no limit");
  std::vector<std::string> enclose;
  args.option(
      "--enclose", "WHAT", enclose,
      "what stays inside while the proxy is tightened: scene (its triangles), input (its voxels), closing, or scene "
      "files (default: auto, scene where its files are at hand, else input)");
  args.option(
      "--inset", "RATIO", o.inset,
      "fit: how far inside the voxels' surface to lie, in extents of a voxel (0.5, as the scene does on average)");
  args.option("--least-part", "RATIO", o.least_part,
              "inside: leave out parts smaller than RATIO times the largest, by volume (0.001; 0: none)");
  args.flag("--no-tighten", o.loose, "leave out the last step, which lowers the volume");
  args.flag("--quads", o.quads, "join triangles to quads, safe for either diagonal; in OBJ and PLY");
  args.flag("--measure", o.measure, "measure distances, and print volume, edges and distances on stderr");
  args.option(
      "--origin", "auto|off|X,Y,Z", [&o](const std::string& text) { o.origin = bp::parse_origin(text); },
      "subtract this point from every vertex, for formats and programs with short numbers; auto: a round point near a "
      "scene that lies far off; off: none, and no note (default: none)");
  o.common.add_to(args, bp::CommonOptions::all_parts & ~unsigned(bp::CommonOptions::device_part));
  args.example("bpvox scene.glb --resolution 256 | bpclose --scale 2% | bpmesh --faces 1000 -o proxy.glb");
  args.parse();
  o.enclose = bp::parse_enclose(enclose);
  std::vector<std::string> inputs = o.enclose.files;
  inputs.push_back(o.in);
  bp::check_stdin_once(inputs);
  bp::keep_inputs(inputs);
  if (o.error && !(o.error->value > 0))
    bp::fail(bp::ErrorCode::bad_argument, "--error {}: must be above 0; leave it out for no limit", o.error->text());
  return o;
}

/// "1000" or "5000,1000,200"; "0" without a target.
std::string faces_text(const Options& o) {
  return o.faces.empty() ? "0" : fmt::format("{}", fmt::join(o.faces, ","));
}

bp::Provenance provenance(const Options& o, const std::string& enclosed, const std::string& input, std::size_t level) {
  bp::OptionText text;
  text.add("mode", name_of(o.mode))
      .add("faces", faces_text(o))
      .add("error", o.error ? o.error->text() : "")
      .add("volume", o.volume)
      .add("edge-length", o.edge_length)
      .add("enclose", enclosed)
      .add("tighten", !o.loose);
  if (o.least_part) text.add("least-part", *o.least_part);
  if (o.inset) text.add("inset", *o.inset);
  if (o.quads) text.add("quads", o.quads);
  if (o.faces.size() > 1) text.add("level", level);
  return bp::make_provenance("bpmesh", text, input);
}

/// proxy.glb, or proxy.0.glb and so on if there are several levels.
std::string level_name(const Options& o, std::size_t level) {
  if (o.faces.size() < 2) return o.out;
  const std::size_t dot = o.out.rfind('.');
  if (o.out == "-") {
    bp::fail(
        bp::ErrorCode::bad_argument,
        "-o -: {} levels are as many files; name them with -o proxy.glb, for proxy.0.glb and so on, or ask for one "
        "number of --faces",
        o.faces.size());
  }
  if (dot == std::string::npos || o.out.find('/', dot) != std::string::npos)
    bp::fail(bp::ErrorCode::bad_argument,
             "-o {}: the numbers of levels go before the extension; give it one, as proxy.glb", o.out);
  return o.out.substr(0, dot) + "." + std::to_string(level) + o.out.substr(dot);
}

bp::Json json_of(const bp::SurfaceDistance& d) {
  return {{"at_most", d.at_most}, {"at_least", d.at_least}, {"mean", d.mean}, {"where", d.where}};
}

bp::Json json_of(const bp::QuadMeasures& q) {
  return {{"count", q.count},
          {"share_of_triangles", q.share},
          {"bend", {{"mean", q.bend_mean}, {"max", q.bend_max}}},
          {"aspect", {{"mean", q.aspect_mean}, {"max", q.aspect_max}}},
          {"angle_degrees", {{"min", q.angle_min_degrees}, {"max", q.angle_max_degrees}}},
          {"volume_over_diagonals", {{"least", q.volume_least}, {"most", q.volume_most}}}};
}

/// `asked`: faces; 0: not said.
bp::Json json_of(const bp::LevelCounts& c, std::uint64_t asked) {
  const bp::SimplifyCounts& s = c.simplify;
  const bp::MeshMeasures& m = c.measures;
  bp::Json json = {{"faces", s.faces_out},
                   {"faces_asked", asked > 0 ? bp::Json(asked) : bp::Json(nullptr)},
                   {"stopped_by", c.stopped_by},
                   {"error_bound", c.error_world},
                   {"volume", m.volume},
                   {"edge_length", {{"min", m.edge_min}, {"mean", m.edge_mean}, {"max", m.edge_max}}},
                   {"angle_min_degrees", m.angle_min_degrees},
                   {"shells", m.shells},
                   {"handles", m.handles},
                   {"faces_dense", s.faces_in},
                   {"faces_flat_merged", s.faces_flat},
                   {"collapses", s.collapses},
                   {"refused",
                    {{"link", s.refused_link},
                     {"constraints", s.refused_constraints},
                     {"shape", s.refused_shape},
                     {"growth", s.refused_growth},
                     {"length", s.refused_length},
                     {"guard", s.refused_guard},
                     {"limits", s.refused_limits},
                     {"enclosed", s.refused_enclosed},
                     {"error", s.refused_error}}},
                   {"moves", c.tighten.moves},
                   {"flips", c.tighten.flips}};
  if (m.quads) json["quads"] = json_of(*m.quads);
  if (m.proxy_to_enclosed) {
    json["distance"] = {{"proxy_to_enclosed", json_of(*m.proxy_to_enclosed)},
                        {"enclosed_to_proxy", json_of(*m.enclosed_to_proxy)},
                        {"hausdorff_at_most", m.hausdorff()}};
  }
  return json;
}

void fill_report(bp::Report& report, const Options& o, const bp::MeshCounts& c) {
  report.options = {{"mode", name_of(o.mode)},
                    {"faces", o.faces},
                    {"error", o.error ? o.error->text() : ""},
                    {"volume", o.volume},
                    {"edge-length", o.edge_length},
                    {"enclose", o.enclose.text()},
                    {"tighten", !o.loose},
                    {"origin", o.origin.text()}};
  bp::Json levels = bp::Json::array();
  for (std::size_t i = 0; i < c.levels.size(); ++i)
    levels.push_back(json_of(c.levels[i], i < o.faces.size() ? o.faces[i] : 0));
  report.counts = {{"voxels", c.voxels},
                   {"voxels_repaired", c.repaired},
                   {"parts_dropped", c.dropped_parts},
                   {"voxels_dropped", c.dropped_voxels},
                   {"volume_of_voxels", c.solid_volume_world},
                   {"levels", levels}};
}

std::string level_text(const bp::MeshCounts& c, std::size_t level) {
  return c.levels.size() > 1 ? fmt::format("level {}: ", level) : "";
}

/// Of a level that no step has taken beyond --error and --volume, but that was beyond from its beginning.
void note_bounds(bp::Report& report, const Options& o, const bp::MeshCounts& c, std::size_t i, double error_world) {
  const bp::LevelCounts& level = c.levels[i];
  const std::string which = level_text(c, i);
  const auto& distance = level.measures.proxy_to_enclosed;
  if (error_world > 0 && distance && distance->at_least > error_world * (1 + 1e-9)) {
    const bool inside = o.mode == bp::MeshMode::inside;
    const std::string why =
        i > 0 ? "the voxels at the level before are as far; use smaller voxels, fewer levels or a larger --error"
              : fmt::format("the voxels {} as far; use a smaller --scale or smaller voxels, or --enclose closing",
                            inside ? "themselves are" : "around it are");
    report.note(fmt::format("{}the proxy is up to {:.4g} from what it {} instead of {:.4g}: {}", which,
                            distance->at_least, inside ? "lies in" : "encloses", error_world, why),
                o.common);
  }
  const double share = level.measures.volume / c.solid_volume_world;
  const bool beyond = o.mode == bp::MeshMode::inside ? share < o.volume * (1 - 1e-9) : share > o.volume * (1 + 1e-9);
  if (o.volume > 0 && beyond) {
    report.note(
        fmt::format(
            "{}the volume is {:.4g} times that of the voxels that are meshed instead of {:.4g}, as it is of the "
            "voxels at the level before; use smaller voxels, fewer levels or another --volume",
            which, share, o.volume),
        o.common);
  }
}

/// "3 by topology, 1 by --volume": why edges that are left were not merged.
std::string refusals_text(const Options& o, const bp::SimplifyCounts& s) {
  const char* const limits = !o.error ? "--volume" : o.volume == 0 ? "--error" : "--error or --volume";
  const std::pair<std::uint64_t, const char*> all[] = {{s.refused_limits, limits},
                                                       {s.refused_link, "topology"},
                                                       {s.refused_constraints + s.refused_enclosed, "enclosure"},
                                                       {s.refused_shape, "shape"},
                                                       {s.refused_growth, "growth"},
                                                       {s.refused_length, "--edge-length"},
                                                       {s.refused_guard, "intersection"}};
  std::vector<std::string> parts;
  for (const auto& [count, what] : all) {
    if (count > 0) parts.push_back(fmt::format("{} by {}", count, what));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// What kept a level from its faces. `scale`: one that would do (enough_scale()).
std::string obstacle_text(const Options& o, const bp::LevelCounts& level, const std::optional<std::string>& scale) {
  const std::string& by = level.stopped_by;
  if (by == "error" && o.error) return fmt::format("--error {} was reached first", o.error->text());
  if (by == "volume") return fmt::format("--volume {} was reached first", o.volume);
  if (by == "edge-length") return fmt::format("--edge-length {} was reached first", o.edge_length);
  return bp::merged_note(level.simplify.faces_out, level.measures.shells, level.measures.handles, o.mode, scale);
}

/// Whether parts and handles may keep the finest level from its faces: a larger scale can help.
bool wants_scale(const Options& o, const bp::MeshCounts& c) {
  const bp::LevelCounts& level = c.levels.front();
  const std::string& by = level.stopped_by;
  return !o.faces.empty() && level.simplify.faces_out > o.faces.front() && by != "error" && by != "volume" &&
         by != "edge-length" && (level.measures.shells > 1 || level.measures.handles > 0);
}

/// Of a level that has not the faces that were asked for.
void note_faces(bp::Report& report, const Options& o, const bp::MeshCounts& c, std::size_t i,
                const std::optional<std::string>& scale) {
  const bp::LevelCounts& level = c.levels[i];
  const std::uint64_t faces = level.simplify.faces_out;
  if (i >= o.faces.size()) return;
  if (level.stopped_by == bp::kLeastVolume) {
    report.note(fmt::format("{}{} faces instead of {}: with so few, more would not hold less volume", level_text(c, i),
                            faces, o.faces[i]),
                o.common);
    return;
  }
  if (const std::string few = bp::too_few_note(faces, o.faces[i], o.mode); !few.empty())
    report.note(level_text(c, i) + few, o.common);
  if (faces <= o.faces[i]) return;
  const bool coarser = i == 0 || faces < c.levels[i - 1].simplify.faces_out;
  const std::string refusals = refusals_text(o, level.simplify);
  report.note(fmt::format("{}{} faces instead of {}{}: {}{}", level_text(c, i), faces, o.faces[i],
                          coarser ? "" : fmt::format(", no fewer than level {} has", i - 1),
                          obstacle_text(o, level, i == 0 ? scale : std::nullopt),
                          refusals.empty() ? "" : " (tries refused: " + refusals + ")"),
              o.common);
}

/// Of a level that has its faces at the price of its volume.
void note_volume(bp::Report& report, const Options& o, const bp::MeshCounts& c, std::size_t i) {
  if (i >= o.faces.size() || o.volume > 0) return;
  const bp::LevelCounts& level = c.levels[i];
  const std::string loose = bp::loose_note(level.simplify.faces_out, level.measures.volume / c.solid_volume_world,
                                           level.measures.shells, level.measures.handles, o.mode);
  if (!loose.empty()) report.note(level_text(c, i) + loose, o.common);
}

/// One line for each target that was out of reach: the user gets the best there is, and the reason.
void note_shortfalls(bp::Report& report, const Options& o, const bp::MeshCounts& c, double error_world,
                     const std::optional<std::string>& scale) {
  if (c.dropped_parts > 0) {
    report.note(fmt::format("small parts left out: {}, with {} of {} voxels; --least-part 0 keeps them",
                            c.dropped_parts, c.dropped_voxels, c.voxels),
                o.common);
  }
  for (std::size_t i = 0; i < c.levels.size(); ++i) {
    note_faces(report, o, c, i, scale);
    note_bounds(report, o, c, i, error_world);
    note_volume(report, o, c, i);
  }
}

std::string distance_text(const std::string& name, const bp::SurfaceDistance& d) {
  return fmt::format("  {}: at most {:.4g}, {:.4g} on average\n", name, d.at_most, d.mean);
}

std::string text_of(const Options& o, const bp::LevelCounts& level, const bp::MeshCounts& all) {
  const bool to_closing = o.error && o.enclose.kind == bp::EncloseOption::Kind::automatic;
  const std::string other = o.mode == bp::MeshMode::inside ? "what it lies in"
                            : o.mode == bp::MeshMode::fit  ? "what it is drawn to"
                            : to_closing                   ? "what is meshed"
                                                           : "what it encloses";
  const bp::MeshMeasures& m = level.measures;
  std::string text = fmt::format("{} faces, stopped by: {}\n", level.simplify.faces_out, level.stopped_by);
  text += fmt::format("  volume {:.6g}, {:.4g} times that of the voxels that are meshed\n", m.volume,
                      m.volume / all.solid_volume_world);
  text += fmt::format("  edges {:.4g} to {:.4g}, {:.4g} on average; least angle {:.3g} degrees\n", m.edge_min,
                      m.edge_max, m.edge_mean, m.angle_min_degrees);
  if (m.quads) {
    text += fmt::format(
        "  {} quads of {:.3g} % of the triangles; bend {:.2g} on average, at most {:.2g}; aspect {:.2g}, at most "
        "{:.2g}\n",
        m.quads->count, 100 * m.quads->share, m.quads->bend_mean, m.quads->bend_max, m.quads->aspect_mean,
        m.quads->aspect_max);
    text += fmt::format("  volume {:.6g} to {:.6g}, over the choices of diagonals\n", m.quads->volume_least,
                        m.quads->volume_most);
  }
  if (!m.proxy_to_enclosed) return text;
  text += distance_text("from the proxy to " + other, *m.proxy_to_enclosed);
  text += distance_text("from " + other + " to the proxy", *m.enclosed_to_proxy);
  return text + fmt::format("  Hausdorff distance: at most {:.4g}\n", m.hausdorff());
}

bp::MeshParams mesh_params(const Options& o, const bp::StreamHeader& header) {
  bp::MeshParams params;
  params.mode = o.mode;
  params.faces = o.faces;
  if (o.error) bp::question_length("--error", *o.error, header.bounds, header.frame.voxel);
  if (o.error) params.error_world = o.error->in_world(header.bounds.diagonal(), header.frame.voxel);
  params.volume_ratio = o.volume;
  params.edge_factor = o.edge_length;
  if (o.edge_length > 0 && !header.has_closing)
    bp::fail(bp::ErrorCode::bad_argument,
             "--edge-length counts in scales, and what was not closed has none; use bpclose before, or leave it out");
  if (o.inset && o.mode != bp::MeshMode::fit)
    bp::fail(bp::ErrorCode::bad_argument, "--inset is for fits; it needs --mode fit");
  if (o.inset) params.inset = *o.inset;
  if (o.least_part && o.mode != bp::MeshMode::inside)
    bp::fail(bp::ErrorCode::bad_argument,
             "only a proxy inside a scene may leave parts out; --least-part needs --mode inside");
  params.least_part = o.least_part.value_or(o.mode == bp::MeshMode::inside ? kLeastPart : 0);
  if (o.loose && o.mode == bp::MeshMode::fit)
    bp::fail(bp::ErrorCode::bad_argument, "a fit is not tightened; --no-tighten has no meaning");
  params.tighten = !o.loose;
  params.quads = o.quads;
  // What may come out beyond --error is measured, so that it can be told.
  const bool chosen = o.enclose.kind != bp::EncloseOption::Kind::automatic;
  params.distances = o.measure || (o.error && (chosen || o.faces.size() > 1));
  if (!params.tighten && !params.distances && chosen)
    bp::fail(bp::ErrorCode::bad_argument, "--enclose says what tightening keeps inside; --no-tighten leaves that out");
  return params;
}

/// Where a glTF lies far from its origin, or was moved nearer; other formats hold double, or refuse.
void note_origin(bp::Report& report, const Options& o, const bp::StreamHeader& header, bp::MeshFormat format) {
  const bool gltf = format == bp::MeshFormat::glb || format == bp::MeshFormat::gltf;
  if (!gltf && o.origin.kind != bp::OriginOption::Kind::automatic) return;
  if (const std::string text = origin_note(o.origin, header.frame, header.bounds); !text.empty())
    report.note(text, o.common);
}

/// What is enclosed; a note where it is less than could be.
std::string set_enclosure(const Options& o, const bp::StreamHeader& header, bp::MeshParams& params,
                          const bp::PieceMemory& memory, bp::Report& report) {
  bp::Enclosure enclosure = bp::make_enclosure(
      o.enclose, {header, o.mode, params.tighten, o.error.has_value(), params.distances, memory, o.common.temp});
  if (!enclosure.note.empty()) report.note(enclosure.note, o.common);
  params.enclose = enclosure.what;
  params.scene = std::move(enclosure.scene);
  // Nobody asked for the scene: the bound is on what bpmesh adds to the closing that was asked for.
  if (o.error && o.mode == bp::MeshMode::bounding && o.enclose.kind == bp::EncloseOption::Kind::automatic)
    params.distances_to = bp::Enclose::closing;
  return o.enclose.kind == bp::EncloseOption::Kind::files ? o.enclose.text() : enclosure.name();
}

/// A file of one format called by the name of another would be read as that.
bp::MeshFormat output_format(const Options& o) {
  if (o.format.empty()) return bp::mesh_format_of(o.out);
  const bp::MeshFormat format = bp::mesh_format_named(o.format);
  const std::string told = bp::scene_format_of(o.out);
  if (!told.empty() && bp::mesh_format_of(o.out) != format)
    bp::fail(bp::ErrorCode::bad_argument,
             "--format {}, but -o {} is named .{}; leave --format out, or rename the output", o.format, o.out, told);
  return format;
}

/// glTF has y up; other formats tell nothing.
void note_axes(bp::Report& report, const Options& o, const bp::StreamHeader& header, bp::MeshFormat format) {
  if (format != bp::MeshFormat::glb && format != bp::MeshFormat::gltf) return;
  if (const std::string text = bp::up_note(header); !text.empty()) report.note(text, o.common);
}

void note_estimate(bp::Report& report, const Options& o, const bp::StreamHeader& header, bp::Enclose enclosed) {
  const bool scene = enclosed == bp::Enclose::scene && !o.loose;
  const double effort = (o.error ? bp::kErrorEffort : 1) * (scene ? bp::kSceneEffort : 1);
  const bp::Estimate estimate = bp::estimate_mesh(header.bounds, header.frame.voxel, effort);
  const std::string text = bp::estimate_note(estimate, o.common.memory_bytes);
  if (!text.empty()) report.note(text, o.common);
}

void run(const Options& o) {
  if (o.out == "-" && o.format.empty())
    bp::fail(bp::ErrorCode::bad_argument, "name the output with -o, or its --format");
  const bp::MeshFormat format = output_format(o);
  if (o.quads && format != bp::MeshFormat::obj && format != bp::MeshFormat::ply)
    bp::fail(bp::ErrorCode::bad_argument, "--quads: only .obj and .ply hold quads");
  bp::Report report("bpmesh");
  report.stage("read and mesh");
  std::vector<std::unique_ptr<bp::OutputFile>> outputs;
  for (std::size_t i = 0; i < std::max<std::size_t>(o.faces.size(), 1); ++i)
    outputs.push_back(bp::open_output(level_name(o, i), o.common.overwrite));
  bp::BrickReader source(o.in);
  const bp::Vec3d origin = bp::origin_of(o.origin, source.header().frame, source.header().bounds);
  bp::MeshParams params = mesh_params(o, source.header());
  bp::PassContext context;
  context.pieces = bp::mesh_memory(o.common);
  context.make_shelf = bp::make_shelf_factory(bp::MeshBudget(o.common.memory_bytes).shelves, o.common.temp);
  const std::string enclosed = set_enclosure(o, source.header(), params, context.pieces, report);
  note_estimate(report, o, source.header(), params.enclose);
  note_axes(report, o, source.header(), format);
  const double error_world = params.error_world;
  bp::MeshCounts counts;
  bp::SolidKeeper keeper(source, context.make_shelf());
  const bool may_raise =
      o.mode == bp::MeshMode::bounding && !o.faces.empty() && bp::has_scale_to_raise(source.header());
  bp::BrickSource& bricks = may_raise ? static_cast<bp::BrickSource&>(keeper) : source;
  std::vector<bp::LatticeMesh> levels = bp::mesh_stream(bricks, context, std::move(params), counts);
  report.bytes_in = source.totals().bytes;

  report.stage("write");
  for (std::size_t i = 0; i < levels.size(); ++i) {
    levels[i].provenance.push_back(provenance(o, enclosed, source.totals().checksum(), i));
    bp::write_mesh(levels[i], *outputs[i], format, {origin, o.mode == bp::MeshMode::fit});
  }
  bp::OutputFile::commit_all(outputs);
  for (const auto& output : outputs) report.bytes_out += output->bytes();
  fill_report(report, o, counts);
  if (origin != bp::Vec3d{}) report.counts["origin"] = origin;
  note_origin(report, o, source.header(), format);
  report.counts["enclosed"] = enclosed;
  std::optional<std::string> scale;
  if (may_raise && wants_scale(o, counts)) {
    report.stage("try scales");
    scale = bp::enough_scale(source.header(), keeper.shelf(), o.faces.front(), o.common);
  }
  note_shortfalls(report, o, counts, error_world, scale);
  for (std::size_t i = 0; o.measure && i < levels.size(); ++i)
    std::fprintf(stderr, "%s: %s", level_name(o, i).c_str(), text_of(o, counts.levels[i], counts).c_str());
  report.write(o.common);
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpmesh", argc, argv, parse, run);
}
