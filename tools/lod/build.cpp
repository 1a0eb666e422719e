#include "tools/lod/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "io/files/file.h"
#include "io/scene/scene_parts.h"
#include "io/scene/scene_reader.h"
#include "io/store/chunk_store.h"
#include "io/stream/brick_shelf.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/enclosed/enclosed_triangles.h"
#include "lib/grid/shelf_stream.h"
#include "lib/pass/color/vertex_colors.h"
#include "tools/cli/names.h"
#include "tools/lod/proportions.h"
#include "tools/notes/face_notes.h"
#include "tools/notes/up_note.h"
#include "tools/run/grounded_source.h"
#include "tools/run/scene_budget.h"

namespace bp {

namespace {

Json json_of(const LevelRow& row) {
  Json json{{"file", row.file},         {"bytes", row.bytes},       {"tiles", row.tiles}, {"faces", row.faces},
            {"error", row.error_world}, {"scale", row.scale_world}, {"voxel", row.voxel}};
  json.update(row.more);
  return json;
}

Json json_of(const FoundJobs& found) {
  return {{"what", found.what}, {"jobs", found.jobs}, {"kept", found.kept}};
}

/// What a person wants to know at once, as lines of text on stdout.
std::string listing(const std::vector<LevelRow>& rows) {
  std::string text = "file\tfaces\terror\tscale\tvoxel\tbytes\n";
  for (const LevelRow& row : rows) {
    const std::string error = std::isnan(row.error_world) ? "-" : fmt::format("{:.4g}", row.error_world);
    text += fmt::format("{}\t{}\t{}\t{:.4g}\t{:.4g}\t{}\n", row.file, row.faces, error, row.scale_world, row.voxel,
                        row.bytes);
  }
  return text;
}

/// What a level that has not its faces missed, and why; empty if it has them. Fewer than nobody asked for are none.
std::string faces_note(const LodLevel& level, const LodTarget& target, bool asked) {
  const std::uint64_t faces = level.mesh.triangles.size();
  if (!level.reached)
    return fmt::format("{} faces instead of {}, even closed at {:.4g}: no further edge can be merged", faces,
                       target.faces, level.scale_world);
  const std::string few = asked ? too_few_note(faces, target.faces) : "";
  if (few.empty() && asked && level.attempts > 1)
    return fmt::format(
        "closed at {:.4g}, {} times the scale that was tried first: at less, parts and holes take more than {} faces",
        level.scale_world, std::uint64_t(1) << (level.attempts - 1), target.faces);
  if (few.empty() || level.attempts == 1) return few;
  return fmt::format("{} faces instead of {}: at half of its scale of {:.4g}, parts and holes take too many", faces,
                     target.faces, level.scale_world);
}

/// What was made stays if it cannot be told: it took far longer than to free the space.
void print_list(const std::string& text, const std::string& made) {
  try {
    print(text);
  } catch (const Error& e) {
    fail(e.code(), "{}; the list is lost, but {}", e.what(), made);
  }
}

}  // namespace

Build::Build(const BuildOptions& o)
    : options(o),
      progress("bplod", o.common.progress),
      backends(make_backends(o.common, 0)),  // reading and meshing take far longer than closing
      budget(o.common.memory_bytes, std::min(pinned_bytes(backends), o.common.memory_bytes / 2)),
      make_shelf(make_shelf_factory(budget.shelf, o.common.temp)) {
  show = [this, last = std::string()](const char* stage, const char* unit, std::uint64_t done,
                                      std::uint64_t total) mutable {
    if (last != stage) progress.begin(last = stage, total, unit);
    progress.set(done, total);
  };
}

SceneOptions Build::scene_options(bool beside) const {
  SceneOptions scene{options.format, budget.reader, options.common.temp};
  scene.walls_only = options.profile == LodProfile::occluder;
  const std::uint64_t pinned = std::min(pinned_bytes(backends), options.common.memory_bytes / 2);
  scene.document = document_budget(options.common.memory_bytes - pinned, std::uint64_t(96) << 20,
                                   beside ? 2 : options.scenes.size());
  return scene;
}

VoxelizedScene Build::voxelize(std::int32_t cell_vox, ResultStore* results, int halvings, bool ground) {
  report.stage("voxelize");
  VoxelizeOptions v;
  v.cell_vox = cell_vox;
  v.fill = options.fill;
  v.up = options.up;
  v.context = context(results);
  v.context.memory.bytes = budget.waiting;
  v.context.make_store = [this] { return make_chunk_store(budget.store, options.common.temp); };
  v.tile_memory_bytes = budget.tiles;
  VoxelizedScene out;
  out.solid = make_shelf();
  ShelfSink sink(out.solid.get());
  SceneOptions scene = scene_options();
  scene.colors = options.colors;
  auto source = open_scenes(options.scenes, scene);
  if (ground) source = std::make_unique<GroundedSource>(std::move(source), options.up);
  v.voxel_size = [&](const Bounds3d& bounds) {  // asked for when the scene has been read
    const SceneSize size{bounds, source->counts().triangles};
    if (halvings == 0) question_proportions(options, size);
    return voxel_size(options, size, halvings);
  };
  const auto open = [&](const StreamHeader& header, const VoxelizeCounts&) -> BrickSink& {
    out.header = header;
    const Estimate estimate = estimate_build(options, header.bounds, header.frame.voxel);
    if (halvings == 0) note_estimate(estimate, options.common, progress, report);
    return sink;
  };
  out.counts = voxelize_stream(*source, open, backends, v);
  triangles_ = out.counts.scene.triangles;
  enclosed_ = enclosed_by(options, triangles_);
  if (halvings == 0 && !ground) {  // the scene is the same
    if (const std::string text = skipped(out.counts.scene); !text.empty()) note("skipped " + text);
    if (const std::string text = up_note(out.header.bounds, options.up || source->up()); !text.empty()) note(text);
    note_missing_materials();
    const SceneSize size{out.header.bounds, out.counts.scene.triangles};
    if (const std::string text = voxel_note(options, size); !text.empty()) note(text);
    if (const std::string text = origin_note(options, out.header); !text.empty()) note(text);
    if (const std::string text = enclose_note(options, triangles_); !text.empty()) note(text);
  }
  if (source->has_colors()) gather(*source, out);
  return out;
}

/// The triangles have gone, and so has most of what they were given of the memory.
void Build::gather(TriangleSource& source, const VoxelizedScene& scene) {
  report.stage("colours");
  PassContext c = context();
  c.memory.bytes /= 2;
  c.make_store = [this] { return make_chunk_store(budget.reader / 2, options.common.temp); };
  colors_ = gather_colors(source, scene.header.frame, *scene.solid, c);
}

std::vector<TriangleD> Build::scene_triangles() const {
  constexpr std::uint64_t kMost = std::uint64_t(1) << 21;  // whatever the memory: it must not decide what is made
  const bool fit = options.mode == MeshMode::fit;
  std::vector<TriangleD> all;
  if (std::count(options.scenes.begin(), options.scenes.end(), "-") > 0) return all;  // stdin cannot be read again
  if (fit && triangles_ > kMost) return all;
  // Fits: twice, and a hierarchy over them. Else here, and in what is enclosed.
  const std::uint64_t bytes = triangles_ * (fit ? 400 : sizeof(TriangleD) + EnclosedTriangles::kBytesEach);
  const MemoryShare memory{budget.work.bytes / (fit ? 2 : 1), budget.work.share / (fit ? 2 : 1), budget.work.limit};
  if (bytes > memory.bytes)
    throw NeedsMemory(fmt::format("{} {} triangles", fit ? "fitting to" : "enclosing", triangles_), bytes, memory.bytes,
                      memory.limit_with(bytes - memory.bytes), fit ? Remedies{} : Remedies{Remedy::enclose_input});
  all.reserve(triangles_);
  const auto source = open_scenes(options.scenes, scene_options(true));
  for (std::vector<TriangleD> chunk; all.size() <= triangles_ && source->read(chunk);)
    all.insert(all.end(), chunk.begin(), chunk.end());
  if (all.size() != triangles_)
    fail(ErrorCode::bad_input, "{}: has changed while it was at work; run it again", source->name());
  return all;
}

LodOptions Build::lod_options() {
  LodOptions lod;
  lod.closing.element = options.element;
  lod.mode = options.mode;
  lod.enclose = enclosed_;
  if (options.mode == MeshMode::fit || enclosed_ == Enclose::scene) lod.scene = scene_triangles();
  lod.tighten = !options.loose;
  lod.context = context();
  return lod;
}

PassContext Build::context(ResultStore* results) const {
  PassContext context;
  context.memory = budget.work;
  context.make_shelf = make_shelf;
  context.results = results;
  context.progress = show;
  PieceMemory& memory = context.pieces;
  memory.waiting_bytes = budget.work.bytes / 20 * 9;
  memory.work_bytes = budget.work.bytes - memory.waiting_bytes;
  // One for each surface at work, when all that waits in memory is spent.
  memory.make_store = [bytes = budget.store / std::uint64_t(thread_count()), temp = options.common.temp] {
    return make_chunk_store(bytes, temp);
  };
  memory.limit = budget.work.limit;
  memory.waiting_share = budget.work.share * 0.45;
  memory.work_share = budget.work.share * 0.55;
  return context;
}

void Build::finish_level(LodLevel& level, std::size_t i, const LodTarget& target, const std::string& input_hash) {
  if (colors_ != nullptr) {
    colors_->prepare(level.mesh.frame);
    color_vertices(level.mesh, colors_->all(level.mesh.frame));
  }
  OptionText text = option_text(options, enclosed_, target, i, level.scale_world, level.mesh.frame);
  if (colors_ != nullptr) text.add("colors", "auto");
  level.mesh.provenance = {make_provenance("bplod", text, input_hash)};
  if (const std::string missed = faces_note(level, target, asks_for_faces(options.request)); !missed.empty())
    note(fmt::format("level {}: {}", i, missed));
  if (target.error_world > 0 && level.error_world > target.error_world) {
    note(error_note(i, level.error_world, target.error_world));
  }
}

std::string error_note(std::size_t level, double error_world, double asked_world) {
  return fmt::format(
      "level {}: its error is at most {:.4g} instead of {:.4g}: its voxels or its scale are too large for less", level,
      error_world, asked_world);
}

std::string origin_note(const BuildOptions& o, const StreamHeader& header) {
  return o.profile == LodProfile::tiles ? "" : origin_note(o.origin, header.frame, header.bounds);
}

std::string voxel_note(const BuildOptions& o, const SceneSize& scene) {
  if (!is_by_scene(o) || scene.triangles <= kTilesetFaces) return "";
  return fmt::format(
      "the scene has {} triangles, and voxels of {:.4g}, which are for {}: for more detail, name a smaller --voxel; "
      "half of it takes some four times as long",
      scene.triangles, voxel_size(o, scene), kTilesetFaces);
}

void Build::note_missing_materials() {
  if (!options.colors) return;
  for (const std::string& scene : options.scenes) {
    for (const std::string& file : missing_materials(scene))
      note(fmt::format("{}: {} is not there, and its colours are lost", scene, file));
  }
}

void Build::note(const std::string& text) {
  report.note(text, options.common);
}

void Build::finish(const VoxelizedScene& scene, const std::vector<LevelRow>& rows, std::uint64_t bytes_out) {
  report.counts["levels"] = Json::array();
  for (const LevelRow& row : rows) report.counts["levels"].push_back(json_of(row));
  report.bytes_out = bytes_out;
  tell(scene, listing(rows), "all files are complete, in " + options.out);
}

void Build::finish_jobs(const VoxelizedScene& scene, const JobRange& range, std::uint64_t all,
                        const std::vector<FoundJobs>& found) {
  std::string text = "jobs\tdone\tkept\n";
  for (const FoundJobs& f : found) text += fmt::format("{}\t{}\t{}\n", f.what, f.jobs, f.kept);
  report.counts["jobs"] = {{"begin", range.begin}, {"end", range.end}, {"of", all}};
  for (const FoundJobs& f : found) report.counts["levels"].push_back(json_of(f));
  tell(scene, text, "all results are kept, in " + options.cache);
}

void Build::tell(const VoxelizedScene& scene, const std::string& list, const std::string& made) {
  try {
    write_report(scene);
  } catch (const Error&) {  // the list may come through
    print_list(list, made);
    throw;
  }
  print_list(list, made);
}

void Build::write_report(const VoxelizedScene& scene) {
  report.options = options_json(options);
  report.bytes_in = size_of_files(options.scenes);
  Json counts = {{"triangles", scene.counts.scene.triangles},
                 {"degenerate", scene.counts.scene.degenerate},
                 {"non_finite", scene.counts.scene.non_finite},
                 {"bad_faces", scene.counts.scene.bad_faces},
                 {"chunks", scene.counts.chunks},
                 {"chunks_kept", scene.counts.chunks_kept},
                 {"voxel", scene.header.frame.voxel},
                 {"solid_voxels", scene.counts.solid_voxels}};
  if (colors_ != nullptr) counts["color_cells"] = colors_->cells();
  counts.update(report.counts);
  report.counts = std::move(counts);
  report.write(options.common);
}

LevelRow row_of(const LodLevel& level, const std::string& file, std::uint64_t bytes) {
  const LevelCounts& mesh = level.counts.levels.front();
  LevelRow row{
      file, 1, level.mesh.triangles.size(), bytes, level.error_world, level.scale_world, level.mesh.frame.voxel};
  row.more = {
      {"attempts", level.attempts},    {"distance", level.distance_world},      {"volume", mesh.measures.volume},
      {"voxels", level.counts.voxels}, {"faces_dense", mesh.simplify.faces_in}, {"stopped_by", mesh.stopped_by}};
  return row;
}

}  // namespace bp
