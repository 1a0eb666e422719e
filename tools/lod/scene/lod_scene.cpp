#include "tools/lod/scene/lod_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "io/scene/scene_parts.h"
#include "io/store/scratch.h"
#include "io/stream/brick_shelf.h"
#include "lib/core/error.h"
#include "lib/enclosed/enclosed_triangles.h"
#include "lib/exact/predicates.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/geometry/triangle_totals.h"
#include "lib/grid/shelf_stream.h"
#include "lib/levels/cage_voxels.h"
#include "lib/pass/mesh/scene_check.h"
#include "lib/quads/limbs.h"
#include "lib/volume/boundary_runs.h"
#include "tools/lod/choices.h"
#include "tools/lod/proportions.h"
#include "tools/notes/estimate.h"
#include "tools/notes/scale_notes.h"
#include "tools/notes/scene_notes.h"
#include "tools/notes/up_note.h"
#include "tools/run/grounded_source.h"
#include "tools/run/scale_rules.h"

namespace bp {

namespace {

/// Reads the rules of --field. They say how much finer or coarser than a level's own scale a place is.
ScalePlan read_field(Build& build, const VoxelizedScene& voxels) {
  const BuildOptions& o = build.options;
  StreamHeader header = voxels.header;
  header.scene.format = o.voxels.format;
  for (const std::string& name : o.voxels.scenes) {
    if (can_read_again(o)) header.scene.files.push_back({name, std::filesystem::file_size(name)});
  }
  ScalePlan plan = read_rules(o.field, header, build.scene_options(true));
  if (!(plan.field.base > 0))
    fail(ErrorCode::bad_input, "{}: scale field: base is 0; the scales of levels are measured by it", o.field);
  for (const std::string& text : short_length_notes(plan, header.frame.voxel)) build.note(text);
  return plan;
}

void note_scene(Build& build, const LodScene& scene, std::optional<UpAxis> up_told) {
  const BuildOptions& o = build.options;
  const SceneAgain again{o.voxels.scenes, build.scene_options(true)};
  for (const std::string& text : scene_notes(scene.voxels.counts, scene.voxels.header, again)) build.note(text);
  build.note(up_note(scene.size.bounds, o.voxels.tell_up() || up_told));
  if (o.is_tileset()) build.note(place_note(scene.size.bounds, scene.voxels.header.frame.up, build.placed.placement));
  const bool is_occluder = o.profile == LodProfile::occluder;
  const char* const missing =
      is_occluder ? "so nobody knows what is glass: all of the scene is taken for walls" : "and its colours are lost";
  for (const std::string& path : o.voxels.scenes) {
    if (!o.colors() && !is_occluder) break;
    for (const std::string& file : missing_materials(path)) build.note(fmt::format("{}: {}, {}", path, file, missing));
  }
  for (const std::string& text : option_notes(o, scene.size, scene.voxels.header)) build.note(text);
}

/// Opens the scene with the colours and images that the options want, for which it makes the scene's table.
std::unique_ptr<TriangleSource> open_with_looks(const Build& build, LodScene& scene) {
  SceneOptions how = build.scene_options();
  how.colors = build.options.colors();
  if (build.options.may_have_textures()) how.textures = scene.textures = std::make_shared<TextureTable>();
  return build.open_scene(how);
}

/// Returns whether levels get textures. `tell`: if they are missing, a note says why.
bool choose_textures(Build& build, const TriangleSource& source, const LodScene& scene, bool tell) {
  if (!scene.textures) return false;
  const BuildOptions& o = build.options;
  const bool from_colors = o.full() || (o.appearance == Appearance::texture && scene.colored);
  const bool wanted = source.has_textures() || from_colors;
  const bool textured = wanted && can_read_again(o) && (from_colors || scene.textures->has_images());
  if (!tell) return textured;
  for (const std::string& fault : scene.textures->faults()) build.note(fault);
  if (wanted && !textured)
    build.note(can_read_again(o)
                   ? no_image_note(scene.textures->image_faults())
                   : "a scene from a pipe cannot be read again: its textures are lost; give it as a file");
  return textured;
}

/// Reads the scene's colours into cells. The triangles that voxelization kept are freed by now, and so is most of their
/// memory.
std::unique_ptr<SceneColors> gathered_colors(Build& build, TriangleSource& source, const VoxelizedScene& scene) {
  build.report.begin("colours");
  PassContext context = build.context();
  context.memory.bytes /= 2;
  context.make_scratch = [&] { return make_scratch(build.budget.reader / 2, build.options.common.temp); };
  return gather_colors(source, scene.header.frame, *scene.solid, context);
}

/// Reads the scene's triangles again. Returns none if the scene comes from a pipe, or if a fit has too many.
std::vector<TriangleD> scene_triangles(const Build& build, std::uint64_t triangles) {
  // Independent of the memory, which must not decide what is made.
  constexpr std::uint64_t kMost = std::uint64_t(1) << 21;
  const BuildOptions& o = build.options;
  const bool fit = o.proxy.mode == MeshMode::fit;
  std::vector<TriangleD> all;
  if (std::count(o.voxels.scenes.begin(), o.voxels.scenes.end(), "-") > 0) return all;  // stdin cannot be read again
  if (fit && triangles > kMost) return all;
  // Bounding levels hold them here and in EnclosedTriangles, or here and in the tree that measures distances.
  const std::uint64_t others = std::max(EnclosedTriangles::kBytesEach, TriangleBvh::bytes_needed(1));
  const std::uint64_t bytes = triangles * (fit ? kBytesOfFit : sizeof(TriangleD) + others);
  const MemoryShare& work = build.budget.work;
  const MemoryShare memory{work.bytes / (fit ? 2 : 1), work.share / (fit ? 2 : 1), work.limit};
  if (bytes > memory.bytes)
    throw NeedsMemory(fmt::format("{} {} triangles", fit ? "fitting to" : "enclosing", triangles), bytes, memory.bytes,
                      memory.limit_with(bytes - memory.bytes), fit ? Remedies{} : Remedies{Remedy::enclose_input});
  all.reserve(triangles);
  const auto source = build.open_scene(build.scene_options(true));
  for (std::vector<TriangleD> chunk; all.size() <= triangles && source->read(chunk);)
    all.insert(all.end(), chunk.begin(), chunk.end());
  if (all.size() != triangles)
    fail(ErrorCode::bad_input, "{}: has changed while it was at work; run it again", source->name());
  if (fit) std::erase_if(all, [](const TriangleD& t) { return collinear(t[0], t[1], t[2]); });
  return all;
}

/// Returns the target of the finest level in one mesh, after `cut` others. Each level has about a quarter of the faces
/// of the solid before.
LodTarget first_target(const BuildOptions& o, const LodScene& scene, std::size_t cut) {
  const StreamHeader& header = scene.voxels.header;
  const LevelRequest request = request_for(o, scene.size.triangles, header.bounds.diagonal(), header.frame.voxel);
  const bool by_voxels = !asks_for_faces(request) && request.errors_world.empty();
  const std::uint64_t dense_faces = by_voxels ? 2 * boundary_size(*scene.voxels.solid).faces >> (2 * cut) : 0;
  return level_target(request, cut, cut, dense_faces);
}

}  // namespace

VoxelizeOptions voxelize_options(const Build& build, const ReadOptions& read) {
  VoxelizeOptions v;
  v.cell_vox = read.cell_vox;
  v.fill = build.options.voxels.fill;
  v.up = build.options.voxels.up;
  v.context = build.context(read.results);
  v.context.memory.bytes = build.budget.waiting;
  v.context.make_scratch = [&] { return make_scratch(build.budget.store, build.options.common.temp); };
  v.tile_memory_bytes = build.budget.tiles;
  return v;
}

LodScene read_scene(Build& build, const ReadOptions& read) {
  const BuildOptions& o = build.options;
  build.place();
  build.report.begin("voxelize");
  LodScene scene;
  auto source = open_with_looks(build, scene);
  if (read.ground) source = std::make_unique<GroundedSource>(std::move(source), o.voxels.up);
  VoxelizeOptions v = voxelize_options(build, read);
  v.voxel_size = [&](const Bounds3d& bounds) {  // is called when the scene has been read
    const SceneSize size{bounds, source->counts().triangles};
    if (!read.ground) question_proportions(o, size);
    const double diagonal = bounds.diagonal();
    return chosen_voxel(voxel_request(o, diagonal), request_for(o, size.triangles, diagonal), size);
  };
  VoxelizedScene& voxels = scene.voxels;
  voxels.solid = build.make_shelf();
  ShelfSink sink(voxels.solid.get());
  const auto open = [&](const StreamHeader& header, const VoxelizeCounts& counts) -> BrickSink& {
    voxels.header = header;
    voxels.header.scene.triangles = counts.scene.triangles;
    if (read.tells_time)
      note_estimate(estimate_build(o, header.bounds, counts, header.frame.voxel), o.common, build.progress,
                    build.report);
    return sink;
  };
  voxels.counts = voxelize_stream(*source, open, v);
  const SceneCounts& counts = voxels.counts.scene;
  scene.size = {voxels.header.bounds, counts.triangles, counts.kept_degenerate};
  scene.enclosed = enclosed_by(o, counts.triangles);
  if (!o.field.empty() && !read.ground) scene.field = read_field(build, voxels);
  if (!read.ground) note_scene(build, scene, source->up());
  scene.colored = source->has_colors();
  scene.textured = choose_textures(build, *source, scene, !read.ground);
  if (scene.colored && !scene.textured) scene.colors = gathered_colors(build, *source, voxels);
  return scene;
}

LodScene measure_scene(Build& build) {
  const BuildOptions& o = build.options;
  build.place();
  build.report.begin("read");
  LodScene scene;
  const auto source = open_with_looks(build, scene);
  StreamHeader& header = scene.voxels.header;
  header.bounds = bounds_of(*source);
  if (header.bounds.empty()) fail(ErrorCode::bad_input, "{}: no triangles; a scene needs at least one", source->name());
  header.frame.up = o.voxels.up.value_or(source->up().value_or(UpAxis::y));
  header.fill = FillMode::none;
  const SceneCounts& counts = scene.voxels.counts.scene = source->counts();
  scene.size = {header.bounds, counts.triangles, counts.kept_degenerate};
  question_proportions(o, scene.size);
  note_scene(build, scene, source->up());
  scene.colored = source->has_colors();
  scene.textured = choose_textures(build, *source, scene, true);
  return scene;
}

CageRoom make_room(Build& build, LodScene& scene) {
  const BuildOptions& o = build.options;
  CageRoom room;
  room.voxel = scene.voxels.header.frame.voxel;
  room.margin_world = margin_of(o, scene.size.bounds.diagonal(), room.voxel);
  switch (o.symmetry) {
    case Symmetry::off:
      break;
    case Symmetry::automatic:
      room.plane = symmetry_of(scene.voxels, build.context());
      if (room.plane)
        build.note(fmt::format("symmetric across {}, as the scene is", name_of(Symmetry(room.plane->axis))));
      break;
    default:
      room.plane = middle_plane(scene.voxels.header, int(o.symmetry));
  }
  if (room.plane) add_image(scene.voxels, *room.plane, build.make_shelf);
  std::unique_ptr<BrickShelf> model;
  if (room.margin_world > 0) model = add_margin(scene.voxels, room.margin_world, build.context());
  room.limbs = std::make_shared<Limbs>(model ? *model : *scene.voxels.solid, *scene.voxels.solid);
  return room;
}

LodOptions lod_options(const Build& build, const LodScene& scene, const CageRoom& room, double share, std::size_t cut) {
  const BuildOptions& o = build.options;
  LodOptions lod;
  lod.closing.element = o.closing.element;
  lod.mode = o.proxy.mode;
  lod.enclose = scene.enclosed;
  lod.rounding = scene.voxels.counts.scene.rounding;
  lod.context = build.context(nullptr, share);
  lod.context.progress = refused_with_outputs(std::move(lod.context.progress));
  if (scene.voxels.solid != nullptr) lod.first = first_target(o, scene, cut);
  lod.field = scene.field;
  if (o.is_cage()) lod.cage = CageParams{room.plane, room.limbs};
  return lod;
}

void take_triangles(const Build& build, const LodScene& scene, LodOptions& lod) {
  if (lod.mode == MeshMode::fit || lod.enclose == Enclose::scene)
    lod.scene = scene_triangles(build, scene.size.triangles);
  const bool encloses = lod.mode == MeshMode::bounding && lod.enclose == Enclose::scene;
  if (encloses && scene.voxels.solid != nullptr) {  // else an earlier chain took the voxels, after this test
    require_within(lod.scene, lod.rounding, scene.voxels.header.frame, *scene.voxels.solid);
    lod.is_within = true;
  }
}

std::uint64_t levels_limit(const LodScene& scene, const LodOptions& lod) {
  BrickShelf* const solid = scene.voxels.solid.get();
  return solid == nullptr ? 0 : chain_limit(scene.voxels.header, *solid, lod, lod.context, scene.size.triangles);
}

LodOptions complete_options(const Build& build, const LodScene& scene, const CageRoom& room) {
  LodOptions lod = lod_options(build, scene, room);
  naming_limit([&] { take_triangles(build, scene, lod); }, [&] { return levels_limit(scene, lod); });
  return lod;
}

}  // namespace bp
