#include "lib/levels/occluder_level.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "lib/closing/closing.h"
#include "lib/core/error.h"
#include "lib/enclosed/enclosed_voxels.h"
#include "lib/grid/shelf_stream.h"
#include "lib/levels/detail/silhouettes.h"
#include "lib/pass/hide/possible_rooms.h"
#include "lib/pass/mesh/complement.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

// The chosen scale hides at least this part of what the best one does.
constexpr double kAsMuch = 0.95;
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
        more_than_(request.more_than_voxels),
        enclosed_(enclosed_voxels(header, touched, backends, options_)) {
    if (!asked_) leave_out_needless();
  }

  HiddenScene run() {
    const std::size_t last = scales_.size() - 1;
    attempt(0);
    if (asked_) return gives_up() ? HiddenScene{} : std::move(kept_.front());
    if (last == 0 && gives_up() && !can_make_rooms(largest_scale(header_))) return {};
    if (last > 0) {
      most_possible_ = std::max(most_possible_, closed_at(last).count);
      if (gives_up()) return {};
      if (!is_enough(most_)) search(last);
    }
    // The scales are a factor apart: where none hides anything, the largest that may be tried still can.
    if (most_ == 0 && can_make_rooms(largest_scale(header_))) {
      scales_.push_back(largest_scale(header_));
      attempt(last + 1);
    }
    return best();
  }

 private:
  /// Leaves out the scales at which the closing makes no room: nothing more is hidden there than at 0.
  void leave_out_needless() {
    const std::vector<bool> possible = possible_rooms(header_, *enclosed_, scales_, options_);
    std::size_t kept = 1;
    for (std::size_t i = 1; i < scales_.size(); ++i) {
      if (possible[i]) {
        scales_[kept++] = scales_[i];
      } else {
        steps_.step();
      }
    }
    scales_.resize(kept);
  }
  [[nodiscard]] bool can_make_rooms(double scale) const {
    return possible_rooms(header_, *enclosed_, {scale}, options_).front();
  }
  [[nodiscard]] bool gives_up() const { return double(most_possible_) <= more_than_; }
  /// Returns whether a scale that hides so much is taken before all larger ones.
  [[nodiscard]] bool is_enough(std::uint64_t hidden) const {
    return double(hidden) >= kAsMuch * double(most_possible_);
  }

  /// Tries the largest scale, and all that may hide kAsMuch of what it hides, the least first.
  void search(std::size_t last) {
    attempt(last);
    std::size_t low = 0, first = last;  // the closing at `low` is too small
    while (first - low > 1) {
      const std::size_t middle = low + (first - low) / 2;
      (double(closed_at(middle).count) >= kAsMuch * double(most_) ? first : low) = middle;
    }
    for (std::size_t i = first; i < last; ++i) {
      attempt(i);
      if (is_enough(tried_.back().hidden_voxels)) return;
    }
  }

  /// Returns the closing at a scale, which is made once.
  ClosedVoxels& closed_at(std::size_t i) {
    const auto [found, is_new] = closed_.try_emplace(i);
    if (is_new) {
      found->second = closed_voxels(header_, *enclosed_, backends_, at_scale(options_, scales_[i]));
      steps_.step();
    }
    return found->second;
  }

  /// Computes what is hidden at a scale, and keeps it if no smaller scale hides as much.
  void attempt(std::size_t i) {
    ClosedVoxels closed = std::move(closed_at(i));
    if (i == 0) most_possible_ = closed.count;
    tried_.push_back({scales_[i], tried_.empty() ? 0 : tried_.front().hidden_voxels});
    if (!closed.has_rooms && i > 0) return;  // nothing more is hidden than without a scale
    const HiddenOptions options = at_scale(options_, scales_[i]);
    HiddenScene hidden;
    hidden.scale_world = scales_[i];
    const auto unreached =
        closed.has_rooms ? unreached_voxels(header_, *enclosed_, std::move(closed), backends_, options) : nullptr;
    hidden.voxels = unseen_voxels(unreached ? *unreached : *enclosed_, touched_, options_);
    const std::uint64_t count = tried_.back().hidden_voxels = hidden.voxels.count;
    most_ = std::max(most_, count);
    keep(std::move(hidden));
  }

  /// Keeps what is hidden at a scale, if it is enough and no smaller scale hides as much; drops what it beats.
  void keep(HiddenScene hidden) {
    const auto beats = [](const HiddenScene& a, const HiddenScene& b) {
      return a.scale_world < b.scale_world && a.voxels.count >= b.voxels.count;
    };
    const bool is_beaten = std::any_of(kept_.begin(), kept_.end(), [&](const auto& h) { return beats(h, hidden); });
    std::erase_if(kept_, [&](const HiddenScene& h) {
      return beats(hidden, h) || double(h.voxels.count) < kAsMuch * double(most_);
    });
    if (!is_beaten && double(hidden.voxels.count) >= kAsMuch * double(most_)) kept_.push_back(std::move(hidden));
  }

  HiddenScene best() {
    const auto by_scale = [](const auto& a, const auto& b) { return a.scale_world < b.scale_world; };
    std::sort(tried_.begin(), tried_.end(), by_scale);
    HiddenScene best = std::move(*std::min_element(kept_.begin(), kept_.end(), by_scale));
    best.tried = std::move(tried_);
    return best;
  }

  const StreamHeader& header_;
  BrickShelf& touched_;
  Backends& backends_;
  const bool asked_;  // whether one scale is asked for
  std::vector<double> scales_;
  ShownSteps steps_;
  const HiddenOptions options_;
  const double more_than_;
  const std::unique_ptr<BrickShelf> enclosed_;
  std::map<std::size_t, ClosedVoxels> closed_;  // by the number of the scale; without voxels once they were used
  std::vector<HiddenScene::Tried> tried_;
  std::vector<HiddenScene> kept_;
  std::uint64_t most_ = 0, most_possible_ = 0;  // voxels that are hidden at a scale that was tried, and at any
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

/// Returns the box around the hidden voxels, lattice units.
LatticeBox box_of(const HiddenScene& hidden) {
  const VoxelBox box = boundary_size(*hidden.voxels.voxels).box;
  return {LatticeCoord{box.min.x, box.min.y, box.min.z} * kLatticePerVoxel,
          LatticeCoord{box.max.x, box.max.y, box.max.z} * kLatticePerVoxel};
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
        outside_(options_.context.make_shelf()),
        silhouettes_(box_of(hidden), header.frame.up),
        faces_(request.faces) {
    complement(*hidden.voxels.voxels, bricks_around(*hidden.voxels.voxels), *outside_);
    enclosed_ = std::make_unique<EnclosedVoxels>(*outside_);
  }

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

  /// Keeps a mesh if it covers more of the silhouettes than the best one, and has no more faces than are wanted.
  bool keep_better(LodLevel level, double scale) {
    const double covered = silhouettes_.share(level.mesh);
    const bool better = best_.mesh.triangles.empty() || (level.reached && !best_.reached) ||
                        (level.reached == best_.reached && covered > covered_);
    if (!better) return false;
    best_ = std::move(level);
    covered_ = covered;
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
      MeshParams params = params_of(faces_, least_part);
      params.enclosed = enclosed_.get();
      level.mesh = std::move(mesh_stream(shelf, options_.context, params, level.counts).front());
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
  const std::unique_ptr<BrickShelf> outside_;  // all voxels that are not hidden
  std::unique_ptr<EnclosedVoxels> enclosed_;   // the same, as the set that a mesh must not hold
  const Silhouettes silhouettes_;
  std::unique_ptr<BrickShelf> opened_;  // the opening of the hidden voxels; null: all of them
  std::uint64_t faces_;                 // 0: not known
  LodLevel best_;
  double covered_ = 0;  // silhouettes_.share() of the best one
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
