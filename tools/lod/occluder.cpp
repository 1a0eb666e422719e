#include "tools/lod/occluder.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "lib/closing/closing.h"
#include "lib/core/error.h"
#include "lib/grid/shelf_stream.h"
#include "lib/pass/hide/hidden_stage.h"
#include "lib/pass/mesh/complement.h"
#include "tools/cli/names.h"

namespace bp {

namespace {

constexpr double kAsMuch = 0.95;                                 // of what the best scale hides
constexpr double kGroundGains = 1.25;                            // times what is hidden without
constexpr double kLeastScaleVox = 2;                             // that is tried
constexpr double kMostScale = 1.0 / 16, kMostOpening = 1.0 / 8;  // of the scene's diagonal
constexpr double kLeastPart = 1e-3, kMostLeastPart = 0.3;        // of the largest one, by volume
constexpr double kLittle = 5e-3;                                 // of the volume of the bounds
constexpr std::uint64_t kFaces = 100, kFacesPerPart = 24, kMostFaces = 2400;
constexpr std::uint64_t kFewFacesPerPart = 12;  // of a box; with fewer, parts are left out

/// What a scene hides at a scale.
struct Hidden {
  double scale = 0;
  bool ground = false;
  HiddenVoxels voxels;
  Json tried = Json::array();
};

HiddenOptions hidden_options(const Build& build, double scale) {
  HiddenOptions o;
  o.scale_world = scale;
  o.element = build.options.element;
  o.context = build.context();
  return o;
}

HiddenVoxels hide(Build& build, VoxelizedScene& scene, double scale) {
  return hidden_voxels(scene.header, *scene.solid, build.backends, hidden_options(build, scale));
}

Hidden best_hidden(Build& build, VoxelizedScene& scene, bool ground) {
  const double voxel = scene.header.frame.voxel, diagonal = scene.header.bounds.diagonal();
  Hidden best;
  best.ground = ground;
  if (const std::optional<Length>& asked = build.options.request.scale) {
    best.scale = asked->in_world(diagonal, voxel);
    best.voxels = hide(build, scene, best.scale);
    return best;
  }
  std::vector<std::pair<double, std::uint64_t>> tried;
  std::uint64_t most = 0;
  for (double scale = 0; scale <= diagonal * kMostScale;
       scale = scale == 0 ? (kLeastScaleVox + kBeyondWholeVox) * voxel : scale * std::sqrt(2.0)) {
    best.voxels = {};  // one at a time
    best.voxels = hide(build, scene, scale);
    best.scale = scale;
    tried.emplace_back(scale, best.voxels.count);
    most = std::max(most, best.voxels.count);
    best.tried.push_back({{"scale", scale}, {"hidden", double(best.voxels.count) * std::pow(voxel, 3)}});
  }
  for (const auto& [scale, count] : tried) {
    if (double(count) < kAsMuch * double(most)) continue;
    if (scale != best.scale) best.voxels = hide(build, scene, scale);
    best.scale = scale;
    break;
  }
  return best;
}

/// The mesh within hidden voxels.
class OccluderMesh {
 public:
  OccluderMesh(Build& build, const VoxelizedScene& scene, const Hidden& hidden)
      : build_(build), scene_(scene), hidden_(hidden) {
    if (!build.options.request.faces.empty()) faces_ = build.options.request.faces.front();
  }

  LodLevel run() {
    const double most = scene_.header.bounds.diagonal() * kMostOpening, voxel = scene_.header.frame.voxel;
    for (double scale = 0; scale <= most; scale = scale == 0 ? 2 * voxel : 2 * scale) {
      const bool is_better = attempt(scale);
      if (best_.reached && !is_better) break;
    }
    best_.attempts = attempts_;
    return std::move(best_);
  }
  [[nodiscard]] double opening() const { return opening_; }
  [[nodiscard]] std::uint64_t faces() const { return faces_; }

 private:
  /// Of an opening, with ever fewer parts while they are too many for the faces. Whether one was the best so far.
  bool attempt(double scale) {
    bool any = false;
    for (double least = kLeastPart; least <= kMostLeastPart; least *= std::sqrt(10.0)) {
      LodLevel level;
      if (!mesh_at(scale, least, level)) break;
      const std::uint64_t parts = level.counts.levels.front().measures.shells;
      if (attempts_++ == 0 && faces_ == 0) {
        faces_ = std::min(std::max(kFaces, parts * kFacesPerPart), kMostFaces);
        if (faces_ > kFaces && !mesh_at(scale, least, level)) break;
      }
      level.reached = level.mesh.triangles.size() <= faces_;
      any |= keep_better(std::move(level), scale);
      if (parts * kFewFacesPerPart <= faces_) break;
    }
    return any;
  }

  bool keep_better(LodLevel level, double scale) {
    const auto volume = [](const LodLevel& l) { return l.counts.levels.front().measures.volume; };
    const bool better = best_.mesh.triangles.empty() || (level.reached && !best_.reached) ||
                        (level.reached == best_.reached && volume(level) > volume(best_));
    if (!better) return false;
    best_ = std::move(level);
    opening_ = scale;
    return true;
  }

  /// False if nothing is left of it.
  bool mesh_at(double scale, double least_part, LodLevel& level) {
    StreamHeader header = scene_.header;
    header.bricks = bricks_around(*hidden_.voxels.voxels);
    header.fill = FillMode::inside;
    header.has_closing = scale > 0;
    header.scale.base = scale;
    std::unique_ptr<BrickShelf> opened;
    if (scale > 0) opened = bp::opening(header, *hidden_.voxels.voxels, build_.backends, hidden_options(build_, scale));
    if (scale > 0 && opened == nullptr) return false;
    ShelfSource source(header, *hidden_.voxels.voxels, opened.get(), ShelfSource::Keep::all);
    MeshParams params;
    params.mode = MeshMode::inside;
    params.faces = {faces_ > 0 ? faces_ : kFaces};
    params.enclose = Enclose::input;
    params.tighten = !build_.options.loose;
    params.least_part = least_part;
    try {
      level.mesh = std::move(mesh_stream(source, build_.context(), std::move(params), level.counts).front());
    } catch (const Error& e) {
      if (scale == 0 || e.code() != ErrorCode::bad_input) throw;
      return false;  // too thin to be meshed
    }
    return true;
  }

  Build& build_;
  const VoxelizedScene& scene_;
  const Hidden& hidden_;
  std::uint64_t faces_ = 0;  // 0: not known
  LodLevel best_;
  double opening_ = 0;
  int attempts_ = 0;
};

/// bpcheck makes the voxels again from this (tools/check/hiding_recipe.h).
OptionText option_text(const BuildOptions& o, const GridFrame& frame, const Hidden& hidden, const OccluderMesh& mesh) {
  OptionText text;
  text.add("mode", "inside").add("faces", mesh.faces()).add("openings", hidden.scale);
  text.add("element", name_of(o.element)).add("walls", "opaque").add("ground", hidden.ground);
  text.add("voxel", frame.voxel);
  text.add("grid", fmt::format("{},{},{}", frame.origin[0], frame.origin[1], frame.origin[2]));
  return text.add("opening", mesh.opening()).add("up", name_of(frame.up)).add("tighten", !o.loose);
}

double volume_of(const Bounds3d& b) {
  return (b.max[0] - b.min[0]) * (b.max[1] - b.min[1]) * (b.max[2] - b.min[2]);
}

void say(Build& build, const LodLevel& level, const Hidden& hidden, const StreamHeader& header, std::uint64_t faces) {
  const double share = double(hidden.voxels.count) * std::pow(header.frame.voxel, 3) / volume_of(header.bounds);
  if (share < kLittle)
    build.note(
        fmt::format("the scene hides {:.2g} % of its bounding box only: walls are missing, or wider open than is "
                    "closed; try a larger --scale",
                    100 * share));
  if (hidden.ground) build.note("the scene is open below: it is taken to stand on the ground, and eyes to be above it");
  if (hidden.scale > 0)
    build.note(
        fmt::format("openings narrower than {:.4g} are taken for closed; --scale 0 closes none", 2 * hidden.scale));
  if (level.reached) return;
  build.note(fmt::format("{} faces instead of {}: no further edge can be merged", level.mesh.triangles.size(), faces));
}

}  // namespace

MadeOccluder make_occluder(Build& build) {
  MadeOccluder made;
  made.scene = build.voxelize(0);
  build.report.stage("close openings");
  Hidden hidden = best_hidden(build, made.scene, false);
  if (can_read_again(build.options)) {
    VoxelizedScene grounded = build.voxelize(0, nullptr, 0, true);
    Hidden with = best_hidden(build, grounded, true);
    if (double(with.voxels.count) > kGroundGains * double(hidden.voxels.count)) hidden = std::move(with);
  }
  const GridFrame& frame = made.scene.header.frame;
  if (hidden.voxels.count == 0)
    fail(ErrorCode::bad_input,
         "the scene hides nothing: it is open, also at a scale of {:.4g}, or thinner than its voxels of {:.4g}; try "
         "another --scale, or smaller voxels",
         hidden.scale, frame.voxel);
  build.report.stage("mesh");
  OccluderMesh mesh(build, made.scene, hidden);
  made.level = mesh.run();
  LodLevel& level = made.level;
  level.scale_world = hidden.scale;
  level.error_world = level.distance_world = std::nan("");
  level.mesh.provenance = {
      make_provenance("bplod", option_text(build.options, frame, hidden, mesh), made.scene.counts.input_hash)};
  made.more = {{"scales", hidden.tried},
               {"ground", hidden.ground},
               {"hidden", double(hidden.voxels.count) * std::pow(frame.voxel, 3)},
               {"opening", mesh.opening()},
               {"parts", level.counts.levels.front().measures.shells},
               {"parts_dropped", level.counts.dropped_parts}};
  say(build, level, hidden, made.scene.header, mesh.faces());
  return made;
}

}  // namespace bp
