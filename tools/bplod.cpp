// bplod: scenes in, levels of detail out, in one process. Manual: docs/bplod.1.md
#include <algorithm>
#include <cstdio>

#include "io/brick_shelf.h"
#include "io/chunk_store.h"
#include "io/scene_reader.h"
#include "lib/core/error.h"
#include "lib/grid/shelf_stream.h"
#include "lib/stage/lod_stage.h"
#include "lib/stage/voxelize_stage.h"
#include "tools/common/make_backend.h"
#include "tools/common/memory_shares.h"
#include "tools/common/provenance.h"
#include "tools/common/report.h"
#include "tools/common/run_tool.h"
#include "tools/lod/lod_outputs.h"
#include "tools/lod/lod_targets.h"

namespace {

using bp::ErrorCode;
using bp::fail;

constexpr std::int64_t kDefaultResolution = 256;
constexpr double kVoxelsPerError = 8;  // of the finest level

struct Options {
  bp::CommonOptions common;
  std::vector<std::string> scenes;
  std::string out, name, format;
  bp::LodProfile profile = bp::LodProfile::gltf;
  bp::MeshMode mode = bp::MeshMode::bounding;
  bp::LodRequest request;
  std::optional<bp::Length> voxel;
  std::optional<std::int64_t> resolution;
  bp::FillMode fill = bp::FillMode::flood;
  bp::UpAxis up = bp::UpAxis::y;
  bp::StructuringElement element = bp::StructuringElement::cube;
  bp::Enclose enclose = bp::Enclose::input;
  bool loose = false;  // --no-tighten
};

const char* name_of(bp::LodProfile profile) {
  constexpr const char* kNames[] = {"gltf", "3dtiles", "collision"};
  return kNames[std::size_t(profile)];
}

/// The file of a level; of a collision mesh, one of its three.
std::string file_of(const Options& o, std::size_t level) {
  return o.profile == bp::LodProfile::collision ? o.name + "_godot.glb" : bp::level_name(o.name, level) + ".glb";
}

/// The first scene's file name without folder and extension.
std::string base_name(const std::string& path) {
  const std::string file = path.substr(path.rfind('/') + 1);
  return file == "-" ? "scene" : file.substr(0, file.rfind('.'));
}

void check_options(Options& o) {
  const bool listed = !o.request.faces.empty() || !o.request.errors.empty() || !o.request.pixels.empty();
  if (o.profile == bp::LodProfile::collision && !listed && !o.request.levels) o.request.levels = 1;
  if (o.profile == bp::LodProfile::collision && bp::level_count(o.request) != 1)
    fail(ErrorCode::bad_argument, "--profile collision has one level");
  if (o.profile == bp::LodProfile::collision && o.mode != bp::MeshMode::bounding)
    fail(ErrorCode::bad_argument, "--profile collision needs --mode bounding");
  bp::check(o.request);
  if (o.out.empty()) fail(ErrorCode::bad_argument, "name the folder of the levels with -o");
  if (o.voxel && o.resolution) fail(ErrorCode::bad_argument, "--voxel and --resolution exclude each other");
  if (o.voxel && (o.voxel->unit == bp::Length::Unit::voxels || !(o.voxel->value > 0)))
    fail(ErrorCode::bad_argument, "--voxel {}: must be above 0, in scene units or percent", o.voxel->text());
  if (o.resolution && *o.resolution < 1) fail(ErrorCode::bad_argument, "--resolution 0: at least 1 voxel is needed");
  if (o.name.empty()) o.name = base_name(o.scenes.front());
  if (o.name.empty() || o.name.find('/') != std::string::npos)
    fail(ErrorCode::bad_argument, "--name '{}': must be a name without a folder", o.name);
}

Options parse(bp::Args& args) {
  Options o;
  args.about("Makes levels of detail of scenes: coarser and coarser proxies that strictly enclose them.");
  args.positional("SCENE", o.scenes, "scenes, taken together; - is stdin and needs --format");
  args.option("-o,--output", "DIR", o.out, "folder of the levels; it is made if it is not there");
  args.option(
      "--profile",
      {{"gltf", bp::LodProfile::gltf}, {"3dtiles", bp::LodProfile::tiles}, {"collision", bp::LodProfile::collision}},
      o.profile,
      "gltf: a GLB a level, and one with all (MSFT_lod); 3dtiles: a tileset of compressed GLB, coarse root; collision: "
      "one level, named for Godot, Unreal and Unity");
  args.option("--mode", {{"bounding", bp::MeshMode::bounding}, {"fit", bp::MeshMode::fit}}, o.mode,
              "around the scene; or as near to it as can be, enclosing nothing");
  args.option("--name", "NAME", o.name, "first part of the names of files and nodes (default: the first scene's)");
  args.option("--levels", "N", o.request.levels, "number of levels (default: as many as are listed, or 4)");
  args.option(
      "--faces", "N[,N...]", [&o](const std::string& text) { o.request.faces = bp::parse_faces(text); },
      "triangles of each level, finest first; one number: each further level has a quarter");
  args.option(
      "--error", "LENGTH[,...]", [&o](const std::string& text) { o.request.errors = bp::parse_errors(text); },
      "largest distance between scene and level, finest first; one: each further level has twice that");
  args.option(
      "--screen", "PIXELS[,...]", [&o](const std::string& text) { o.request.pixels = bp::parse_pixels(text); },
      "size on screen, of the scene's diagonal, up to which a level's error is a pixel; one: then half of that");
  args.option("--voxel", "LENGTH", o.voxel,
              "edge of a voxel of the finest level: scene units, or 0.5% of the diagonal");
  args.option("--resolution", "N", o.resolution,
              "voxels along the longest side (default: 256, or 8 voxels to the error)");
  args.option("-s,--scale", "LENGTH", o.request.scale,
              "closing radius of the finest level; it doubles from level to level (default: by the target)");
  args.option("--element", {{"cube", bp::StructuringElement::cube}, {"ball", bp::StructuringElement::ball}}, o.element,
              "of the dilation; cube: large flat areas survive");
  args.option("--enclose", {{"input", bp::Enclose::input}, {"closing", bp::Enclose::closing}}, o.enclose,
              "what stays inside while a level is tightened: the voxels of the scene, or their closing");
  args.option(
      "--fill", {{"flood", bp::FillMode::flood}, {"winding", bp::FillMode::winding}, {"none", bp::FillMode::none}},
      o.fill, "inside: what the outside cannot reach; where the winding number is not 0 (keeps cavities); nothing");
  args.option("--up", {{"y", bp::UpAxis::y}, {"z", bp::UpAxis::z}}, o.up, "axis of the scene that points up");
  args.option("--format", "NAME", o.format,
              "format of stdin, or of files whose names do not tell: ply stl obj off glb ...");
  args.flag("--no-tighten", o.loose, "leave out the step that lowers the volume");
  o.common.add_to(args);
  args.example("bplod plant.glb --faces 20000,5000,1000 --profile 3dtiles -o plant-tiles");
  args.parse();
  check_options(o);
  return o;
}

/// As in bpvox while it voxelizes, then between shelves and the tiles at work.
struct Budget : bp::VoxelizeBudget {
  using VoxelizeBudget::VoxelizeBudget;
  /// For the closing: the triangles have gone.
  [[nodiscard]] std::uint64_t closing_tiles() const { return waiting - shelf; }
};

bp::OptionText option_text(const Options& o, const bp::LodTarget& target, const bp::LodLevel& level, std::size_t i) {
  bp::OptionText text;
  text.add("level", i).add("mode", o.mode == bp::MeshMode::fit ? "fit" : "bounding");
  if (target.faces > 0) text.add("faces", target.faces);
  if (target.error_world > 0) text.add("error", target.error_world);
  text.add("scale", level.scale_world)
      .add("voxel", level.mesh.frame.voxel)
      .add("element", o.element == bp::StructuringElement::cube ? "cube" : "ball")
      .add("enclose", o.enclose == bp::Enclose::input ? "input" : "closing")
      .add("fill", o.fill == bp::FillMode::flood     ? "flood"
                   : o.fill == bp::FillMode::winding ? "winding"
                                                     : "none")
      .add("up", o.up == bp::UpAxis::y ? "y" : "z")
      .add("tighten", !o.loose);
  return text;
}

using StageProgress = std::function<void(const char* stage, const char* unit, std::uint64_t done, std::uint64_t total)>;

struct Voxelized {
  bp::StreamHeader header;
  std::unique_ptr<bp::BrickShelf> solid;
  bp::VoxelizeCounts counts;
};

Voxelized voxelize(const Options& o, const Budget& budget, const bp::ShelfFactory& make_shelf, bp::Backends& backends,
                   const StageProgress& progress) {
  bp::VoxelizeOptions v;
  v.voxel_size = [&o](const bp::Bounds3d& bounds) {
    if (o.voxel) return o.voxel->in_world(bounds.diagonal(), 0);
    const double error = bp::finest_error(o.request, bounds.diagonal());
    if (error > 0 && !o.resolution) return error / kVoxelsPerError;
    return bp::voxel_size_of(bounds, o.resolution.value_or(kDefaultResolution));
  };
  v.fill = o.fill;
  v.up = o.up;
  v.memory_bytes = budget.waiting;
  v.tile_memory_bytes = budget.tiles;
  v.make_shelf = make_shelf;
  v.make_store = [&o, &budget] { return bp::make_chunk_store(budget.store, o.common.temp); };
  v.progress = progress;
  Voxelized out;
  out.solid = make_shelf();
  bp::ShelfSink sink(out.solid.get());
  const auto source = bp::open_scenes(o.scenes, {o.format, budget.reader, o.common.temp});
  const auto open = [&](const bp::StreamHeader& header, const bp::VoxelizeCounts&) -> bp::BrickSink& {
    out.header = header;
    return sink;
  };
  out.counts = bp::voxelize_stream(*source, open, backends, v);
  return out;
}

/// What a fit is drawn to; nothing if it does not fit in memory.
std::vector<bp::TriangleD> scene_triangles(const Options& o, const Budget& budget) {
  constexpr std::uint64_t kBytesEach = 400;  // twice, and a hierarchy over them
  std::vector<bp::TriangleD> all;
  if (std::count(o.scenes.begin(), o.scenes.end(), "-") > 0) return all;  // stdin cannot be read again
  const auto source = bp::open_scenes(o.scenes, {o.format, budget.reader, o.common.temp});
  for (std::vector<bp::TriangleD> chunk; source->read(chunk);) {
    all.insert(all.end(), chunk.begin(), chunk.end());
    if (all.size() * kBytesEach > budget.closing_tiles()) return {};
  }
  return all;
}

bp::LodOptions lod_options(const Options& o, const Budget& budget, const bp::ShelfFactory& make_shelf,
                           const StageProgress& progress) {
  bp::LodOptions lod;
  lod.closing.element = o.element;
  lod.mode = o.mode;
  if (o.mode == bp::MeshMode::fit) lod.scene = scene_triangles(o, budget);
  lod.enclose = o.enclose;
  lod.tighten = !o.loose;
  lod.memory_bytes = budget.closing_tiles();
  lod.make_shelf = make_shelf;
  lod.progress = progress;
  return lod;
}

bp::Json json_of(const bp::LodLevel& level, const std::string& file, std::uint64_t bytes) {
  const bp::LevelCounts& mesh = level.counts.levels.front();
  return {{"file", file},
          {"bytes", bytes},
          {"faces", level.mesh.triangles.size()},
          {"error", level.error_world},
          {"scale", level.scale_world},
          {"voxel", level.mesh.frame.voxel},
          {"attempts", level.attempts},
          {"volume", mesh.measures.volume},
          {"voxels", level.counts.voxels},
          {"faces_dense", mesh.simplify.faces_in},
          {"stopped_by", mesh.stopped_by}};
}

void fill_report(bp::Report& report, const Options& o, const Voxelized& scene, const std::vector<bp::LodLevel>& levels,
                 const bp::OutputFolder& out) {
  report.options = {{"profile", name_of(o.profile)}, {"levels", levels.size()}, {"memory", o.common.memory_bytes}};
  report.counts = {{"triangles", scene.counts.scene.triangles},   {"degenerate", scene.counts.scene.degenerate},
                   {"non_finite", scene.counts.scene.non_finite}, {"bad_faces", scene.counts.scene.bad_faces},
                   {"voxel", scene.header.frame.voxel},           {"solid_voxels", scene.counts.solid_voxels}};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::string file = file_of(o, i);
    report.counts["levels"].push_back(json_of(levels[i], file, out.bytes(file)));
  }
  report.bytes_out = out.bytes();
}

/// What a person wants to know at once, as lines of text on stdout: file, faces, error, scale, bytes.
std::string listing(const Options& o, const std::vector<bp::LodLevel>& levels, const bp::OutputFolder& out) {
  std::string text = "file\tfaces\terror\tscale\tvoxel\tbytes\n";
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::string file = file_of(o, i);
    text += fmt::format("{}\t{}\t{:.4g}\t{:.4g}\t{:.4g}\t{}\n", file, levels[i].mesh.triangles.size(),
                        levels[i].error_world, levels[i].scale_world, levels[i].mesh.frame.voxel, out.bytes(file));
  }
  return text;
}

void note(bp::Report& report, const Options& o, const std::string& text) {
  report.notes.push_back(text);
  if (o.common.progress != bp::ProgressMode::quiet) std::fprintf(stderr, "bplod: note: %s\n", text.c_str());
}

void note_shortfall(bp::Report& report, const Options& o, const bp::LodTarget& target, const bp::LodLevel& level,
                    std::size_t i) {
  if (!level.reached) {
    note(report, o,
         fmt::format("level {}: {} faces instead of {}, even closed at {:.4g}: no further edge can be merged", i,
                     level.mesh.triangles.size(), target.faces, level.scale_world));
  }
  if (target.error_world > 0 && level.error_world > target.error_world) {
    note(report, o,
         fmt::format("level {}: its error is at most {:.4g} instead of {:.4g}: narrow gaps of the scene are closed", i,
                     level.error_world, target.error_world));
  }
}

void run(const Options& o) {
  const Budget budget(o.common.memory_bytes);
  bp::Report report("bplod");
  bp::Progress progress("bplod", o.common.progress);
  bp::OutputFolder out(o.out, bp::profile_files(o.profile, o.name, bp::level_count(o.request)), o.common.overwrite);
  bp::Backends backends = bp::make_backends(o.common, 0);  // reading and meshing take far longer than closing
  const bp::ShelfFactory make_shelf = bp::make_shelf_factory(budget.shelf, o.common.temp);
  const StageProgress show = [&progress, last = std::string()](const char* stage, const char* unit, std::uint64_t done,
                                                               std::uint64_t total) mutable {
    if (last != stage) progress.begin(last = stage, total, unit);
    progress.set(done, total);
  };
  report.stage("voxelize");
  Voxelized scene = voxelize(o, budget, make_shelf, backends, show);

  report.stage("measure the scene");
  const double diagonal = scene.header.bounds.diagonal();
  bp::LodChain chain(scene.header, std::move(scene.solid), backends, lod_options(o, budget, make_shelf, show));
  std::vector<bp::LodLevel> levels;
  for (std::size_t i = 0; i < bp::level_count(o.request); ++i) {
    report.stage(fmt::format("level {}", i));
    const bp::LodTarget target = bp::target_of(o.request, i, diagonal, scene.header.frame.voxel, chain.dense_faces());
    bp::LodLevel level = chain.make(target);
    note_shortfall(report, o, target, level, i);
    if (i > 0) level.error_world = std::max(level.error_world, levels.back().error_world);  // a bound all the same
    level.mesh.provenance = {bp::make_provenance("bplod", option_text(o, target, level, i), scene.counts.input_hash)};
    levels.push_back(std::move(level));
  }
  progress.end();
  report.stage("write");
  bp::write_profile(o.profile, o.name, levels, diagonal, out);
  out.commit();
  std::fputs(listing(o, levels, out).c_str(), stdout);
  fill_report(report, o, scene, levels, out);
  report.write(o.common);
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bplod", argc, argv, parse, run);
}
