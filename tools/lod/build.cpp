#include "tools/lod/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "io/files/file.h"
#include "io/scene/scene_parts.h"
#include "io/scene/scene_reader.h"
#include "io/store/scratch.h"
#include "io/stream/brick_shelf.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/enclosed/enclosed_triangles.h"
#include "lib/exact/predicates.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/grid/shelf_stream.h"
#include "lib/levels/margin.h"
#include "lib/levels/symmetry.h"
#include "lib/pass/color/vertex_colors.h"
#include "tools/cli/names.h"
#include "tools/lod/bake_levels.h"
#include "tools/lod/choices.h"
#include "tools/lod/proportions.h"
#include "tools/notes/scale_notes.h"
#include "tools/notes/scene_notes.h"
#include "tools/notes/up_note.h"
#include "tools/run/grounded_source.h"
#include "tools/run/scale_rules.h"
#include "tools/run/scene_budget.h"

namespace bp {

namespace {

/// What was made stays if it cannot be told: it took far longer than to free the space.
void print_list(const std::string& text, const std::string& made) {
  try {
    print(text);
  } catch (const Error& e) {
    fail_as(e, "the list is lost, but {}: {}", made, e.what());
  }
}

/// The file that stands for all levels, or this one.
std::string name_of_all(const BuildOptions& o, const std::string& file) {
  if (o.is_tileset()) return "tileset.json";
  return o.profile == LodProfile::gltf && !o.obj ? o.name + ".glb" : file;
}

}  // namespace

Build::Build(const BuildOptions& o)
    : options(o),
      progress("bplod", o.common.progress),
      backends(make_backends(o.common, 0)),  // reading and meshing take far longer than closing
      budget(o.common.memory_bytes, std::min(pinned_bytes(backends), o.common.memory_bytes / 2)),
      make_shelf(make_shelf_factory(budget.shelf, o.common.temp)),
      show(progress.for_pass()) {}

SceneOptions Build::scene_options(bool beside) const {
  SceneOptions scene{options.voxels.format, budget.reader, options.common.temp};
  scene.surface = options.full() || options.leaves;
  scene.walls_only = options.profile == LodProfile::occluder, scene.keep_degenerate = true;
  scene.document = document_budget(unpinned(options.common.memory_bytes, pinned_bytes(backends)), kVoxelProgram,
                                   beside ? 2 : options.voxels.scenes.size(), may_read_again(options));
  return scene;
}

VoxelizedScene Build::voxelize(std::int32_t cell_vox, ResultStore* results, bool ground) {
  report.begin("voxelize");
  VoxelizeOptions v;
  v.cell_vox = cell_vox;
  v.fill = options.voxels.fill;
  v.up = options.voxels.up;
  v.context = context(results);
  v.context.memory.bytes = budget.waiting;
  v.context.make_scratch = [this] { return make_scratch(budget.store, options.common.temp); };
  v.tile_memory_bytes = budget.tiles;
  VoxelizedScene out;
  out.solid = make_shelf();
  ShelfSink sink(out.solid.get());
  SceneOptions scene = scene_options();
  scene.colors = options.colors();
  if (options.may_have_textures()) scene.textures = textures_ = std::make_shared<TextureTable>();
  auto source = open_scenes(options.voxels.scenes, scene);
  if (ground) source = std::make_unique<GroundedSource>(std::move(source), options.voxels.up);
  v.voxel_size = [&](const Bounds3d& bounds) {  // asked for when the scene has been read
    const SceneSize size{bounds, source->counts().triangles};
    if (!ground) question_proportions(options, size);
    const double diagonal = bounds.diagonal();
    return chosen_voxel(voxel_request(options, diagonal), request_for(options, size.triangles, diagonal), size);
  };
  const auto open = [&](const StreamHeader& header, const VoxelizeCounts& counts) -> BrickSink& {
    out.header = header;
    out.header.scene.triangles = counts.scene.triangles;
    tell_time(header, counts, ground);
    return sink;
  };
  out.counts = voxelize_stream(*source, open, backends, v);
  size_ = {out.header.bounds, out.counts.scene.triangles, out.counts.scene.kept_degenerate};
  enclosed_ = enclosed_by(options, size_.triangles);
  if (!options.field.empty()) field_ = read_field(out, !scene_met_);
  if (!scene_met_ && !ground) note_scene(out, source->up());
  choose_textures(*source, !std::exchange(scene_met_, true));
  if (colored_ && !textured_) gather(*source, out);
  return out;
}

/// An occluder takes up to 11 times as long as anything known here would tell: nothing is said of it.
void Build::tell_time(const StreamHeader& header, const VoxelizeCounts& counts, bool again) {
  if (again || !tells_time || options.profile == LodProfile::occluder) return;
  note_estimate(estimate_build(options, header.bounds, counts, header.frame.voxel), options.common, progress, report);
}

/// Levels have scales of their own: the rules say how much finer or coarser a place is.
ScalePlan Build::read_field(const VoxelizedScene& voxels, bool tell) {
  StreamHeader header = voxels.header;
  header.scene.format = options.voxels.format;
  for (const std::string& name : options.voxels.scenes) {
    if (can_read_again(options)) header.scene.files.push_back({name, std::filesystem::file_size(name)});
  }
  ScalePlan plan = read_rules(options.field, header, scene_options(true));
  if (!(plan.field.base > 0))
    fail(ErrorCode::bad_input, "{}: scale field: base is 0; the scales of levels are measured by it", options.field);
  if (tell) {
    for (const std::string& text : short_length_notes(plan, header.frame.voxel)) note(text);
  }
  return plan;
}

void Build::make_room(VoxelizedScene& scene) {
  voxel_ = scene.header.frame.voxel;
  margin_ = margin_of(options, size_.bounds.diagonal(), voxel_);
  switch (options.symmetry) {
    case Symmetry::off:
      break;
    case Symmetry::automatic:
      plane_ = symmetry_of(scene, context());
      if (plane_) note(fmt::format("symmetric across {}, as the scene is", name_of(Symmetry(plane_->axis))));
      break;
    default:
      plane_ = middle_plane(scene.header, int(options.symmetry));
  }
  if (plane_) add_image(scene, *plane_, make_shelf);
  if (margin_ > 0) add_margin(scene, margin_, context());
}

void Build::note_scene(const VoxelizedScene& scene, std::optional<UpAxis> up_told) {
  for (const std::string& text : scene_notes(scene.counts, scene.header, {options.voxels.scenes, scene_options(true)}))
    note(text);
  note(up_note(size_.bounds, options.voxels.tell_up() || up_told));
  const char* const missing = options.profile == LodProfile::occluder
                                  ? "so nobody knows what is glass: all of the scene is taken for walls"
                                  : "and its colours are lost";
  for (const std::string& path : options.voxels.scenes) {
    if (!options.colors() && options.profile != LodProfile::occluder) break;
    for (const std::string& file : missing_materials(path))
      note(fmt::format("{}: {} is not there, {}", path, file, missing));
  }
  for (const std::string& text : option_notes(options, size_, scene.header)) note(text);
}

void Build::choose_textures(const TriangleSource& source, bool tell) {
  colored_ = source.has_colors();
  if (!textures_) return;
  const bool from_colors = options.full() || (options.appearance == Appearance::texture && colored_);
  const bool wanted = source.has_textures() || from_colors;
  textured_ = wanted && can_read_again(options) && (from_colors || textures_->has_images());
  if (!tell) return;
  for (const std::string& fault : textures_->faults()) note(fault);
  if (!wanted || textured_) return;
  note(can_read_again(options) ? no_image_note(textures_->image_faults())
                               : "a scene from a pipe cannot be read again: its textures are lost; give it as a file");
}

/// The triangles have gone, and so has most of what they were given of the memory.
void Build::gather(TriangleSource& source, const VoxelizedScene& scene) {
  report.begin("colours");
  PassContext c = context();
  c.memory.bytes /= 2;
  c.make_scratch = [this] { return make_scratch(budget.reader / 2, options.common.temp); };
  colors_ = gather_colors(source, scene.header.frame, *scene.solid, c);
}

std::vector<TriangleD> Build::scene_triangles() const {
  constexpr std::uint64_t kMost = std::uint64_t(1) << 21;  // whatever the memory: it must not decide what is made
  const bool fit = options.proxy.mode == MeshMode::fit;
  std::vector<TriangleD> all;
  if (std::count(options.voxels.scenes.begin(), options.voxels.scenes.end(), "-") > 0)
    return all;  // stdin cannot be read again
  if (fit && size_.triangles > kMost) return all;
  // Fits: twice, and a hierarchy over them. Else here, and in what is enclosed, or then in what measures distances.
  const std::uint64_t others = std::max(EnclosedTriangles::kBytesEach, TriangleBvh::bytes_needed(1));
  const std::uint64_t bytes = size_.triangles * (fit ? 400 : sizeof(TriangleD) + others);
  const MemoryShare memory{budget.work.bytes / (fit ? 2 : 1), budget.work.share / (fit ? 2 : 1), budget.work.limit};
  if (bytes > memory.bytes)
    throw NeedsMemory(fmt::format("{} {} triangles", fit ? "fitting to" : "enclosing", size_.triangles), bytes,
                      memory.bytes, memory.limit_with(bytes - memory.bytes),
                      fit ? Remedies{} : Remedies{Remedy::enclose_input});
  all.reserve(size_.triangles);
  const auto source = open_scenes(options.voxels.scenes, scene_options(true));
  for (std::vector<TriangleD> chunk; all.size() <= size_.triangles && source->read(chunk);)
    all.insert(all.end(), chunk.begin(), chunk.end());
  if (all.size() != size_.triangles)
    fail(ErrorCode::bad_input, "{}: has changed while it was at work; run it again", source->name());
  if (fit) std::erase_if(all, [](const TriangleD& t) { return collinear(t[0], t[1], t[2]); });
  return all;
}

LodOptions Build::lod_options() {
  LodOptions lod;
  lod.closing.element = options.closing.element;
  lod.mode = options.proxy.mode;
  lod.enclose = enclosed_;
  if (options.proxy.mode == MeshMode::fit || enclosed_ == Enclose::scene) lod.scene = scene_triangles();
  lod.field = field_;
  if (options.is_cage()) lod.cage = CageParams{plane_};
  lod.context = context();
  return lod;
}

void Build::hold_looks() {
  if (!textured_ && !options.leaves) return;
  report.begin("textures");
  looks_ = read_looks(*this, part_of(budget.work, 0.4));
}

MemoryShare Build::texture_memory() const {
  return part_of(budget.work, 0.1);
}

PassContext Build::context(ResultStore* results) const {
  PassContext context;
  const MemoryShare work = looks_ != nullptr ? part_of(budget.work, 0.5) : budget.work;
  context.memory = work;
  context.make_shelf = make_shelf;
  context.results = results;
  if (options.tiles) context.turn = options.tiles->begin;
  context.progress = show;
  PieceMemory& memory = context.pieces;
  memory.waiting_bytes = work.bytes / 20 * 9;
  memory.work_bytes = work.bytes - memory.waiting_bytes;
  // One for each surface at work, when all that waits in memory is spent.
  memory.make_scratch = [bytes = budget.store / std::uint64_t(thread_count()), temp = options.common.temp] {
    return make_scratch(bytes, temp);
  };
  memory.limit = work.limit;
  memory.waiting_share = work.share * 0.45;
  memory.work_share = work.share * 0.55;
  return context;
}

void Build::complete(LodLevel& level, std::size_t i, const LodTarget& target, const std::string& input_hash) {
  if (margin_ > 0) {
    const double more = farthest_of_margin(margin_, voxel_);
    level.error_world += more;
    level.distance_world += more;
  }
  if (colors_ != nullptr) {
    colors_->prepare(level.mesh.frame);
    color_vertices(level.mesh, colors_->all(level.mesh.frame));
  }
  if (looks() != nullptr)
    level.mesh.texture = level_texture(*this, level.mesh, {level.error_world, target.error_world, level.scale_world},
                                       *looks_, texture_memory());
  OptionText text = option_text(options, enclosed_, target, i, level.scale_world, level.mesh.frame);
  if (colors_ != nullptr) text.add("colors", "auto");
  if (margin_ > 0) text.add("margin", margin_);
  if (plane_) text.add("symmetry", name_of(Symmetry(plane_->axis)));
  if (field_) text.add("field", provenance_text(*field_));
  if (textured_) text.add("appearance", options.full() ? "full" : "texture");
  level.mesh.provenance = {make_provenance("bplod", text, input_hash)};
}

LevelSteps Build::level_steps(std::function<std::string()> input_hash) {
  return {[this](const std::string& name) { report.begin(name); },
          [this, hash = std::move(input_hash)](LodLevel& level, std::size_t number, const LodTarget& target) {
            complete(level, number, target, hash());
          }};
}

void Build::note(const std::string& text) {
  if (!text.empty()) report.note(text, options.common);
}

void Build::note_levels(const std::vector<LevelFacts>& levels, std::size_t first,
                        const std::vector<LeftOut>& left_out) {
  const bool asked = asks_for_faces(request_of(options));
  for (const std::string& text : level_notes(levels, first, asked, size_)) note(text);
  std::string before;
  for (const LeftOut& level : left_out) {
    const std::string text = left_out_note(level, size_.bounds.diagonal());
    if (text != before) note(text);
    before = text;
  }
}

void Build::finish(const VoxelizedScene& scene, const std::vector<LevelRow>& rows, std::uint64_t bytes_out) {
  report.counts["levels"] = Json::array();
  for (const LevelRow& row : rows) report.counts["levels"].push_back(json_of(row));
  report.bytes_out = bytes_out;
  tell(scene, listing(rows), "all files are complete, in " + options.out);
  if (options.common.progress == ProgressMode::quiet) return;
  std::string proof;
  for (const LevelRow& row : rows) {
    if (!proof.empty() && options.profile != LodProfile::collision && !options.obj) break;  // one file stands for all
    const std::string one = proof_command(options, name_of_all(options, row.file), row.more.contains("hulls"), margin_);
    if (!one.empty()) proof += (proof.empty() ? "" : " && ") + one;
  }
  fmt::print(stderr, "bplod: the files are in {}{}{}\n", options.out, proof.empty() ? "" : "; prove it: ", proof);
}

void Build::finish_jobs(const VoxelizedScene& scene, const JobRange& range, std::uint64_t all,
                        const std::vector<FoundJobs>& found) {
  report.counts["jobs"] = {{"begin", range.begin}, {"end", range.end}, {"of", all}};
  for (const FoundJobs& f : found) report.counts["levels"].push_back(json_of(f));
  tell(scene, listing(found), "all results are kept, in " + options.cache);
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
  report.bytes_in = size_of_files(options.voxels.scenes);
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

MadeChain make_chain(Build& build) {
  const BuildOptions& o = build.options;
  VoxelizedScene scene = build.voxelize(0);
  build.scene_parts = parts_of(scene, o, build.budget.work.bytes);
  if (o.is_cage()) build.make_room(scene);
  build.report.begin("measure the scene");
  const StreamHeader& header = scene.header;
  const double diagonal = header.bounds.diagonal();
  LodChain chain(header, std::move(scene.solid), build.backends, build.lod_options());
  const LevelRequest request = request_for(o, scene.counts.scene.triangles, diagonal, header.frame.voxel);
  const ChainRange range{request, 0, level_count(request), diagonal, is_named(voxel_request(o, diagonal))};
  MadeLevels made = make_levels(chain, range, build.level_steps([&] { return scene.counts.input_hash; }));
  return {std::move(scene), std::move(made)};
}

MadeOccluder make_occluder(Build& build) {
  const BuildOptions& o = build.options;
  OccluderSource source;
  source.voxelize = [&](bool ground) { return build.voxelize(0, nullptr, ground); };
  source.request = [&](const StreamHeader& header) {
    return request_of(o, header.bounds.diagonal(), header.frame.voxel);
  };
  source.may_ground = can_read_again(o);
  source.hidden = {0, o.closing.element, build.context()};
  MadeOccluder made = make_occluder(source, build.backends, build.level_steps({}));
  if (made.hidden_voxels > 0) return made;
  fail(ErrorCode::bad_input,
       "the scene hides nothing: it is open, also at a scale of {:.4g}, or thinner than its voxels of {:.4g}; try "
       "another --scale, or smaller voxels",
       made.scale_world, made.scene.header.frame.voxel);
}

}  // namespace bp
