#include "lib/levels/occluder_level.h"

#include <cmath>
#include <utility>
#include <vector>

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

/// The scales that are tried, from 0.
std::vector<double> tried_scales(const StreamHeader& header) {
  std::vector<double> scales{0};
  const double most = header.bounds.diagonal() * kMostScale;
  for (double s = (kLeastTriedVox + kBeyondWholeVox) * header.frame.voxel; s <= most; s *= std::sqrt(2.0))
    scales.push_back(s);
  return scales;
}

/// What a scene hides at the scale that is asked for, or at the best one.
class HiddenSearch {
 public:
  HiddenSearch(const OccluderSource& source, VoxelizedScene& scene, Backends& backends)
      : source_(source),
        scene_(scene),
        backends_(backends),
        enclosed_(enclosed_voxels(scene.header, *scene.solid, backends, source.hidden)) {}

  Hidden run() {
    const std::optional<double> asked = source_.request(scene_.header).scale_world;
    for (const double scale : asked ? std::vector<double>{*asked} : tried_scales(scene_.header)) attempt(scale);
    Hidden best = std::move(promising_.front());
    if (!asked) best.tried = std::move(tried_);
    return best;
  }

 private:
  /// Scales that hide less than one before them are never the least that hides enough: their voxels are not kept.
  void attempt(double scale) {
    const bool first = tried_.empty();
    const auto unreached = unreached_voxels(scene_.header, *enclosed_, backends_, at_scale(source_.hidden, scale));
    tried_.push_back({scale, first ? 0 : tried_.front().hidden_voxels});
    if (!unreached && !first) return;  // as much as without a scale
    Hidden hidden;
    hidden.scale = scale;
    hidden.voxels = unseen_voxels(unreached ? *unreached : *enclosed_, *scene_.solid, source_.hidden);
    const std::uint64_t count = tried_.back().hidden_voxels = hidden.voxels.count;
    if (count <= most_ && !first) return;
    most_ = count;
    std::erase_if(promising_, [&](const Hidden& h) { return double(h.voxels.count) < kAsMuch * double(most_); });
    promising_.push_back(std::move(hidden));
  }

  const OccluderSource& source_;
  VoxelizedScene& scene_;
  Backends& backends_;
  const std::unique_ptr<BrickShelf> enclosed_;
  std::vector<MadeOccluder::Tried> tried_;
  std::vector<Hidden> promising_;  // each with more voxels than the one before
  std::uint64_t most_ = 0;
};

/// Whether a scene on the ground hides enough more.
bool gains(double on_ground, double without) {
  return on_ground > kGroundGains * without;
}

/// False if no more can be hidden on the ground than is without: at most all voxels of the scene's bounds.
bool may_gain(const StreamHeader& header, double hidden) {
  const VoxelCoord size = voxel_bounds(header.frame, header.bounds).size();
  return gains(double(size.x) * size.y * size.z, hidden);
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
      const bool is_better = open_by(scale) && attempt(scale);
      if (best_.reached && (!is_better || holds_all())) break;
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

  /// Of the best mesh: all that is hidden. No other one holds more, since each lies in hidden voxels.
  [[nodiscard]] bool holds_all() const {
    constexpr int kVolume6OfVoxel = 6 * kLatticePerVoxel * kLatticePerVoxel * kLatticePerVoxel;
    return volume6_of(best_.mesh) >= int128(hidden_.voxels.count) * kVolume6OfVoxel;
  }

  [[nodiscard]] StreamHeader header_at(double scale) const {
    StreamHeader header = scene_.header;
    header.bricks = bricks_around(*hidden_.voxels.voxels);
    header.fill = FillMode::inside;
    header.has_closing = scale > 0;
    header.scale.base = scale;
    return header;
  }

  /// False if nothing is left of what is hidden.
  bool open_by(double scale) {
    opened_.reset();
    if (scale == 0) return true;
    opened_ = bp::opening(header_at(scale), *hidden_.voxels.voxels, backends_, at_scale(source_.hidden, scale));
    return opened_ != nullptr;
  }

  /// False if it is too thin to be meshed.
  bool mesh_at(double scale, double least_part, LodLevel& level) {
    ShelfSource shelf(header_at(scale), *hidden_.voxels.voxels, opened_.get(), ShelfSource::Keep::all);
    MeshParams params;
    params.mode = MeshMode::inside;
    params.faces = {faces_ > 0 ? faces_ : kFaces};
    params.enclose = Enclose::input;
    params.least_part = least_part;
    try {
      level.mesh = std::move(mesh_stream(shelf, source_.hidden.context, std::move(params), level.counts).front());
    } catch (const Error& e) {
      if (scale == 0 || e.code() != ErrorCode::bad_input) throw;
      return false;
    }
    return true;
  }

  const OccluderSource& source_;
  const VoxelizedScene& scene_;
  const Hidden& hidden_;
  Backends& backends_;
  std::unique_ptr<BrickShelf> opened_;  // of what is hidden; null: all of it
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
  Hidden hidden = HiddenSearch(source, made.scene, backends).run();
  if (source.may_ground && may_gain(made.scene.header, double(hidden.voxels.count))) {
    VoxelizedScene grounded = source.voxelize(true);
    steps.begin("close openings");
    Hidden with = HiddenSearch(source, grounded, backends).run();
    with.ground = true;
    if (gains(double(with.voxels.count), double(hidden.voxels.count))) hidden = std::move(with);
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
