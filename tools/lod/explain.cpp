#include "tools/lod/explain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/files/file.h"
#include "io/scene/scene_reader.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/geometry/triangle_totals.h"
#include "lib/levels/tile_stage.h"
#include "lib/volume/boundary_runs.h"
#include "lib/volume/reduce.h"
#include "tools/lod/build.h"
#include "tools/lod/lod_targets.h"
#include "tools/lod/proportions.h"
#include "tools/lod/tile_build.h"
#include "tools/lod/tile_plan.h"
#include "tools/notes/up_note.h"

namespace bp {

namespace {

// What is estimated, from plants and scanned models: docs/bplod.1.md says that it is.
constexpr double kBytesPerFace = 4, kBytesPerTile = 2200;  // of compressed GLB; and of a tile's place in the tileset
constexpr double kBytesPerPlainFace = 18;                  // of GLB
constexpr double kScratchPerTriangle = 20;                 // that waits on disk

struct Scene {
  SceneCounts counts;
  Bounds3d bounds;
  double area = 0;
  std::optional<UpAxis> up_told;
  UpAxis up = UpAxis::y;
};

Scene read_scene(const Build& build) {
  const BuildOptions& o = build.options;
  const auto source = open_scenes(o.scenes, build.scene_options());
  TriangleTotals totals;
  for (std::vector<TriangleD> chunk; source->read(chunk);) totals.add(chunk);
  if (totals.triangles == 0) fail(ErrorCode::bad_input, "{}: no triangles; a scene needs at least one", source->name());
  return {source->counts(), totals.bounds, totals.area, source->up(), o.up.value_or(source->up().value_or(UpAxis::y))};
}

/// A line of the plan. Of a level in one mesh, voxel and scale are those that are tried first.
struct PlannedLevel {
  double voxel = 0, scale_world = 0;
  std::int32_t halo_vox = 0;
  std::uint64_t tiles = 1, number = 0, faces = 0;  ///< faces: of all tiles; 0: as few as the error takes
  bool cut = false;
};

/// Triangles of the dense surface of the scene's outside, about: that is not much larger than the bounds' sides,
/// however much there is within.
double dense_faces(const Scene& scene, double voxel) {
  return 2 * kSlantedSteps * std::min(scene.area, area_of(scene.bounds)) / (voxel * voxel);
}

class Plan {
 public:
  Plan(const Build& build, const Scene& scene)
      : build_(build),
        options_(build.options),
        request_(request_for(build.options, scene.counts.triangles)),
        scene_(scene) {
    VoxelizeOptions v;
    v.fill = options_.fill;
    if (is_tileset()) v.cell_vox = options_.tile_vox;
    header_ = solid_header(scene.bounds, voxel_size(options_, {scene.bounds, scene.counts.triangles}), scene.up, v);
    if (is_tileset()) {
      tileset_ = plan_tileset(options_, header_);
      for (const CutLevel& cut : tileset_.cut) add(cut);
      add_whole(tileset_.uncut, tileset_.whole);
    } else {
      add_whole(header_, level_count(request_));
    }
    origin_ = origin_of(options_.origin, header_.frame, header_.bounds);
    if (is_tileset() && (options_.resume || !options_.cache.empty())) kept_ = look_up_tileset(options_);
  }

  [[nodiscard]] const StreamHeader& header() const { return header_; }

  [[nodiscard]] Json json() const {
    const SceneCounts& c = scene_.counts;
    Json plan{{"triangles", c.triangles},
              {"degenerate", c.degenerate},
              {"non_finite", c.non_finite},
              {"bad_faces", c.bad_faces},
              {"min", scene_.bounds.min},
              {"max", scene_.bounds.max},
              {"area", scene_.area},
              {"voxel", header_.frame.voxel},
              {"grid", grid()},
              {"reader_bytes", build_.budget.reader},
              {"waiting_bytes", build_.budget.waiting},
              {"shelf_bytes", build_.budget.shelf},
              {"work_bytes", build_.budget.work.bytes},
              {"devices", names_of(build_.backends)},
              {"threads", thread_count()},
              {"levels", Json::array()},
              {"jobs", jobs()},
              {"file_bytes_about", file_bytes()},
              {"scratch_bytes_about", scratch_bytes()}};
    for (const PlannedLevel& level : levels_) plan["levels"].push_back(json_of(level));
    if (origin_ != Vec3d{}) plan["origin"] = origin_;
    for (const FoundJobs& f : kept_) plan["kept"].push_back({{"what", f.what}, {"jobs", f.jobs}, {"kept", f.kept}});
    return plan;
  }

  [[nodiscard]] std::string text() const {
    const Vec3d &lo = scene_.bounds.min, &hi = scene_.bounds.max;
    std::string out = fmt::format("scene\t{} triangles from {:.6g} {:.6g} {:.6g} to {:.6g} {:.6g} {:.6g}\n",
                                  scene_.counts.triangles, lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]);
    const std::array<std::int32_t, 3> size = grid();
    out += fmt::format("grid\t{} x {} x {} voxels of {:.6g}\n", size[0], size[1], size[2], header_.frame.voxel);
    if (origin_ != Vec3d{}) out += fmt::format("origin\t{}\n", origin_text(origin_));
    out += fmt::format("device\t{}, {} threads\n", fmt::join(names_of(build_.backends), ", "), thread_count());
    const BuildBudget& b = build_.budget;
    out += fmt::format("memory\t{}: reading with {}, {} for what waits; then {} for voxels, {} for surfaces\n",
                       size_text(options_.common.memory_bytes), size_text(b.reader), size_text(b.waiting),
                       size_text(b.shelf), size_text(b.work.bytes));
    out += fmt::format("disk\tabout {} of files, about {} of scratch\n", size_text(file_bytes()),
                       size_text(scratch_bytes()));
    out += "level\tvoxel\tscale\thalo\ttiles\tnumbers\tfaces\n";
    for (std::size_t i = 0; i < levels_.size(); ++i) out += row_of(i);
    for (const FoundJobs& f : kept_) out += fmt::format("kept\t{}: {} of {}\n", f.what, f.kept, f.jobs);
    return out;
  }

 private:
  [[nodiscard]] bool is_tileset() const { return options_.profile == LodProfile::tiles; }
  [[nodiscard]] std::uint64_t jobs() const { return is_tileset() ? tileset_.jobs() : levels_.size(); }

  [[nodiscard]] std::array<std::int32_t, 3> grid() const {
    const VoxelCoord s = voxel_bounds(header_.frame, header_.bounds).size();
    return {s.x, s.y, s.z};
  }

  void add(const CutLevel& cut) {
    PlannedLevel level{cut.frame.voxel, cut.scale_world, cut.halo.total_vox(), cut.cells.count(), cut.number, 0, true};
    if (cut.target.error_world == 0) {
      const auto least = double(level.tiles * TileParams::kLeastFaces);
      level.faces =
          cut.target.faces > 0
              ? cut.target.faces * level.tiles
              : std::uint64_t(std::max(dense_faces(scene_, level.voxel) / TileParams::kDenseFacesPerFace, least));
    }
    levels_.push_back(level);
  }

  /// As LodChain begins.
  void add_whole(const StreamHeader& header, std::size_t count) {
    const VoxelCoord side = voxel_bounds(header.frame, header.bounds).size();
    const LodGround ground{header.frame.voxel, header.bounds.diagonal(),
                           std::uint64_t(dense_faces(scene_, header.frame.voxel)), std::max({side.x, side.y, side.z})};
    const std::size_t since = levels_.size();
    double scale = since > 0 ? TilesetPlan::kScaleVox * header.frame.voxel : 0;
    int reductions = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const LodTarget target =
          target_of(request_, since + i, since, header.bounds.diagonal(), header_.frame.voxel, ground.dense_faces);
      if (i >= request_.faces.size() && i > 0 && target.faces > 0 && target.faces >= levels_.back().faces) continue;
      scale = first_scale(ground, target, scale);
      reductions = reductions_for(ground, target, scale, reductions);
      GridFrame frame = header.frame;
      for (int n = 0; n < reductions; ++n) frame = reduced(frame);
      levels_.push_back({frame.voxel, scale, halo_at(scale, frame).total_vox(), 1,
                         is_tileset() ? tileset_.whole_number() : i, target.faces, false});
    }
  }

  [[nodiscard]] static Json json_of(const PlannedLevel& level) {
    Json json{{"voxel", level.voxel},
              {"scale", level.scale_world},
              {"halo_vox", level.halo_vox},
              {level.cut ? "tiles_at_most" : "tiles", level.tiles},
              {"first_number", level.number}};
    if (level.faces > 0) json["faces_about"] = level.faces;
    return json;
  }

  [[nodiscard]] std::string row_of(std::size_t i) const {
    const PlannedLevel& l = levels_[i];
    const char* about = l.cut ? "" : "about ";
    return fmt::format("{}\t{}{:.4g}\t{}{:.4g}\t{}\t{}\t{}..{}\t{}\n", i, about, l.voxel, about, l.scale_world,
                       l.halo_vox, l.cut ? fmt::format("at most {}", l.tiles) : "1", l.number, l.number + l.tiles,
                       l.faces > 0 ? fmt::format("about {}", l.faces) : "as the error takes");
  }

  [[nodiscard]] std::uint64_t file_bytes() const {
    double sum = 0;
    for (const PlannedLevel& level : levels_) {
      const double faces =
          level.faces > 0 ? double(level.faces) : dense_faces(scene_, level.voxel) / double(kDensePerFace);
      sum +=
          is_tileset() ? kBytesPerFace * faces + kBytesPerTile * double(level.tiles) : 2 * kBytesPerPlainFace * faces;
    }
    return std::uint64_t(sum);
  }

  [[nodiscard]] std::uint64_t scratch_bytes() const {
    const double triangles = double(scene_.counts.triangles);
    return triangles * sizeof(TriangleD) > double(build_.budget.waiting) * 0.6
               ? std::uint64_t(triangles * kScratchPerTriangle)
               : 0;
  }

  const Build& build_;
  const BuildOptions& options_;
  const LodRequest request_;
  const Scene& scene_;
  StreamHeader header_;
  TilesetPlan tileset_;
  Vec3d origin_{};
  std::vector<PlannedLevel> levels_;
  std::vector<FoundJobs> kept_;
};

}  // namespace

void explain(const BuildOptions& options) {
  Build build(options);
  build.report.stage("read");
  const Scene scene = read_scene(build);
  if (const std::string text = up_note(scene.bounds, options.up || scene.up_told); !text.empty()) build.note(text);
  const SceneSize size{scene.bounds, scene.counts.triangles};
  question_proportions(options, size);
  if (const std::string text = voxel_note(options, size); !text.empty()) build.note(text);
  if (const std::string text = cache_note(options); !text.empty()) build.note(text);
  build.report.stage("look up");
  const Plan plan(build, scene);
  if (const std::string text = origin_note(options, plan.header()); !text.empty()) build.note(text);
  build.report.options = options_json(options);
  build.report.bytes_in = size_of_files(options.scenes);
  build.report.counts = plan.json();
  build.report.write(options.common);
  print(plan.text());
}

}  // namespace bp
