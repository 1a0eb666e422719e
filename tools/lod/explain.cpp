#include "tools/lod/explain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numeric>
#include <optional>

#include "io/files/file.h"
#include "io/scene/scene_reader.h"
#include "lib/check/counted.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/levels/level_plan.h"
#include "lib/levels/occluder_level.h"
#include "lib/levels/tiles/tile_plan.h"
#include "lib/voxel/fixed_triangle.h"
#include "tools/lod/bake_levels.h"
#include "tools/lod/build.h"
#include "tools/lod/choices.h"
#include "tools/lod/kept_results.h"
#include "tools/lod/options/parse_options.h"
#include "tools/lod/proportions.h"
#include "tools/lod/tile_build.h"
#include "tools/notes/estimate.h"
#include "tools/notes/up_note.h"
#include "tools/run/enclosed_triangles_limit.h"

namespace bp {

namespace {

// The constants of the estimates, measured on plants and scanned models; docs/tilesets.md says that they are estimates.
// A tile's bytes are those without its faces, with its place in the tileset; both are for compressed GLB.
constexpr double kBytesPerFace = 8, kBytesPerTile = 2500;
constexpr double kBytesPerPlainFace = 26;  // of GLB without compression
constexpr double kBytesPerTexel = 1;
// Bytes of a triangle of the scene in leaves; some triangles are cut.
constexpr double kBytesPerLeafTriangle = 20;
// Bytes of each of the scene's triangles that waits on disk.
constexpr double kScratchPerTriangle = 20, kScratchPerTexturedTriangle = 60;

struct Scene {
  VoxelizeCounts counts;  ///< of the triangles alone
  SurfaceMap surface;
  Bounds3d bounds;
  std::optional<UpAxis> up_told;
  UpAxis up = UpAxis::y;
  bool textured = false;
  std::uint64_t image_bytes = 0;  ///< of the scene's image files
};

SurfaceMap surface_of(TriangleSource& scene) {
  struct Item {
    std::vector<TriangleD> triangles;
    std::vector<SurfaceRun> runs;
  };
  SurfaceMap surface;
  pipeline<Item>(
      thread_count() + 2, [&](Item& item) { return scene.read(item.triangles); },
      [](Item& item) { item.runs = surface_runs(item.triangles); }, [&](Item& item) { surface.add(item.runs); });
  return surface;
}

Scene read_scene(const Build& build) {
  const BuildOptions& o = build.options;
  SceneOptions options = build.scene_options();
  if (o.may_have_textures()) {
    options.colors = true;
    options.textures = std::make_shared<TextureTable>();
  }
  const auto source = open_scenes(o.voxels.scenes, options);
  Scene scene;
  scene.surface = surface_of(*source);
  scene.bounds = scene.surface.all().bounds;
  if (scene.bounds.empty()) fail(ErrorCode::bad_input, "{}: no triangles; a scene needs at least one", source->name());
  scene.counts.scene = source->counts();
  scene.counts.area = scene.surface.all().area;
  scene.counts.extent = scene.surface.all().extent;
  scene.up_told = source->up();
  scene.up = o.voxels.up.value_or(source->up().value_or(UpAxis::y));
  if (options.textures) scene.image_bytes = options.textures->file_bytes();
  const bool from_colors = o.appearance == Appearance::texture && source->has_colors();
  scene.textured = options.textures && can_read_again(o) &&
                   (from_colors || (source->has_textures() && options.textures->has_images()));
  return scene;
}

/// The plan of a run.
struct Plan {
  StreamHeader header;
  std::uint64_t jobs = 0;
  /// For a tileset: the number of the job at which each thousandth of the work begins.
  std::vector<std::uint64_t> thousandths;
  std::vector<PlannedLevel> levels;
  Vec3d origin{};
  std::vector<FoundJobs> kept;
  std::vector<double> scales, openings;  ///< the scales that may be tried for an occluder, which has no planned levels
  double leaf_bytes = 0;                 ///< of leaves with their images; 0: there are none
  double file_bytes = 0, scratch_bytes = 0;
  Estimate work;  ///< if no result is kept, and without textures
};

/// Estimates the bytes of all levels and leaves. A level has about 0.7 of its planned faces: 0.8 to 1.2 for bodies, a
/// third and less for scenes with flat sides.
double file_bytes(const Plan& plan, bool tileset, const Scene& scene) {
  double sum = plan.leaf_bytes;
  for (const PlannedLevel& level : plan.levels) {
    constexpr double kTaken = 0.7;
    const double planned = level.faces > 0 ? double(level.faces)
                                           : double(planned_dense_faces(scene.counts.area, scene.bounds, level.voxel)) /
                                                 double(kDensePerFace);
    const double faces = kTaken * planned;
    const double texture = scene.textured ? kBytesPerTexel * planned_texels(faces, scene.bounds, level.scale_world) : 0;
    sum += tileset ? kBytesPerFace * faces + kBytesPerTile * double(level.tiles) + texture
                   : 2 * (kBytesPerPlainFace * faces + texture);
  }
  return sum;
}

/// Returns the numbers of the jobs that cut the work of all jobs into a thousand parts of about the same size.
std::vector<std::uint64_t> thousandths_of(const std::vector<double>& work) {
  const double all = std::accumulate(work.begin(), work.end(), 0.0);
  std::vector<std::uint64_t> cuts;
  double before = 0;
  for (std::size_t i = 0; i < work.size(); before += work[i++]) {
    while (cuts.size() < 1000 && before + work[i] / 2 >= all * double(cuts.size()) / 1000) cuts.push_back(i);
  }
  cuts.resize(1000, work.size());
  return cuts;
}

/// Returns the voxel size as voxelize_stream() will choose it.
double planned_voxel(const BuildOptions& o, const Scene& scene) {
  const double least = kVoxelsPerOff * scene.counts.scene.rounding.of(scene.bounds);
  return std::max(voxel_size(o, {scene.bounds, scene.counts.scene.triangles}), least);
}

Plan plan_of(const Build& build, const Scene& scene) {
  const BuildOptions& o = build.options;
  const bool tileset = o.is_tileset();
  const double diagonal = scene.bounds.diagonal();
  VoxelizeOptions v;
  v.fill = o.voxels.fill;
  if (tileset) v.cell_vox = o.tile_vox;
  Plan plan;
  plan.header = solid_header(scene.bounds, planned_voxel(o, scene), scene.up, v);
  const LevelRequest request = request_for(o, scene.counts.scene.triangles, diagonal, plan.header.frame.voxel);
  if (tileset) {
    const TilesetPlan tiles = plan_tileset(request, Cells{o.tile_vox}, plan.header);
    plan.levels = planned_tileset(tiles, request, plan.header, scene.counts.area);
    plan.jobs = tiles.jobs();
    plan.thousandths = thousandths_of(scene.surface.work(tiles, Cells{o.tile_vox}));
    if (!o.cache.empty()) plan.kept = look_up_tileset(o);
  } else if (o.profile == LodProfile::occluder) {
    plan.scales = request.scale_world ? std::vector<double>{*request.scale_world} : occluder_scales(plan.header);
    plan.openings = occluder_openings(plan.header);
  } else {
    plan.levels = planned_chain(request, plan.header, scene.counts.area, is_named(voxel_request(o, diagonal)));
    plan.jobs = plan.levels.size();
  }
  plan.work = estimate_build(o, plan.header.bounds, scene.counts, plan.header.frame.voxel);
  if (!tileset) plan.origin = origin_of(o.proxy.origin, plan.header.frame, plan.header.bounds);
  const double triangles = double(scene.counts.scene.triangles);
  if (o.leaves)
    plan.leaf_bytes = kBytesPerLeafTriangle * triangles + kBytesPerTile * double(plan.levels.front().tiles) +
                      double(scene.image_bytes);
  plan.file_bytes = file_bytes(plan, tileset, scene);
  if (triangles * sizeof(TriangleD) > double(build.budget.waiting) * 0.6)
    plan.scratch_bytes = triangles * kScratchPerTriangle;
  if ((scene.textured || o.leaves) && triangles * kScratchPerTexturedTriangle > double(build.budget.tiles))
    plan.scratch_bytes += triangles * kScratchPerTexturedTriangle;
  return plan;
}

std::array<std::int32_t, 3> grid_of(const StreamHeader& header) {
  const VoxelCoord s = voxel_bounds(header.frame, header.bounds).size();
  return {s.x, s.y, s.z};
}

Json json_of(const PlannedLevel& level) {
  Json json{{"voxel", level.voxel},
            {"scale", level.scale_world},
            {"halo_vox", level.halo_vox},
            {level.cut ? "tiles_at_most" : "tiles", level.tiles},
            {"first_number", level.number}};
  if (level.faces > 0) json["faces_about"] = level.faces;
  return json;
}

Json json_of(const Build& build, const Scene& scene, const Plan& plan) {
  const SceneCounts& c = scene.counts.scene;
  Json json{{"triangles", c.triangles},
            {"degenerate", c.degenerate},
            {"non_finite", c.non_finite},
            {"bad_faces", c.bad_faces},
            {"min", scene.bounds.min},
            {"max", scene.bounds.max},
            {"area", scene.counts.area},
            {"voxel", plan.header.frame.voxel},
            {"grid", grid_of(plan.header)},
            {"reader_bytes", build.budget.reader},
            {"waiting_bytes", build.budget.waiting},
            {"shelf_bytes", build.budget.shelf},
            {"work_bytes", build.budget.work.bytes},
            {"devices", names_of(build.backends)},
            {"threads", thread_count()},
            {"scratch_bytes_about", std::uint64_t(plan.scratch_bytes)}};
  if (!plan.scales.empty()) {
    json["scales"] = plan.scales, json["openings"] = plan.openings;
  } else {
    json["jobs"] = plan.jobs;
    for (const PlannedLevel& level : plan.levels) json["levels"].push_back(json_of(level));
    json["file_bytes_about"] = std::uint64_t(plan.file_bytes);
    json["seconds_about"] = wall_seconds(plan.work, names_of(build.backends));
    json["peak_bytes_about"] = std::min(std::uint64_t(plan.work.bytes), build.options.common.memory_bytes);
  }
  if (plan.leaf_bytes > 0) json["leaf_bytes_about"] = std::uint64_t(plan.leaf_bytes);
  if (plan.origin != Vec3d{}) json["origin"] = plan.origin;
  for (const FoundJobs& f : plan.kept) json["kept"].push_back(json_of(f));
  if (!plan.thousandths.empty()) json["thousandths"] = plan.thousandths;
  return json;
}

std::string row_of(const PlannedLevel& l, std::size_t i) {
  const char* about = l.cut ? "" : "about ";
  return fmt::format("{}\t{}{:.4g}\t{}{:.4g}\t{}\t{}\t{}..{}\t{}\n", i, about, l.voxel, about, l.scale_world,
                     l.halo_vox, l.cut ? fmt::format("at most {}", l.tiles) : "1", l.number, l.number + l.tiles,
                     l.faces > 0 ? fmt::format("about {}", l.faces) : "as the error takes");
}

/// Returns the lines about an occluder. Time and memory are missing, since they depend on what the scene hides, which
/// is not known yet.
/// Example: "scales    10, from 0 to 0.0911, and again above the ground"
std::string occluder_text(const BuildOptions& o, const Plan& plan) {
  const std::string scales = o.closing.scale
                                 ? fmt::format("{:.4g}", plan.scales.front())
                                 : fmt::format("{}, from 0 to {:.4g}", plan.scales.size(), plan.scales.back());
  std::string out = fmt::format("scales\t{}{}\n", scales,
                                can_read_again(o) ? ", and again above the ground if that may hide more" : "");
  out += fmt::format("openings\t{} at most, from 0 to {:.4g}\n", plan.openings.size(), plan.openings.back());
  if (!o.levels.faces.empty()) return out + fmt::format("faces\t{}\n", o.levels.faces.front());
  return out + fmt::format("faces\t{}, or {} for each part, at most {}\n", kOccluderFaces, kOccluderFacesOfPart,
                           kMostOccluderFaces);
}

/// Returns what levels to look at are chosen from. Only the images of a run tell what looks nearer.
std::string visual_text(const Scene& scene, const Plan& plan) {
  const std::uint64_t triangles = scene.counts.scene.triangles;
  std::string out = "level\tfaces\tfrom\n";
  for (std::size_t i = 0; i < plan.levels.size(); ++i) {
    const std::uint64_t faces = plan.levels[i].faces;
    const bool is_scene = faces >= triangles && triangles <= kMostEnclosedTriangles;
    const char* const from = is_scene ? "the scene itself"
                             : triangles > kMostEnclosedTriangles
                                 ? "a fit"
                                 : "the scene's triangles, or a fit if it looks nearer";
    out += fmt::format("{}\t{}\t{}\n", i, is_scene ? fmt::format("{}", triangles) : fmt::format("at most {}", faces),
                       from);
  }
  return out;
}

std::string text_of(const Build& build, const Scene& scene, const Plan& plan) {
  std::string out = scene_text(scene.counts.scene.triangles, scene.bounds);
  const std::array<std::int32_t, 3> size = grid_of(plan.header);
  out += fmt::format("grid\t{} x {} x {} voxels of {:.6g}\n", size[0], size[1], size[2], plan.header.frame.voxel);
  if (plan.origin != Vec3d{}) out += fmt::format("origin\t{}\n", origin_text(plan.origin));
  out += fmt::format("device\t{}, {}\n", fmt::join(names_of(build.backends), ", "),
                     counted(std::uint64_t(thread_count()), "thread"));
  const BuildBudget& b = build.budget;
  out += fmt::format("memory\t{}: reading with {}, {} for what waits; then {} for voxels, {} for surfaces\n",
                     size_text(build.options.common.memory_bytes), size_text(b.reader), size_text(b.waiting),
                     size_text(b.shelf), size_text(b.work.bytes));
  if (!plan.scales.empty()) return out + occluder_text(build.options, plan);
  out += fmt::format("time\t{}{}\n", work_text(plan.work, build.options.common.memory_bytes, names_of(build.backends)),
                     scene.textured ? "; textures come on top" : "");
  out += fmt::format("disk\tabout {} of files, about {} of scratch\n", size_text(std::uint64_t(plan.file_bytes)),
                     size_text(std::uint64_t(plan.scratch_bytes)));
  if (plan.leaf_bytes > 0)
    out += fmt::format("leaves\tabout {} of the files, {} triangles and more\n",
                       size_text(std::uint64_t(plan.leaf_bytes)), scene.counts.scene.triangles);
  if (build.options.proxy.visual) return out + visual_text(scene, plan);
  out += "level\tvoxel\tscale\thalo\ttiles\tnumbers\tfaces\n";
  for (std::size_t i = 0; i < plan.levels.size(); ++i) out += row_of(plan.levels[i], i);
  for (const FoundJobs& f : plan.kept) out += fmt::format("kept\t{}: {} of {}\n", f.what, f.kept, f.jobs);
  return out;
}

}  // namespace

std::string scene_text(std::uint64_t triangles, const Bounds3d& bounds) {
  const Vec3d &lo = bounds.min, &hi = bounds.max;
  return fmt::format("scene\t{} from {:.6g} {:.6g} {:.6g} to {:.6g} {:.6g} {:.6g}\n", counted(triangles, "triangle"),
                     lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]);
}

void explain(const BuildOptions& options) {
  Build build(options);
  build.place();
  build.report.begin("read");
  const Scene scene = read_scene(build);
  build.note(up_note(scene.bounds, options.voxels.tell_up() || scene.up_told));
  const SceneSize size{scene.bounds, scene.counts.scene.triangles};
  question_proportions(options, size);
  build.note(voxel_note(options, size));
  build.note(cache_note(options));
  build.report.begin("look up");
  const Plan plan = plan_of(build, scene);
  build.note(origin_note(options, plan.header));
  build.report.options = options_json(options);
  build.report.bytes_in = size_of_files(options.voxels.scenes);
  build.report.counts = json_of(build, scene, plan);
  build.report.write(options.common);
  print(text_of(build, scene, plan));
}

}  // namespace bp
