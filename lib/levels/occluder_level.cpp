#include "lib/levels/occluder_level.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lib/closing/closing.h"
#include "lib/core/error.h"
#include "lib/grid/shelf_stream.h"
#include "lib/pass/mesh/complement.h"
#include "lib/pass/mesh/mesh_pass.h"

namespace bp {

namespace {

// The chosen scale hides at least this part of what the best one does.
constexpr double kAsMuch = 0.95;
// Standing on the ground must multiply what is hidden by more than this.
constexpr double kGroundGains = 1.25;
constexpr double kSidesOfWall = 2;    // the surface of walls, over that of what they hide
constexpr double kLeastTriedVox = 2;  // the least scale that is tried
// The largest scales that are tried, as parts of the scene's diagonal.
constexpr double kMostScale = 1.0 / 16, kMostOpening = 1.0 / 8;
constexpr double kMostLeastPart = 0.3;  // the largest MeshParams::least_part that is tried

double largest_scale(const StreamHeader& header) {
  return header.bounds.diagonal() * kMostScale;
}

HiddenOptions at_scale(HiddenOptions options, double scale_world) {
  options.scale_world = scale_world;
  return options;
}

/// Shows progress in steps of the whole search. The passes within a step report nothing new: they only draw the same
/// line again.
class ShownSteps {
 public:
  ShownSteps(const PassContext& context, const char* pass, const char* unit, std::size_t total)
      : context_(context), pass_(pass), unit_(unit), total_(total) {}
  void show() const { context_.report(pass_, unit_, done_, total_); }
  void step() {
    ++done_;
    show();
  }
  [[nodiscard]] HiddenOptions within(HiddenOptions options) const {
    options.context.progress = [this](const char*, const char*, std::uint64_t, std::uint64_t) { show(); };
    return options;
  }

 private:
  const PassContext& context_;
  const char *pass_, *unit_;
  std::size_t done_ = 0, total_;
};

/// Finds what a scene hides, at the scale that is asked for or at the best one.
class HiddenSearch {
 public:
  HiddenSearch(const StreamHeader& header, BrickShelf& touched, Backends& backends, const OccluderRequest& request,
               const char* pass)
      : header_(header),
        touched_(touched),
        backends_(backends),
        asked_(request.scale_world.has_value()),
        scales_(asked_ ? std::vector<double>{*request.scale_world} : occluder_scales(header)),
        steps_(request.hidden.context, pass, "scales", scales_.size()),
        options_(steps_.within(request.hidden)),
        enclosed_(enclosed_voxels(header, touched, backends, options_)) {}

  HiddenScene run() {
    for (const double scale : scales_) {
      attempt(scale);
      steps_.step();
    }
    // The scales are a factor apart: where none hides anything, the largest that may be tried still can.
    if (!asked_ && most_ == 0) attempt(largest_scale(header_));
    HiddenScene best = std::move(promising_.front());
    if (!asked_) best.tried = std::move(tried_);
    return best;
  }

 private:
  /// Computes what is hidden at a scale. The voxels are kept only if they are more than at all scales before: else a
  /// smaller scale hides as much.
  void attempt(double scale) {
    const bool first = tried_.empty();
    const auto unreached = unreached_voxels(header_, *enclosed_, backends_, at_scale(options_, scale));
    tried_.push_back({scale, first ? 0 : tried_.front().hidden_voxels});
    if (!unreached && !first) return;  // nothing more is hidden than without a scale
    HiddenScene hidden;
    hidden.scale_world = scale;
    hidden.voxels = unseen_voxels(unreached ? *unreached : *enclosed_, touched_, options_);
    const std::uint64_t count = tried_.back().hidden_voxels = hidden.voxels.count;
    if (count <= most_ && !first) return;
    most_ = count;
    std::erase_if(promising_, [&](const HiddenScene& h) { return double(h.voxels.count) < kAsMuch * double(most_); });
    promising_.push_back(std::move(hidden));
  }

  const StreamHeader& header_;
  BrickShelf& touched_;
  Backends& backends_;
  const bool asked_;  // whether one scale is asked for
  const std::vector<double> scales_;
  ShownSteps steps_;
  const HiddenOptions options_;
  const std::unique_ptr<BrickShelf> enclosed_;
  std::vector<HiddenScene::Tried> tried_;
  std::vector<HiddenScene> promising_;  // the last ones hide more than those before
  std::uint64_t most_ = 0;
};

/// Returns the header of the hidden voxels after an opening; scale 0: all of them.
StreamHeader header_of(StreamHeader header, const HiddenScene& hidden, double scale) {
  header.bricks = bricks_around(*hidden.voxels.voxels);
  header.fill = FillMode::inside;
  header.has_closing = scale > 0;
  header.scale.base = scale;
  return header;
}

MeshParams params_of(std::uint64_t faces, double least_part) {
  MeshParams params;
  params.mode = MeshMode::inside;
  params.faces = {faces > 0 ? faces : kOccluderFaces};
  params.enclose = Enclose::input;
  params.least_part = least_part;
  return params;
}

/// Makes the mesh within hidden voxels.
class OccluderMesh {
 public:
  OccluderMesh(const StreamHeader& header, const HiddenScene& hidden, Backends& backends,
               const OccluderRequest& request)
      : header_(header),
        hidden_(hidden),
        backends_(backends),
        options_(request.hidden),
        openings_(occluder_openings(header)),
        steps_(options_.context, "meshing", "openings", openings_.size()),
        faces_(request.faces) {}

  LodLevel run() {
    steps_.show();
    for (const double scale : openings_) {
      const bool is_better = open_by(scale) && attempt(scale);
      steps_.step();
      if (best_.reached && (!is_better || holds_all())) break;
    }
    best_.attempts = attempts_;
    return std::move(best_);
  }
  [[nodiscard]] double opening_world() const { return opening_; }
  [[nodiscard]] std::uint64_t faces() const { return faces_; }

 private:
  /// Tries one opening. While its parts are too many for the faces, larger and larger parts are left out. Returns
  /// whether a mesh was the best so far.
  bool attempt(double scale) {
    bool any = false;
    for (double least = MeshParams::kLeastPart; least <= kMostLeastPart; least *= std::sqrt(10.0)) {
      LodLevel level;
      if (!mesh_at(scale, least, level)) break;
      const std::uint64_t parts = level.counts.levels.front().measures.shells;
      if (attempts_++ == 0 && faces_ == 0) {
        faces_ = std::min(std::max(kOccluderFaces, parts * kOccluderFacesOfPart), kMostOccluderFaces);
        if (faces_ > kOccluderFaces && !mesh_at(scale, least, level)) break;
      }
      level.reached = level.mesh.triangles.size() <= faces_;
      any |= keep_better(std::move(level), scale);
      if (parts * kFacesOfBox <= faces_) break;
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

  /// Returns whether the best mesh has the volume of all hidden voxels. No mesh holds more, since each lies in hidden
  /// voxels.
  [[nodiscard]] bool holds_all() const {
    return volume6_of(best_.mesh) >= int128(hidden_.voxels.count) * kVolume6OfVoxel;
  }

  /// Opens the hidden voxels. Returns false if nothing is left.
  bool open_by(double scale) {
    opened_.reset();
    if (scale == 0) return true;
    opened_ = opening(header_of(header_, hidden_, scale), *hidden_.voxels.voxels, backends_,
                      at_scale(steps_.within(options_), scale));
    return opened_ != nullptr;
  }

  /// Makes the mesh. Returns false if the opened voxels are too thin to be meshed.
  bool mesh_at(double scale, double least_part, LodLevel& level) {
    ShelfSource shelf(header_of(header_, hidden_, scale), *hidden_.voxels.voxels, opened_.get(),
                      ShelfSource::Keep::all);
    try {
      level.mesh = std::move(mesh_stream(shelf, options_.context, params_of(faces_, least_part), level.counts).front());
    } catch (const Error& e) {
      if (scale == 0 || e.code() != ErrorCode::bad_input) throw;
      return false;
    }
    return true;
  }

  const StreamHeader& header_;
  const HiddenScene& hidden_;
  Backends& backends_;
  const HiddenOptions& options_;
  const std::vector<double> openings_;
  ShownSteps steps_;
  std::unique_ptr<BrickShelf> opened_;  // the opening of the hidden voxels; null: all of them
  std::uint64_t faces_;                 // 0: not known
  LodLevel best_;
  double opening_ = 0;
  int attempts_ = 0;
};

}  // namespace

std::vector<double> occluder_scales(const StreamHeader& header) {
  std::vector<double> scales{0};
  const double most = largest_scale(header);
  for (double s = (kLeastTriedVox + kBeyondWholeVox) * header.frame.voxel; s <= most; s *= std::sqrt(2.0))
    scales.push_back(s);
  return scales;
}

std::vector<double> occluder_openings(const StreamHeader& header) {
  std::vector<double> scales{0};
  const double most = header.bounds.diagonal() * kMostOpening;
  for (double s = 2 * header.frame.voxel; s <= most; s *= 2) scales.push_back(s);
  return scales;
}

HiddenScene hidden_scene(const StreamHeader& header, BrickShelf& touched, Backends& backends,
                         const OccluderRequest& request, const char* pass) {
  return HiddenSearch(header, touched, backends, request, pass).run();
}

bool gains_on_ground(std::uint64_t on_ground, std::uint64_t without) {
  return double(on_ground) > kGroundGains * double(without);
}

bool may_gain_on_ground(const StreamHeader& header, std::uint64_t without) {
  const VoxelCoord size = voxel_bounds(header.frame, header.bounds).size();
  return gains_on_ground(std::uint64_t(size.x) * std::uint64_t(size.y) * std::uint64_t(size.z), without);
}

std::uint64_t occluder_limit(const StreamHeader& header, const HiddenScene& hidden, const OccluderRequest& request) {
  ShelfSource shelf(header_of(header, hidden, 0), *hidden.voxels.voxels, nullptr, ShelfSource::Keep::all);
  return mesh_limit(shelf, request.hidden.context, params_of(request.faces, MeshParams::kLeastPart), 0);
}

std::uint64_t occluder_limit_before(const StreamHeader& header, BrickShelf& touched, const OccluderRequest& request) {
  StreamHeader around = header;
  around.bricks = bricks_around(touched);
  around.fill = FillMode::inside;
  ShelfSource shelf(around, touched, nullptr, ShelfSource::Keep::all);
  const double scale = request.scale_world ? *request.scale_world : largest_scale(header);
  const std::uint64_t both =
      mesh_limit(shelf, request.hidden.context, params_of(request.faces, MeshParams::kLeastPart), 0);
  const MemoryLimit& limit = request.hidden.context.memory.limit;
  const auto rest = double(MemoryLimit{both, limit.fixed_bytes}.rest_bytes());
  return std::max(limit.for_rest(rest / kSidesOfWall), hidden_limit(header, at_scale(request.hidden, scale)));
}

MadeOccluder make_occluder(const StreamHeader& header, const HiddenScene& hidden, Backends& backends,
                           const OccluderRequest& request) {
  OccluderMesh mesh(header, hidden, backends, request);
  MadeOccluder made;
  made.level = mesh.run();
  made.level.scale_world = hidden.scale_world;
  made.level.error_world = std::nan("");
  made.opening_world = mesh.opening_world();
  made.faces_asked = mesh.faces();
  return made;
}

}  // namespace bp
