#include "lib/levels/occluder_level.h"

#include <cmath>
#include <utility>

#include "lib/closing/closing.h"
#include "lib/core/error.h"
#include "lib/grid/shelf_stream.h"
#include "lib/levels/detail/convex_voxels.h"
#include "lib/pass/mesh/complement.h"

namespace bp {

namespace {

constexpr double kAsMuch = 0.95;                                 // of what the best scale hides
constexpr double kAll = 0.999;                                   // of what is hidden: no mesh holds more
constexpr double kPromising = 0.9;                               // of the volume of the best mesh, in opened voxels
constexpr double kGroundGains = 1.25;                            // times what is hidden without
constexpr double kLeastTriedVox = 2;                             // that is tried
constexpr double kMostScale = 1.0 / 16, kMostOpening = 1.0 / 8;  // of the scene's diagonal
constexpr double kLeastPart = 1e-3, kMostLeastPart = 0.3;        // of the largest one, by volume
constexpr std::uint64_t kFaces = 100, kFacesOfPart = 24, kMostFaces = 2400;
constexpr std::uint64_t kFewFacesPerPart = kFacesOfBox;  // with fewer, parts are left out

/// What a scene hides at a scale.
struct Hidden {
  double scale = 0;
  bool ground = false;
  bool is_convex = false;  ///< nearly: all scales would hide the same
  HiddenVoxels voxels;
  std::vector<MadeOccluder::Tried> tried;
};

HiddenOptions at_scale(HiddenOptions options, double scale_world) {
  options.scale_world = scale_world;
  return options;
}

double volume_of(const LodLevel& level) {
  return level.counts.levels.front().measures.volume;
}

/// The scales that are tried, from 0.
std::vector<double> tried_scales(const StreamHeader& header) {
  std::vector<double> scales{0};
  const double most = header.bounds.diagonal() * kMostScale;
  for (double s = (kLeastTriedVox + kBeyondWholeVox) * header.frame.voxel; s <= most; s *= std::sqrt(2.0))
    scales.push_back(s);
  return scales;
}

/// What a scene hides, at the scale that is asked for or the best one.
class HiddenSearch {
 public:
  HiddenSearch(const OccluderSource& source, VoxelizedScene& scene, Backends& backends)
      : source_(source), scene_(scene), backends_(backends), options_(source.hidden) {
    options_.context.progress = {};  // of each closing
  }

  /// `done`: tries before this search, of `total`.
  Hidden run(std::size_t done, std::size_t total) {
    if (const std::optional<double> asked = source_.request(scene_.header).scale_world) {
      Hidden one;
      one.scale = *asked;
      one.voxels = hidden_voxels(scene_.header, *scene_.solid, backends_, at_scale(source_.hidden, one.scale));
      return one;
    }
    enclosed_ = enclosed_voxels(scene_.header, *scene_.solid, backends_, options_);
    Hidden best = at(0);
    const std::uint64_t open = best.voxels.count;
    best.is_convex = open > 0 && voxels_beside_hull(*enclosed_) <= (1 / kAsMuch - 1) * double(open);
    best.tried.push_back({0, open});
    for (const double scale : tried_scales(scene_.header)) {
      source_.hidden.context.report("closing openings", "scales", done++, total);
      if (scale == 0) continue;
      if (best.is_convex) break;
      Hidden next = at(scale);
      best.tried.push_back({scale, next.voxels.voxels ? next.voxels.count : open});
      if (next.voxels.voxels == nullptr) continue;
      best.voxels = std::move(next.voxels);
      best.scale = scale;
    }
    return chosen(std::move(best));
  }

 private:
  /// No voxels if there are as many as without a scale, in the same places.
  Hidden at(double scale) const {
    Hidden hidden;
    hidden.scale = scale;
    const HiddenOptions o = at_scale(options_, scale);
    if (scale == 0) hidden.voxels = unseen_voxels(*enclosed_, *scene_.solid, o);
    if (scale == 0) return hidden;
    const auto unreached = unreached_voxels(scene_.header, *scene_.solid, enclosed_.get(), backends_, o);
    if (unreached) hidden.voxels = unseen_voxels(*unreached, *scene_.solid, o);
    return hidden;
  }

  /// `best` holds the voxels of one of the scales that were tried.
  Hidden chosen(Hidden best) const {
    std::uint64_t most = 0;
    for (const auto& tried : best.tried) most = std::max(most, tried.hidden_voxels);
    for (const auto& [scale, count] : best.tried) {
      if (double(count) < kAsMuch * double(most)) continue;
      if (scale != best.scale) best.voxels = at(scale).voxels;
      best.scale = scale;
      break;
    }
    return best;
  }

  const OccluderSource& source_;
  VoxelizedScene& scene_;
  Backends& backends_;
  HiddenOptions options_;
  std::unique_ptr<BrickShelf> enclosed_;
};

/// The mesh within hidden voxels.
class OccluderMesh {
 public:
  OccluderMesh(const OccluderSource& source, const VoxelizedScene& scene, const Hidden& hidden, Backends& backends)
      : source_(source), scene_(scene), hidden_(hidden), backends_(backends) {
    const LevelRequest request = source.request(scene.header);
    if (!request.faces.empty()) faces_ = request.faces.front();
  }

  LodLevel run() {
    const double most = scene_.header.bounds.diagonal() * kMostOpening, voxel = scene_.header.frame.voxel;
    for (double scale = 0; scale <= most; scale = scale == 0 ? 2 * voxel : 2 * scale) {
      const bool is_better = open_by(scale) && attempt(scale);
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
        faces_ = std::min(std::max(kFaces, parts * kFacesOfPart), kMostFaces);
        if (faces_ > kFaces && !mesh_at(scale, least, level)) break;
      }
      level.reached = level.mesh.triangles.size() <= faces_;
      any |= keep_better(std::move(level), scale);
      if (parts * kFewFacesPerPart <= faces_) break;
    }
    return any;
  }

  bool keep_better(LodLevel level, double scale) {
    const bool better = best_.mesh.triangles.empty() || (level.reached && !best_.reached) ||
                        (level.reached == best_.reached && volume_of(level) > volume_of(best_));
    if (!better) return false;
    best_ = std::move(level);
    opening_ = scale;
    return true;
  }

  [[nodiscard]] StreamHeader header_at(double scale) const {
    StreamHeader header = scene_.header;
    header.bricks = bricks_around(*hidden_.voxels.voxels);
    header.fill = FillMode::inside;
    header.has_closing = scale > 0;
    header.scale.base = scale;
    return header;
  }

  /// Makes the voxels that are meshed. False if they are too few for a better mesh than the best one: tightening goes
  /// beyond them, to what is hidden, but seldom far.
  bool open_by(double scale) {
    opened_.reset();
    if (scale == 0) return true;
    const double voxel_volume = std::pow(scene_.header.frame.voxel, 3);
    if (best_.reached && volume_of(best_) > kAll * double(hidden_.voxels.count) * voxel_volume) return false;
    opened_ = bp::opening(header_at(scale), *hidden_.voxels.voxels, backends_, at_scale(source_.hidden, scale));
    if (opened_ == nullptr) return false;
    return !best_.reached || double(count_voxels(*opened_)) * voxel_volume > kPromising * volume_of(best_);
  }

  /// False if nothing is left of it.
  bool mesh_at(double scale, double least_part, LodLevel& level) {
    ShelfSource shelf(header_at(scale), *hidden_.voxels.voxels, opened_.get(), ShelfSource::Keep::all);
    source_.hidden.context.report("meshing", "tries", std::uint64_t(attempts_), 0);
    MeshParams params;
    params.mode = MeshMode::inside;
    params.faces = {faces_ > 0 ? faces_ : kFaces};
    params.enclose = Enclose::input;
    params.least_part = least_part;
    try {
      level.mesh = std::move(mesh_stream(shelf, source_.hidden.context, std::move(params), level.counts).front());
    } catch (const Error& e) {
      if (scale == 0 || e.code() != ErrorCode::bad_input) throw;
      return false;  // too thin to be meshed
    }
    return true;
  }

  const OccluderSource& source_;
  const VoxelizedScene& scene_;
  const Hidden& hidden_;
  Backends& backends_;
  std::unique_ptr<BrickShelf> opened_;  // null: nothing is
  std::uint64_t faces_ = 0;             // 0: not known
  LodLevel best_;
  double opening_ = 0;
  int attempts_ = 0;
};

}  // namespace

MadeOccluder make_occluder(const OccluderSource& source, Backends& backends, const LevelSteps& steps) {
  MadeOccluder made;
  made.scene = source.voxelize(false);
  steps.begin("close openings");
  const std::size_t scales = tried_scales(made.scene.header).size(), total = scales * (source.may_ground ? 2 : 1);
  Hidden hidden = HiddenSearch(source, made.scene, backends).run(0, total);
  if (source.may_ground && !hidden.is_convex) {
    VoxelizedScene grounded = source.voxelize(true);
    Hidden with = HiddenSearch(source, grounded, backends).run(scales, total);
    with.ground = true;
    if (double(with.voxels.count) > kGroundGains * double(hidden.voxels.count)) hidden = std::move(with);
  }
  made.scale_world = hidden.scale;
  made.ground = hidden.ground;
  made.hidden_voxels = hidden.voxels.count;
  made.tried = hidden.tried;
  if (made.hidden_voxels == 0) return made;
  steps.begin("mesh");
  OccluderMesh mesh(source, made.scene, hidden, backends);
  made.level = mesh.run();
  made.level.scale_world = hidden.scale;
  made.level.error_world = made.level.distance_world = std::nan("");
  made.opening_world = mesh.opening();
  made.faces_asked = mesh.faces();
  return made;
}

}  // namespace bp
