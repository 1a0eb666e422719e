#include "lib/levels/occluder_level.h"

#include <cmath>
#include <utility>

#include "lib/closing/closing.h"
#include "lib/core/error.h"
#include "lib/grid/shelf_stream.h"
#include "lib/pass/mesh/complement.h"

namespace bp {

namespace {

constexpr double kAsMuch = 0.95;                                 // of what the best scale hides
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
  HiddenVoxels voxels;
  std::vector<MadeOccluder::Tried> tried;
};

HiddenOptions at_scale(HiddenOptions options, double scale_world) {
  options.scale_world = scale_world;
  return options;
}

/// At the scale that is asked for, or the best one.
Hidden best_hidden(const OccluderSource& source, VoxelizedScene& scene, bool ground, Backends& backends) {
  const double voxel = scene.header.frame.voxel, diagonal = scene.header.bounds.diagonal();
  const auto hide = [&](double scale) {
    return hidden_voxels(scene.header, *scene.solid, backends, at_scale(source.hidden, scale));
  };
  Hidden best;
  best.ground = ground;
  if (const std::optional<double> asked = source.request(scene.header).scale_world) {
    best.scale = *asked;
    best.voxels = hide(best.scale);
    return best;
  }
  std::uint64_t most = 0;
  for (double scale = 0; scale <= diagonal * kMostScale;
       scale = scale == 0 ? (kLeastTriedVox + kBeyondWholeVox) * voxel : scale * std::sqrt(2.0)) {
    best.voxels = {};  // one at a time
    best.voxels = hide(scale);
    best.scale = scale;
    best.tried.push_back({scale, best.voxels.count});
    most = std::max(most, best.voxels.count);
  }
  for (const auto& [scale, count] : best.tried) {
    if (double(count) < kAsMuch * double(most)) continue;
    if (scale != best.scale) best.voxels = hide(scale);
    best.scale = scale;
    break;
  }
  return best;
}

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
    if (scale > 0) opened = bp::opening(header, *hidden_.voxels.voxels, backends_, at_scale(source_.hidden, scale));
    if (scale > 0 && opened == nullptr) return false;
    ShelfSource shelf(header, *hidden_.voxels.voxels, opened.get(), ShelfSource::Keep::all);
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
  std::uint64_t faces_ = 0;  // 0: not known
  LodLevel best_;
  double opening_ = 0;
  int attempts_ = 0;
};

}  // namespace

MadeOccluder make_occluder(const OccluderSource& source, Backends& backends, const LevelSteps& steps) {
  MadeOccluder made;
  made.scene = source.voxelize(false);
  steps.begin("close openings");
  Hidden hidden = best_hidden(source, made.scene, false, backends);
  if (source.may_ground) {
    VoxelizedScene grounded = source.voxelize(true);
    Hidden with = best_hidden(source, grounded, true, backends);
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
