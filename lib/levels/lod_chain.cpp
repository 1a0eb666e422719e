#include "lib/levels/lod_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lib/closing/closing.h"
#include "lib/core/error.h"
#include "lib/grid/shelf_stream.h"
#include "lib/hulls/convex_hull.h"
#include "lib/levels/detail/few_faces_level.h"
#include "lib/levels/detail/hull_level.h"
#include "lib/levels/detail/outside.h"
#include "lib/levels/detail/prism_level.h"
#include "lib/pass/measure/shape_rules.h"
#include "lib/pass/mesh/outward_scene.h"
#include "lib/pass/mesh/scene_check.h"
#include "lib/surface/repair.h"
#include "lib/surface/surface.h"
#include "lib/volume/reduce.h"
#include "lib/volume/topology.h"

namespace bp {

namespace {

constexpr double kExactVox = 0.125;  // of error: a level of so little is not tried to come nearer

// A budget is closed at the least of the scales from a kFinest-th of its own on at which each part and hole of the
// closing has so many faces to show its shape. Where parts and holes take all faces, the rest of the level is far off.
// A fit lies on the closing, and has its noise.
constexpr double kFinest = 8, kFinestOfFit = 2;
constexpr std::uint64_t kFacesPerPart = 50;
constexpr double kNearEnoughVox = 0.5;  // of error: no other closing of a simple scene is tried

}  // namespace

struct LodChain::State {
  State(const StreamHeader& h, std::unique_ptr<BrickShelf> s, Backends& b, LodOptions o)
      : options(std::move(o)),
        context(options.context),
        backends(b),
        header(h),
        solid(std::move(s)),
        diagonal(h.bounds.diagonal()) {
    if (solid->coords().empty()) fail(ErrorCode::bad_input, "the scene fills no voxel; there is nothing to mesh");
    take_off(options.scene.size() * sizeof(TriangleD));
    // Here, and not at each level: in voxels of twice the size a corner may lie so near to a side, as these are
    // rounded, that the voxel beyond would have been set, too.
    if (options.mode == MeshMode::bounding && options.enclose == Enclose::scene)
      require_within(options.scene, header.frame, *solid);
    outside = std::make_unique<Outside>(*solid, options.surface.get(), options.mode == MeshMode::fit && has_triangles(),
                                        header.frame, context.memory);
    options.surface.reset();
    take_off(outside->bytes());
    last_scale = options.least_scale_world;
  }

  /// Where the scene is a surface that bounds a solid, the levels follow from it, as from a finer level.
  void begin_with_scene() {
    if (std::exchange(asked_scene, true) || !finer.mesh.triangles.empty()) return;
    if (!has_triangles() || options.field || options.scene.size() > outside->dense_faces)
      return;  // then the voxels' surface is the shorter way
    std::optional<LatticeMesh> surface = outward_scene(options.scene, header.frame);
    if (!surface) return;
    surface->provenance = header.provenance;
    const MeshMeasures measures = bp::measure(*surface);
    finer = {std::move(*surface), measures, 0};
  }

  LodLevel make(const LodTarget& target) {
    if (std::optional<LodLevel> level = exact(target)) return std::move(*level);
    LodLevel level = options.cage ? cage(target) : continues(target) ? coarser(target) : closed(target);
    if (options.mode == MeshMode::bounding && !options.cage)
      finer = {level.mesh, level.counts.levels.front().measures, level.scale_world};
    return may_be_convex(target) ? convex_or(std::move(level), target) : level;
  }

  void measure(LodLevel& level) {
    context.report("measuring", "levels", 0, 1);
    outside->measure(level, options.mode, has_triangles() ? &options.scene : nullptr);
  }

  /// That a level lies around, or follows.
  [[nodiscard]] bool has_triangles() const {
    return (options.mode == MeshMode::fit || options.enclose == Enclose::scene) && !options.scene.empty();
  }

  /// Around the voxels as they are.
  LodLevel cage(const LodTarget& target) {
    LodLevel level;
    MeshParams params;
    params.faces = {target.faces};
    params.enclose = Enclose::closing;
    params.cage = options.cage;
    context.report("meshing", "levels", 0, 1);
    ShelfSource source(header, *solid, nullptr, ShelfSource::Keep::solid);
    level.mesh = std::move(mesh_stream(source, context, std::move(params), level.counts).front());
    measure(level);
    return level;
  }

  using Keep = ShelfSource::Keep;
  struct Closed {
    ScaleField field;
    std::unique_ptr<BrickShelf> voxels;
  };

  /// The nearest of the levels from the closings that are tried, measured: one, but of simple scenes, which take little
  /// time, each up to twice the scale of the budget. What a closing joins, few faces need not show; what it leaves
  /// apart, they follow.
  LodLevel closed(const LodTarget& target) {
    const double whole = first_scale(ground(), target, last_scale);
    std::optional<LodLevel> best;
    int attempts = 1;
    for (double scale = is_by_budget(target) ? std::max(whole / finest(), last_scale) : whole;; scale *= 2) {
      const double finest_told = finest_scale(options.field, std::max(scale, whole));
      reduce_to(reductions_for(ground(), target, finest_told, reductions));
      const bool last = 2 * scale > diagonal / 2;
      const Closed closing = closing_at(scale);
      if (scale < whole && !has_faces_for_parts(closing, target)) continue;
      LodLevel level =
          has_ways(target) ? nearest(target, scale, closing) : mesh(mesh_params(target, scale), scale, closing);
      level.attempts = attempts;
      level.reached = target.faces == 0 || level.mesh.triangles.size() <= target.faces;
      if (!level.reached && !last) {
        attempts += scale >= whole;
        continue;
      }
      if (!has_ways(target)) measure(level);
      if (!best || is_better(level, *best, target.faces)) best = std::move(level);
      const bool is_near = best->error_world <= kNearEnoughVox * outside->voxel();
      if (is_simple(target) && !is_near && !last && scale < 2 * whole) continue;
      last_scale = best->scale_world;
      return std::move(*best);
    }
  }

  [[nodiscard]] double finest() const { return options.mode == MeshMode::fit ? kFinestOfFit : kFinest; }

  /// Whether nothing is asked but a number of faces, of a scene of few triangles: these tell quickly what is near.
  [[nodiscard]] bool is_simple(const LodTarget& target) const {
    return options.mode == MeshMode::bounding && has_triangles() && !options.field && is_by_budget(target) &&
           options.scene.size() <= MeshParams::kSimpleScene;
  }

  /// Whether the target follows from the level before: parts and holes of that have faces enough for their shape.
  [[nodiscard]] bool continues(const LodTarget& target) {
    if (!is_by_budget(target) || options.mode != MeshMode::bounding || has_ways(target)) return false;
    begin_with_scene();
    if (finer.mesh.triangles.empty() || !(finer.mesh.frame == header.frame)) return false;
    return finer.mesh.triangles.size() <= target.faces ||
           (finer.measures.shells + finer.measures.handles) * kFacesPerPart <= target.faces;
  }

  /// The level before with fewer faces, measured.
  LodLevel coarser(const LodTarget& target) {
    LodLevel level;
    level.scale_world = finer.scale_world;
    level.reductions = reductions;
    level.attempts = 1;
    MeshParams params = mesh_params(target, first_scale(ground(), target, last_scale));
    params.start = &finer.mesh;
    context.report("meshing", "levels", 0, 1);
    ShelfSource source(header, *solid, nullptr, Keep::solid);
    level.mesh = std::move(mesh_stream(source, context, std::move(params), level.counts).front());
    level.reached = level.mesh.triangles.size() <= target.faces;
    measure(level);
    return level;
  }

  /// Whether nothing but a number of faces decides the scale.
  [[nodiscard]] static bool is_by_budget(const LodTarget& target) {
    return target.faces > 0 && target.error_world == 0 && !target.scale_world;
  }

  /// Whether the faces of the target suffice to show the shape of the parts and holes of a closing.
  [[nodiscard]] bool has_faces_for_parts(const Closed& closing, const LodTarget& target) const {
    repair_contacts(*closing.voxels);  // as meshing would: it closes the tiniest holes
    check_memory_for_topology(*closing.voxels);
    const SolidTopology topology = topology_of(*closing.voxels);
    return (topology.parts + topology.handles) * kFacesPerPart <= target.faces;
  }

  /// Whether several ways lead to the level, which is measured then, and the nearest one is taken.
  [[nodiscard]] bool has_ways(const LodTarget& target) const {
    return options.mode == MeshMode::bounding && is_of_few_faces(target);
  }

  LodLevel nearest(const LodTarget& target, double scale, const Closed& closing) {
    LodLevel level = mesh(mesh_params(target, scale), scale, closing, Keep::all);
    measure(level);
    if (!may_have_faces(level, target.faces)) return level;
    MeshParams params = mesh_params(target, {});  // anew: they hold the scene's triangles
    params.convex = false;                        // convex_or() chooses by distance
    LodLevel by_volume = mesh(std::move(params), scale, closing);
    measure(by_volume);
    return is_better(by_volume, level, target.faces) ? by_volume : level;
  }

  [[nodiscard]] bool may_be_convex(const LodTarget& target) const {
    return !options.cage && options.mode == MeshMode::bounding && options.enclose != Enclose::closing &&
           target.faces > 0 && target.error_world == 0;
  }

  /// A scene that is a box, flat or convex as its box, prism or hull. Nothing has to be closed or meshed then.
  std::optional<LodLevel> exact(const LodTarget& target) {
    if (!may_be_convex(target) || options.enclose != Enclose::scene) return {};
    LodLevel place;
    place.mesh.frame = header.frame;
    place.mesh.provenance = header.provenance;
    place.scale_world = first_scale(ground(), target, last_scale);
    place.reductions = reductions;
    place.attempts = 1;
    place.counts.levels.resize(1);
    const std::vector<Vec3d> corners = scene_corners(place.mesh.frame, options.scene);
    if (corners.empty()) return {};
    const double near = kExactVox * outside->voxel();
    std::optional<LodLevel> found;
    const auto take = [&](std::optional<LodLevel> level) {
      if (!level || !may_be_near(*level, corners, near / header.frame.voxel * kLatticePerVoxel)) return false;
      measure(*level);
      if (level->error_world <= near) found = std::move(level);
      return found.has_value();
    };
    if (take(box_for(target, place)) || take(prism_level(place, corners, target.faces)) ||
        take(hull_level(place, corners, target.faces)))
      last_scale = place.scale_world;
    return found;
  }

  /// A box, a prism or a hull around all that is enclosed. Boxes and hulls are measured only where they may be better.
  LodLevel convex_or(LodLevel level, const LodTarget& target) {
    const auto take = [&](LodLevel other) {
      measure(other);
      if (is_better_box(other, level, target.faces)) level = std::move(other);
    };
    if (auto box = box_for(target, level)) {
      if (has_ways(target) || has_few_faces(level) || holds_no_more(*box, level)) take(std::move(*box));
    }
    if (options.enclose != Enclose::scene) return level;
    const std::vector<Vec3d> corners = scene_corners(level.mesh.frame, options.scene);
    if (auto prism = prism_level(level, corners, target.faces)) take(std::move(*prism));
    auto hull = hull_level(level, corners, target.faces);
    if (hull && holds_no_more(*hull, level, kNearlyConvex)) take(std::move(*hull));
    return level;
  }

  [[nodiscard]] std::optional<LodLevel> box_for(const LodTarget& target, const LodLevel& level) const {
    if (target.faces < kFacesOfBox) return {};
    return box_level(level, options.enclose == Enclose::scene ? header.bounds : outside->bounds());
  }

  [[nodiscard]] std::int64_t longest_side() const {
    const VoxelCoord size = outside->box.size();
    return std::max({size.x, size.y, size.z});
  }

  LodOptions options;
  PassContext& context;  // its memory shrinks by what is held here
  Backends& backends;
  StreamHeader header;  // of `solid`
  std::unique_ptr<BrickShelf> solid;
  double diagonal;
  std::unique_ptr<Outside> outside;
  int reductions = 0;
  double last_scale = 0;
  struct {
    LatticeMesh mesh;
    MeshMeasures measures;
    double scale_world = 0;
  } finer;                   // the bounding level made last, or the scene's own surface
  bool asked_scene = false;  // whether it has such a surface

 private:
  void take_off(std::uint64_t bytes) {
    context.memory.bytes -= std::min(context.memory.bytes, bytes);
    context.pieces = context.pieces.without(bytes);
  }

  [[nodiscard]] LodGround ground() const { return {outside->voxel(), diagonal, outside->dense_faces, longest_side()}; }

  void reduce_to(int n) {
    for (; reductions < n; ++reductions) {
      auto coarse = context.make_shelf();
      reduce(*solid, header.frame, *coarse);
      header = reduced(header);
      solid = std::move(coarse);
    }
  }

  [[nodiscard]] StreamHeader closed_header(const ScaleField& field) const {
    StreamHeader closed = header;
    closed.bricks = closing_bricks(header, field);
    closed.has_closing = true;
    closed.scale = field;
    closed.element = options.closing.element;
    return closed;
  }

  [[nodiscard]] ScaleField field_at(double scale) const {
    ScaleField constant;
    constant.base = scale;
    if (!options.field) return constant;
    ScalePlan plan = *options.field;
    plan.field = plan.field.scaled(scale / plan.field.base);
    return measured(plan, header, *solid, {0, context}).field;
  }

  Closed closing_at(double scale) {
    CloseOptions o;
    o.context = context;
    ScaleField field = field_at(scale);
    auto voxels = close_shelf(header, *solid, backends, field, options.closing, o);
    return {std::move(field), std::move(voxels)};
  }

  /// Against what the surface is to be meshed in, of which nothing is taken yet.
  void check_memory_for_topology(const BrickShelf& closing) const {
    const std::uint64_t bytes = topology_bytes(closing), most = context.pieces.bytes();
    if (bytes > most)
      throw NeedsMemory("counting the parts and holes of a level", bytes, most,
                        context.pieces.limit_with(bytes - most));
  }

  /// keep: whether the closing is wanted again.
  LodLevel mesh(MeshParams params, double scale, const Closed& closing, Keep keep = Keep::solid) {
    LodLevel level;
    level.scale_world = scale;
    level.reductions = reductions;
    context.report("meshing", "levels", 0, 1);
    ShelfSource source(closed_header(closing.field), *solid, closing.voxels.get(), keep);
    level.mesh = std::move(mesh_stream(source, context, std::move(params), level.counts).front());
    return level;
  }

  /// near_world: as MeshParams has it.
  [[nodiscard]] MeshParams mesh_params(const LodTarget& target, std::optional<double> near_world) const {
    MeshParams params;
    if (target.faces > 0) params.faces = {target.faces};
    // What is enclosed is within a diagonal of a voxel of the scene.
    if (target.error_world > 0)
      params.error_world = std::max(target.error_world - std::sqrt(3.0) * (header.frame.voxel + outside->voxel()),
                                    target.error_world / 4);
    params.near_world = near_world;
    params.mode = options.mode;
    params.enclose = options.enclose;
    if (options.enclose == Enclose::scene) {  // distances are to its voxels, as without
      params.scene = options.scene;
      params.known_within = true;
      params.distances_to = Enclose::input;
    }
    if (options.mode == MeshMode::fit) {
      params.distances_to.reset();
      params.enclose = options.scene.empty() ? Enclose::closing : Enclose::scene;
      params.scene = options.scene;
    }
    return params;
  }
};

LodChain::LodChain(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends,
                   LodOptions options)
    : state_(std::make_unique<State>(header, std::move(solid), backends, std::move(options))) {}

LodChain::~LodChain() = default;

std::uint64_t LodChain::dense_faces() const {
  return state_->outside->dense_faces;
}

std::int64_t LodChain::longest_side_vox() const {
  return state_->longest_side();
}

LodLevel LodChain::make(const LodTarget& target) {
  return state_->make(target);
}

}  // namespace bp
