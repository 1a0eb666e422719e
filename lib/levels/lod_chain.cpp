#include "lib/levels/lod_chain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/closing/closing.h"
#include "lib/core/error.h"
#include "lib/grid/shelf_stream.h"
#include "lib/levels/detail/best_level.h"
#include "lib/levels/detail/convex_levels.h"
#include "lib/levels/detail/level_voxels.h"
#include "lib/levels/detail/ruler.h"
#include "lib/pass/mesh/outward_scene.h"
#include "lib/pass/mesh/scene_check.h"

namespace bp {

namespace {

// A budget is closed at the least of the scales from a kFinest-th of its own on at which each part and hole of the
// closing has so many faces to show its shape. Where parts and holes take all faces, the rest of the level is far off.
// A fit lies on the closing, and has its noise.
constexpr double kFinest = 8, kFinestOfFit = 2;
constexpr std::uint64_t kFacesPerPart = 50;
// With fewer faces, the mesh that keeps near the scene is not always the nearest one.
constexpr std::uint64_t kTryVolumeBelow = 32;

using Closing = LevelVoxels::Closing;
using Keep = ShelfSource::Keep;

/// Whether nothing but a number of faces decides the scale.
bool is_by_budget(const LodTarget& target) {
  return target.faces > 0 && target.error_world == 0 && !target.scale_world;
}

/// Whether meshing for least volume may lead to few enough faces: all parts and handles are kept, and each takes four.
/// Where there are several, none was seen to lead from more than twice as many.
bool may_reach_by_volume(const LodLevel& level, std::uint64_t faces) {
  constexpr std::uint64_t kFewMore = 8;
  const MeshMeasures& measures = level.counts.levels.front().measures;
  const std::uint64_t parts = measures.shells + measures.handles;
  return 4 * parts <= faces && (parts == 1 || level.mesh.triangles.size() <= 2 * faces + kFewMore);
}

}  // namespace

struct LodChain::State {
  State(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends, LodOptions o)
      : options(std::move(o)),
        all(options.context),
        context(options.context),
        scene_bounds(header.bounds),
        voxels(header, std::move(solid), backends, options) {
    take_off(options.scene.size() * sizeof(TriangleD));
    // The scene is checked here, and not at each level, whose voxels may be larger.
    if (options.mode == MeshMode::bounding && options.enclose == Enclose::scene && !options.is_within)
      require_within(options.scene, header.frame, voxels.solid());
    naming_all([&] {
      ruler.emplace(RulerScene{voxels.solid(), options.surface.get(), has_triangles() ? &options.scene : nullptr,
                               header.frame, options.mode},
                    context.memory);
    });
    options.surface.reset();
    take_off(ruler->bytes());
    last_scale = options.least_scale_world;
  }

  /// The next level, as LodChain::make().
  LodLevel make(const LodTarget& target) {
    BestLevel best(*ruler, options.mode, target.faces);
    if (options.cage) {
      best.propose("cage", cage(target));
      return best.take();
    }
    const std::vector<ConvexLevel> convex = convex_ways(target);
    const bool is_convex = has_triangles() && std::any_of(convex.begin(), convex.end(), [&](const ConvexLevel& c) {
                             return best.propose_exact(c.way, c.level);
                           });
    if (is_convex) return best.take();
    propose_meshes(target, best);
    for (const ConvexLevel& c : convex) best.propose(c.way, c.level);
    return best.take();
  }

  [[nodiscard]] std::int64_t longest_side() const {
    const VoxelCoord size = ruler->box.size();
    return std::max({size.x, size.y, size.z});
  }

  /// Calls work(). A refusal for memory names a limit for all steps.
  template <class Work>
  void naming_all(const Work& work) {
    try {
      work();
    } catch (const NeedsMemory& e) {
      fail_with_limit(e,
                      [&] { return chain_limit(voxels.header(), voxels.solid(), options, all, options.scene.size()); });
    }
  }

  LodOptions options;
  const PassContext all;
  PassContext& context;  // its memory shrinks by what is held here
  Bounds3d scene_bounds;
  LevelVoxels voxels;
  std::optional<Ruler> ruler;
  double last_scale = 0;
  struct {
    LatticeMesh mesh;
    MeshMeasures measures;
    double scale_world = 0;
  } finer;                   // the bounding level that was meshed last, or the scene's own surface
  bool asked_scene = false;  // whether the scene has such a surface
  struct {
    std::unique_ptr<Enclosed> scene;
    int reductions = -1;
  } enclosed;  // the scene in the frame of these voxels, if it is small enough to be kept

 private:
  /// That a level lies around, or follows.
  [[nodiscard]] bool has_triangles() const {
    return (options.mode == MeshMode::fit || options.enclose == Enclose::scene) && !options.scene.empty();
  }

  [[nodiscard]] bool is_bounding() const { return options.mode == MeshMode::bounding; }

  [[nodiscard]] static bool is_of_few_faces(const LodTarget& target) {
    return target.faces > 0 && target.faces < kTryVolumeBelow && target.error_world == 0;
  }

  /// Whether nothing is asked but a number of faces, of a scene of few triangles: these tell quickly what is near.
  [[nodiscard]] bool is_simple(const LodTarget& target) const {
    return is_bounding() && has_triangles() && !options.field && is_by_budget(target) &&
           options.scene.size() <= MeshParams::kSimpleScene;
  }

  [[nodiscard]] LodGround ground() const {
    return {ruler->voxel(), scene_bounds.diagonal(), ruler->dense_faces, longest_side()};
  }

  // --- What is proposed ---

  [[nodiscard]] std::vector<ConvexLevel> convex_ways(const LodTarget& target) const {
    const bool may_be = is_bounding() && options.enclose != Enclose::closing && target.faces > 0;
    if (!may_be || target.error_world > 0) return {};
    LodLevel place;
    place.mesh.frame = voxels.frame();
    place.mesh.provenance = voxels.header().provenance;
    place.reductions = voxels.reductions();
    place.attempts = 1;
    if (!has_triangles()) return convex_levels(place, ruler->bounds(), {}, target.faces);
    return convex_levels(place, scene_bounds, scene_corners(voxels.frame(), options.scene), target.faces);
  }

  void propose_meshes(const LodTarget& target, BestLevel& best) {
    if (continues(target)) {
      best.propose("finer", coarser(target));
    } else {
      propose_closings(target, best);
    }
    if (is_bounding()) {
      const LodLevel& level = best.level();
      finer = {level.mesh, level.counts.levels.front().measures, level.scale_world};
    }
  }

  /// One closing, but of simple scenes, which take little time, each up to twice the scale of the budget. What a
  /// closing joins, few faces need not show; what it leaves apart, they follow.
  void propose_closings(const LodTarget& target, BestLevel& best) {
    const double whole = first_scale(ground(), target, last_scale);
    std::optional<Closing> closing_of_best;
    int attempts = 1;
    for (double scale = is_by_budget(target) ? std::max(whole / finest(), last_scale) : whole;;
         scale = larger_scale(scale)) {
      voxels.reduce_to(
          reductions_for(ground(), target, finest_scale(options.field, std::max(scale, whole)), voxels.reductions()));
      const bool last = larger_scale(scale) > scene_bounds.diagonal() / 2;
      Closing closing = voxels.closed_at(scale);
      if (scale < whole && voxels.parts_and_holes(closing) * kFacesPerPart > target.faces) continue;
      const bool few = is_bounding() && is_of_few_faces(target);
      LodLevel level = mesh(mesh_params(target, scale), closing, few ? Keep::all : Keep::solid);
      const bool by_volume = few && may_reach_by_volume(level, target.faces);
      const auto has_reached = [&] { return target.faces == 0 || level.mesh.triangles.size() <= target.faces; };
      const bool keeps_near = has_reached() || !by_volume;
      if (!keeps_near) level = mesh(least_volume(target), closing, Keep::all);
      if (!has_reached() && !last) {
        attempts += scale >= whole;
        continue;
      }
      level.attempts = attempts;
      if (best.propose(keeps_near ? "closing" : "least volume", std::move(level))) {
        closing_of_best.reset();
        if (by_volume && keeps_near) closing_of_best = std::move(closing);
      }
      if (!is_simple(target) || best.is_exact() || last || scale >= 2 * whole) break;
    }
    if (closing_of_best && !best.is_exact()) {
      LodLevel level = mesh(least_volume(target), *closing_of_best, Keep::solid);
      level.attempts = best.level().attempts;
      best.propose("least volume", std::move(level));
    }
    last_scale = best.level().scale_world;
  }

  /// The scale that is tried after another one: twice as large, or so many times that something is closed by it.
  [[nodiscard]] double larger_scale(double scale) const {
    const double least = kLeastScaleVox * voxels.frame().voxel;
    if (scale == 0) return least;
    do scale *= 2;
    while (scale < least);
    return scale;
  }

  [[nodiscard]] double finest() const { return is_bounding() ? kFinest : kFinestOfFit; }

  /// Whether the target follows from the level before: parts and holes of that have faces enough for their shape.
  [[nodiscard]] bool continues(const LodTarget& target) {
    if (!is_by_budget(target) || !is_bounding() || is_of_few_faces(target)) return false;
    begin_with_scene();
    if (finer.mesh.triangles.empty() || !(finer.mesh.frame == voxels.frame())) return false;
    return finer.mesh.triangles.size() <= target.faces ||
           (finer.measures.shells + finer.measures.handles) * kFacesPerPart <= target.faces;
  }

  /// Where the scene is a surface that bounds a solid, the levels follow from it, as from a finer level.
  void begin_with_scene() {
    if (std::exchange(asked_scene, true) || !finer.mesh.triangles.empty()) return;
    if (!has_triangles() || options.field || options.scene.size() > ruler->dense_faces)
      return;  // then the voxels' surface is the shorter way
    std::optional<LatticeMesh> surface = outward_scene(options.scene, voxels.frame());
    if (!surface) return;
    surface->provenance = voxels.header().provenance;
    const MeshMeasures measures = bp::measure(*surface);
    finer = {std::move(*surface), measures, 0};
  }

  // --- Meshes ---

  /// The level before with fewer faces.
  LodLevel coarser(const LodTarget& target) {
    MeshParams params = mesh_params(target, first_scale(ground(), target, last_scale));
    params.start = &finer.mesh;
    LodLevel level = mesh(std::move(params), voxels.as_it_is(finer.scale_world), Keep::solid);
    level.attempts = 1;
    return level;
  }

  /// Around the voxels as they are.
  LodLevel cage(const LodTarget& target) {
    MeshParams params;
    params.faces = {target.faces};
    params.enclose = Enclose::closing;
    params.cage = options.cage;
    return mesh(std::move(params), voxels.as_it_is(0), Keep::solid);
  }

  /// keep: whether the closing is wanted again.
  LodLevel mesh(MeshParams params, const Closing& closing, Keep keep) {
    LodLevel level;
    level.scale_world = closing.scale_world;
    level.reductions = voxels.reductions();
    context.report("meshing", "levels", 0, 1);
    std::unique_ptr<Enclosed> once;
    if (is_bounding() && options.enclose == Enclose::scene && !options.cage) params.enclosed = &enclosed_scene(once);
    ShelfSource source(closing.header, voxels.solid(), closing.voxels.get(), keep);
    level.mesh = std::move(mesh_stream(source, context, std::move(params), level.counts).front());
    return level;
  }

  [[nodiscard]] MeshParams least_volume(const LodTarget& target) const {
    MeshParams params = mesh_params(target, {});
    params.convex = false;  // hulls and boxes are proposals of their own
    return params;
  }

  /// near_world: as MeshParams has it.
  [[nodiscard]] MeshParams mesh_params(const LodTarget& target, std::optional<double> near_world) const {
    MeshParams params;
    if (target.faces > 0) params.faces = {target.faces};
    // What is enclosed is within a diagonal of a voxel of the scene.
    if (target.error_world > 0)
      params.error_world = std::max(target.error_world - std::sqrt(3.0) * (voxels.frame().voxel + ruler->voxel()),
                                    target.error_world / 4);
    params.near_world = near_world;
    params.mode = options.mode;
    params.enclose = options.enclose;
    if (options.enclose == Enclose::scene) params.distances_to = Enclose::input;  // its voxels, as without
    if (options.mode == MeshMode::fit) {
      params.distances_to.reset();
      params.enclose = options.scene.empty() ? Enclose::closing : Enclose::scene;
      params.scene = options.scene;
    }
    return params;
  }

  /// The triangles in the frame of the voxels; in `once`, if they are too many to be kept beside closings.
  const Enclosed& enclosed_scene(std::unique_ptr<Enclosed>& once) {
    constexpr std::uint64_t kSmallShare = 16;  // of the memory
    if (enclosed.scene && enclosed.reductions == voxels.reductions()) return *enclosed.scene;
    enclosed.scene.reset();
    once = bp::enclosed_scene(options.scene, voxels.header(), voxels.solid());
    if (once->bytes() > context.memory.bytes / kSmallShare) return *once;
    enclosed = {std::move(once), voxels.reductions()};
    return *enclosed.scene;
  }

  void take_off(std::uint64_t bytes) {
    context.memory.bytes -= std::min(context.memory.bytes, bytes);
    context.pieces = context.pieces.without(bytes);
  }
};

LodChain::LodChain(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends,
                   LodOptions options)
    : state_(std::make_unique<State>(header, std::move(solid), backends, std::move(options))) {}

LodChain::~LodChain() = default;

std::uint64_t LodChain::dense_faces() const {
  return state_->ruler->dense_faces;
}

std::int64_t LodChain::longest_side_vox() const {
  return state_->longest_side();
}

LodLevel LodChain::make(const LodTarget& target) {
  LodLevel level;
  state_->naming_all([&] { level = state_->make(target); });
  return level;
}

}  // namespace bp
