#include "lib/levels/detail/level_search.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lib/grid/shelf_stream.h"
#include "lib/levels/detail/best_level.h"
#include "lib/levels/detail/convex_levels.h"
#include "lib/pass/mesh/mesh_pass.h"

namespace bp {

namespace {

// The search for a budget begins at 1/kFinest of the budget's own scale. It takes the first scale at which the closing
// leaves kFacesPerPart faces for each part and hole, since fewer do not show their shapes: the parts would take all
// faces, and the rest of the level would lie far from the scene. A fit begins at a half, since it lies on the closing
// and would follow the steps of the voxels.
constexpr double kFinest = 8, kFinestOfFit = 2;
constexpr std::uint64_t kFacesPerPart = 50;
// Below 32 faces, the mesh made by distance is not always the nearest one, so least volume is tried too.
constexpr std::uint64_t kTryVolumeBelow = 32;

/// Returns whether the target is a number of faces alone, so that the search chooses the scale.
bool is_by_budget(const LodTarget& target) {
  return target.faces > 0 && target.error_world == 0 && !target.scale_world;
}

bool has_few_faces(const LodTarget& target) {
  return target.faces > 0 && target.faces < kTryVolumeBelow && target.error_world == 0;
}

std::uint64_t parts_and_handles(const MeshMeasures& measures) {
  return measures.shells + measures.handles;
}

/// Returns whether meshing for least volume may reach the number of faces. It keeps all parts and handles, and each
/// needs four faces. With several parts it is not tried if the near mesh has more than 2n + 8 faces: it never reached n
/// in the tests.
bool may_reach_by_volume(const LodLevel& level, std::uint64_t faces) {
  constexpr std::uint64_t kFewMore = 8;
  const std::uint64_t parts = parts_and_handles(level.counts.levels.front().measures);
  return kFacesOfTetrahedron * parts <= faces && (parts == 1 || level.mesh.triangles.size() <= 2 * faces + kFewMore);
}

/// Returns whether a level lies no farther from the scene than a closing may: by the diagonal of a voxel, and of the
/// cube if that closes anything. At a larger scale than `scale_world` it would hardly be nearer.
bool is_near(const LodLevel& level, double scale_world, const LodGround& ground) {
  const double closed = scale_world >= kLeastScaleVox * ground.voxel ? scale_world : 0;
  return level.error_world <= std::sqrt(3.0) * (closed + ground.voxel);
}

/// Returns the most faces that show something of so many triangles.
std::uint64_t most_faces_around(std::uint64_t triangles) {
  return std::max<std::uint64_t>(kFacesPerTriangle * triangles, MeshParams::kSimpleScene);
}

}  // namespace

bool may_follow(const LevelScene& scene, const LodTarget& target) {
  return scene.is_bounding() && !scene.options().cage && is_by_budget(target) && !has_few_faces(target);
}

bool follows_from(const LevelScene& scene, const LodTarget& target, const LevelStart& start) {
  return may_follow(scene, target) && start.parts_and_holes * kFacesPerPart <= target.faces;
}

MeshParams params_of_level(const LodOptions& options, const LodTarget& target, bool has_triangles) {
  MeshParams params;
  const std::uint64_t most = has_triangles ? most_faces_around(options.scene.size()) : target.faces;
  if (target.faces > 0) params.faces = {std::min(target.faces, most)};
  params.error_world = target.error_world;
  params.mode = options.mode;
  params.enclose = options.enclose;
  if (options.mode == MeshMode::fit) {
    params.enclose = has_triangles ? Enclose::scene : Enclose::closing;
  } else if (options.enclose == Enclose::scene) {
    params.distances_to = Enclose::input;  // distances count from the scene's voxels, as with Enclose::input
  }
  return params;
}

namespace {

/// Makes one level: proposes several meshes to BestLevel, and takes the best.
class LevelSearch {
 public:
  LevelSearch(LevelScene& scene, const PassContext& context, const LodTarget& target, const LevelStart* start)
      : scene_(scene),
        options_(scene.options()),
        context_(context),
        target_(target),
        start_(start),
        ground_(scene.ground()),
        best_(scene.ruler(), options_.mode, target.faces) {}
  LodLevel make(std::optional<LevelStart>* left) {
    left_ = left;
    if (options_.cage) {
      best_.propose("cage", cage());
      return best_.take();
    }
    const std::vector<ConvexLevel> convex = convex_ways();
    const bool is_convex = scene_.has_triangles() &&
                           std::any_of(convex.begin(), convex.end(),
                                       [&](const ConvexLevel& c) { return best_.propose_exact(c.way, c.level); });
    if (is_convex) return best_.take();
    if (start_ != nullptr) {
      best_.propose(start_->scale_world > 0 ? "finer" : "surface", coarser());
    } else {
      propose_closings();
    }
    for (const ConvexLevel& c : convex) best_.propose(c.way, c.level);
    return best_.take();
  }

 private:
  using Solid = LevelVoxels::Solid;
  using Closing = LevelVoxels::Closing;
  using Keep = ShelfSource::Keep;

  bool is_of_few_faces() const { return scene_.is_bounding() && has_few_faces(target_); }
  /// Returns whether several closings may be tried: a number of faces alone is asked for, of a scene of so few
  /// triangles that each closing takes little time.
  bool is_simple() const {
    return scene_.is_bounding() && scene_.has_triangles() && !options_.field && is_by_budget(target_) &&
           options_.scene.size() <= MeshParams::kSimpleScene;
  }
  double finest() const { return scene_.is_bounding() ? kFinest : kFinestOfFit; }
  bool is_within(const LodLevel& level) const {
    return target_.faces == 0 || level.mesh.triangles.size() <= target_.faces;
  }
  std::vector<ConvexLevel> convex_ways() {
    const bool may_be = scene_.is_bounding() && options_.enclose != Enclose::closing && target_.faces > 0;
    if (!may_be || target_.error_world > 0) return {};
    const StreamHeader& header = scene_.voxels().reduced(0).header;
    LodLevel place;
    place.mesh.frame = header.frame;
    place.mesh.provenance = header.provenance;
    place.attempts = 1;
    if (!scene_.has_triangles()) return convex_levels(place, scene_.ruler().bounds(), {}, 0, target_.faces);
    const double off = options_.rounding.of(scene_.bounds()) * kLatticePerVoxel / header.frame.voxel;
    return convex_levels(place, scene_.bounds(), scene_corners(header.frame, options_.scene), off, target_.faces);
  }
  /// Returns whether the target has fewer than `faces_per_part` faces for each part and hole of the closing.
  bool has_too_many_parts(const Closing& closing, std::uint64_t faces_per_part) const {
    return target_.faces > 0 && parts_and_holes(closing, context_.pieces) * faces_per_part > target_.faces;
  }
  /// Proposes one closing; for a simple scene larger scales, too, up to twice that of the budget, until a level is
  /// near. The best of these cannot be known before: a larger scale joins parts, so that the level needs fewer faces,
  /// and a smaller one follows the scene's shape.
  void propose_closings() {
    const double least = options_.least_scale_world, whole = first_scale(ground_, target_, least);
    std::unique_ptr<Closing> closing_of_best;
    const Solid* solid = nullptr;
    int attempts = 1, reductions = 0;
    for (double scale = is_by_budget(target_) ? std::max(whole / finest(), least) : whole;;
         scale = larger_scale(*solid, scale)) {
      reductions = reductions_for(ground_, target_, finest_scale(options_.field, std::max(scale, whole)), reductions);
      solid = &scene_.voxels().reduced(reductions);
      const bool last = larger_scale(*solid, scale) > scene_.bounds().diagonal() / 2;
      Closing closing = scene_.voxels().closed_at(*solid, scale, context_);
      if (!last && has_too_many_parts(closing, scale < whole ? kFacesPerPart : kFacesOfTetrahedron)) {
        attempts += scale >= whole;
        continue;
      }
      LatticeMesh halfway;
      MeshParams params = mesh_params(*solid, scale);
      if (left_ != nullptr) params.halfway = &halfway;
      LodLevel level = mesh(std::move(params), *solid, closing, is_of_few_faces() ? Keep::all : Keep::solid);
      const bool by_volume = is_of_few_faces() && may_reach_by_volume(level, target_.faces);
      const bool keeps_near = is_within(level) || !by_volume;
      if (!keeps_near) level = mesh(least_volume(*solid), *solid, closing, Keep::all);
      if (!is_within(level) && !last) {
        attempts += scale >= whole;
        continue;
      }
      level.attempts = attempts;
      const std::uint64_t parts = parts_and_handles(level.counts.levels.front().measures);
      if (best_.propose(keeps_near ? "closing" : "least volume", std::move(level))) {
        closing_of_best.reset();
        if (by_volume && keeps_near) closing_of_best = std::make_unique<Closing>(std::move(closing));
        leave_start(std::move(halfway), *solid, parts, scale);
      }
      if (!is_simple() || last || scale >= 2 * whole || is_near(best_.level(), scale, ground_)) break;
    }
    if (closing_of_best && !best_.is_exact()) propose_least_volume(*closing_of_best);
  }
  /// Proposes the mesh of least volume around the closing of the best mesh.
  void propose_least_volume(const Closing& closing) {
    const Solid& solid = scene_.voxels().reduced(best_.level().reductions);
    LodLevel level = mesh(least_volume(solid), solid, closing, Keep::solid);
    level.attempts = best_.level().attempts;
    best_.propose("least volume", std::move(level));
  }
  /// Returns the scale to try after `scale`: twice as large, and doubled until it closes something in these voxels.
  double larger_scale(const Solid& solid, double scale) const {
    const double least = kLeastScaleVox * solid.header.frame.voxel;
    if (scale == 0) return least;
    do scale *= 2;
    while (scale < least);
    return scale;
  }
  /// Makes the level by simplifying the mesh that it starts from.
  LodLevel coarser() {
    const Solid& solid = scene_.voxels().reduced(start_->reductions);
    MeshParams params = mesh_params(solid, first_scale(ground_, target_, options_.least_scale_world));
    params.start = &start_->mesh;
    LatticeMesh halfway;
    if (left_ != nullptr) params.halfway = &halfway;
    LodLevel level = mesh(std::move(params), solid, LevelVoxels::as_it_is(solid, start_->scale_world), Keep::solid);
    leave_start(std::move(halfway), solid, parts_and_handles(level.counts.levels.front().measures),
                start_->scale_world);
    level.attempts = 1;
    return level;
  }
  /// Keeps the halfway mesh as the start of coarser levels. `parts`: the parts and handles of the level.
  void leave_start(LatticeMesh halfway, const Solid& solid, std::uint64_t parts, double scale) {
    if (left_ == nullptr) return;
    left_->reset();
    if (halfway.triangles.empty()) return;
    halfway.provenance = solid.header.provenance;
    *left_ = LevelStart{std::move(halfway), solid.reductions, parts, scale};
  }
  /// Makes a cage around the voxels, without a closing.
  LodLevel cage() {
    const Solid& solid = scene_.voxels().reduced(0);
    MeshParams params;
    params.faces = {target_.faces};
    params.enclose = Enclose::closing;
    params.cage = options_.cage;
    return mesh(std::move(params), solid, LevelVoxels::as_it_is(solid, 0), Keep::solid);
  }
  /// keep: Keep::all if the closing will be meshed again, else Keep::solid.
  LodLevel mesh(MeshParams params, const Solid& solid, const Closing& closing, Keep keep) {
    LodLevel level;
    level.scale_world = closing.scale_world;
    level.reductions = solid.reductions;
    context_.report("meshing", "levels", 0, 1);
    std::shared_ptr<const Enclosed> enclosed;
    if (scene_.is_bounding() && options_.enclose == Enclose::scene && !options_.cage) enclosed = scene_.enclosed(solid);
    params.enclosed = enclosed.get();
    ShelfSource source(closing.header, *solid.shelf, closing.voxels.get(), keep);
    level.mesh = std::move(mesh_stream(source, context_, std::move(params), level.counts).front());
    return level;
  }
  MeshParams least_volume(const Solid& solid) const {
    MeshParams params = mesh_params(solid, {});
    params.convex = false;  // hulls and boxes are proposed on their own
    return params;
  }
  /// near_world: as in MeshParams.
  MeshParams mesh_params(const Solid& solid, std::optional<double> near_world) const {
    MeshParams params = params_of_level(options_, target_, scene_.has_triangles());
    // The enclosed voxels reach up to a voxel's diagonal beyond the scene.
    if (target_.error_world > 0)
      params.error_world =
          std::max(target_.error_world - std::sqrt(3.0) * (solid.header.frame.voxel + scene_.ruler().voxel()),
                   target_.error_world / 4);
    params.near_world = near_world;
    if (options_.mode == MeshMode::fit) params.scene = options_.scene, params.rounding = options_.rounding;
    return params;
  }

  LevelScene& scene_;
  const LodOptions& options_;
  const PassContext& context_;
  const LodTarget target_;
  const LevelStart* start_;
  const LodGround ground_;
  BestLevel best_;
  std::optional<LevelStart>* left_ = nullptr;  // receives the mesh from which coarser levels start
};

}  // namespace

LodLevel searched_level(LevelScene& scene, const PassContext& context, const LodTarget& target, const LevelStart* start,
                        std::optional<LevelStart>* left) {
  return LevelSearch(scene, context, target, start).make(left);
}

}  // namespace bp
