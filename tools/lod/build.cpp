#include "tools/lod/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/files/file.h"
#include "io/store/scratch.h"
#include "io/stream/brick_shelf.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "tools/lod/choices.h"
#include "tools/lod/options/parse_options.h"
#include "tools/run/scene_budget.h"

namespace bp {

namespace {

/// Prints the list. If this fails, the files that were made stay, and the error says so: making them took far longer
/// than freeing the space will.
void print_list(const std::string& text, const std::string& made) {
  try {
    print(text);
  } catch (const Error& e) {
    fail_as(e, "the list is lost, but {}: {}", made, e.what());
  }
}

/// Returns the name of the file that holds all levels, if the profile has one; else `file`.
std::string name_of_all(const BuildOptions& o, const std::string& file) {
  if (o.is_tileset()) return "tileset.json";
  return o.profile == LodProfile::gltf && !o.obj ? o.name + ".glb" : file;
}

void write_report(Build& build, const ToldScene& scene) {
  Report& report = build.report;
  report.options = options_json(build.options);
  report.bytes_in = size_of_files(build.options.voxels.scenes);
  const SceneCounts& read = scene.counts.scene;
  Json counts = {{"triangles", read.triangles},   {"degenerate", read.degenerate},
                 {"non_finite", read.non_finite}, {"bad_faces", read.bad_faces},
                 {"chunks", scene.counts.chunks}, {"chunks_kept", scene.counts.chunks_kept},
                 {"voxel", scene.voxel},          {"solid_voxels", scene.counts.solid_voxels}};
  if (scene.color_cells) counts["color_cells"] = *scene.color_cells;
  counts.update(report.counts);
  report.counts = std::move(counts);
  report.write(build.options.common);
}

/// Writes the report, then the list. An error of either says that the files that were `made` are there.
void tell(Build& build, const ToldScene& scene, const std::string& list, const std::string& made) {
  try {
    write_report(build, scene);
  } catch (const Error&) {  // the list may still be printed
    print_list(list, made);
    throw;
  }
  print_list(list, made);
}

}  // namespace

Build::Build(const BuildOptions& o, BuildHost by)
    : options(o),
      progress("bplod", o.common.progress),
      // A GPU is not worth its memory: reading and meshing take far longer than closing.
      backends(make_backends(o.common, 0)),
      budget(o.common.memory_bytes, std::min(pinned_bytes(backends), o.common.memory_bytes / 2)),
      make_shelf(make_shelf_factory(budget.shelf, o.common.temp)),
      host{std::move(by.open), by.show ? std::move(by.show) : progress.for_pass(), by.stop} {}

std::unique_ptr<TriangleSource> Build::open_scene(const SceneOptions& how) const {
  return host.open ? host.open(how) : open_scenes(options.voxels.scenes, how);
}

void Build::place() {
  if (!options.place.crs.empty()) report.begin("place");
  placed = place_scene(options.place, options.voxels.scenes, scene_options());
  for (const std::string& text : placed.notes) note(text);
}

SceneOptions Build::scene_options(bool beside) const {
  SceneOptions scene{options.voxels.format, budget.reader, options.common.temp};
  scene.map = placed.map;
  scene.details = options.leaves || options.proxy.visual;
  scene.surface = options.full() || scene.details;
  scene.walls_only = options.profile == LodProfile::occluder, scene.keep_degenerate = true;
  scene.document =
      document_budget(unpinned(options.common.memory_bytes, pinned_bytes(backends)), kVoxelProgram,
                      beside ? 2 : std::max<std::size_t>(options.voxels.scenes.size(), 1), may_read_again(options));
  return scene;
}

PassContext Build::context(ResultStore* results, double share) const {
  PassContext context;
  const MemoryShare work = share < 1 ? part_of(budget.work, share) : budget.work;
  context.memory = work;
  context.make_shelf = make_shelf;
  context.results = results;
  if (options.tiles) context.turn = options.tiles->begin;
  context.progress = host.show;
  context.stop = host.stop;
  PieceMemory& memory = context.pieces;
  memory.waiting_bytes = work.bytes / 20 * 9;
  memory.work_bytes = work.bytes - memory.waiting_bytes;
  // Each surface at work gets a scratch, which is used when the memory for waiting surfaces is spent.
  memory.make_scratch = [bytes = budget.store / std::uint64_t(thread_count()), temp = options.common.temp] {
    return make_scratch(bytes, temp);
  };
  memory.limit = work.limit;
  memory.waiting_share = work.share * 0.45;
  memory.work_share = work.share * 0.55;
  return context;
}

void Build::note(const std::string& text) {
  if (!text.empty()) report.note(text, options.common);
}

void note_levels(Build& build, const std::vector<LevelFacts>& levels, std::size_t first,
                 const std::vector<LeftOut>& left_out, const SceneSize& scene) {
  const bool asked = asks_for_faces(request_of(build.options));
  for (const std::string& text : level_notes(levels, first, asked, scene)) build.note(text);
  std::string before;
  for (const LeftOut& level : left_out) {
    const std::string text = left_out_note(level, scene.bounds.diagonal());
    if (text != before) build.note(text);
    before = text;
  }
}

void finish(Build& build, const ToldScene& scene, const std::vector<LevelRow>& rows, std::uint64_t bytes_out) {
  const BuildOptions& o = build.options;
  Report& report = build.report;
  report.counts["levels"] = Json::array();
  for (const LevelRow& row : rows) report.counts["levels"].push_back(json_of(row));
  report.bytes_out = bytes_out;
  tell(build, scene, listing(rows), "all files are complete, in " + o.out);
  if (o.common.progress == ProgressMode::quiet) return;
  std::string proof;
  for (const LevelRow& row : rows) {
    if (!proof.empty() && o.profile != LodProfile::collision && !o.obj) break;  // one file stands for all
    const std::string one = proof_command(o, name_of_all(o, row.file), row.more.contains("hulls"), scene.margin_world);
    if (!one.empty()) proof += (proof.empty() ? "" : " && ") + one;
  }
  fmt::print(stderr, "bplod: the files are in {}{}{}\n", o.out, proof.empty() ? "" : "; prove it: ", proof);
}

void finish_jobs(Build& build, const ToldScene& scene, const JobRange& range, std::uint64_t all,
                 const std::vector<FoundJobs>& found) {
  Json& counts = build.report.counts;
  counts["jobs"] = {{"begin", range.begin}, {"end", range.end}, {"of", all}};
  for (const FoundJobs& f : found) counts["levels"].push_back(json_of(f));
  tell(build, scene, listing(found), "all results are kept, in " + build.options.cache);
}

}  // namespace bp
