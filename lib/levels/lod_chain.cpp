#include "lib/levels/lod_chain.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/closing/closing.h"
#include "lib/core/error.h"
#include "lib/grid/shelf_stream.h"
#include "lib/hulls/convex_hull.h"
#include "lib/levels/detail/few_faces_level.h"
#include "lib/levels/detail/hull_level.h"
#include "lib/levels/detail/outside.h"
#include "lib/levels/detail/prism_level.h"
#include "lib/pass/measure/shape_rules.h"
#include "lib/pass/mesh/scene_check.h"
#include "lib/surface/repair.h"
#include "lib/surface/surface.h"
#include "lib/volume/reduce.h"
#include "lib/volume/topology.h"

namespace bp {

namespace {

constexpr int kMostAttempts = 12;    // scales for one level
constexpr double kExactVox = 0.125;  // of error: a level of so little is not tried to come nearer

// Faces that a part or a hole of a closing at half of the scale should leave to show its shape. Balls leave more holes
// than cubes, and what a fit has of a hole need not lie around anything.
constexpr std::uint64_t kFacesPerPart = 100, kFacesPerPartOfFit = 50;

// Of simple scenes, whose triangles tell quickly what is near, levels are tried at other scales, too. At twice the
// scale where the error is so many scales: faces are too few for what is left open, and spikes bridge it. At these
// parts where a level has a face for so many triangles; until its error is so small, as long as each part or hole has
// so many faces, and no room opens.
constexpr double kSpikes = 2.3;
constexpr std::uint64_t kTrianglesPerFace = 4;
constexpr std::array kPartsOfScale{0.25, 0.125};
constexpr std::uint64_t kLeastFacesPerPart = 8;
constexpr double kNearEnoughVox = 0.5, kOpens = 1.5;  // opens: so many times the surface

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

  LodLevel make(const LodTarget& target) {
    const double before = last_scale;
    if (std::optional<LodLevel> level = exact(target)) return std::move(*level);
    LodLevel level = options.cage ? cage(target) : closed(target);
    if (options.cage || !has_ways(target)) measure(level);
    if (is_simple(target)) level = nearest_scale(std::move(level), target, before);
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
    return level;
  }

  using Keep = ShelfSource::Keep;
  struct Closed {
    ScaleField field;
    std::unique_ptr<BrickShelf> voxels;
  };

  LodLevel closed(const LodTarget& target) {
    double scale = first_scale(ground(), target, last_scale);
    Closed closing = half_scale(target, scale);
    for (int attempt = 1;; ++attempt) {
      if (closing.voxels == nullptr) {
        reduce_to(reductions_for(ground(), target, finest_scale(options.field, scale), reductions));
        closing = closing_at(scale);
      }
      LodLevel level = has_ways(target) ? nearest(target, scale, closing) : mesh(mesh_params(target), scale, closing);
      level.attempts = attempt;
      level.reached = target.faces == 0 || level.mesh.triangles.size() <= target.faces;
      if (!level.reached && 2 * scale <= diagonal / 2 && attempt < kMostAttempts) {
        scale *= 2;
        closing = {};
        continue;
      }
      last_scale = scale;
      return level;
    }
  }

  /// Whether nothing is asked but a number of faces, of a scene of few triangles: these tell quickly what is near.
  [[nodiscard]] bool is_simple(const LodTarget& target) const {
    return options.mode == MeshMode::bounding && has_triangles() && !options.cage && !options.field &&
           target.faces > 0 && target.error_world == 0 && !target.scale_world &&
           options.scene.size() <= MeshParams::kSimpleScene;
  }

  /// The nearest of a measured level and those at other scales, `least` or more. Budgets decide scales by the area
  /// alone, as if all of it were curved. A larger scale leaves less to show with the same faces. A smaller one keeps a
  /// level nearer.
  LodLevel nearest_scale(LodLevel level, const LodTarget& target, double least) {
    const auto is_near = [&] { return level.error_world <= kNearEnoughVox * outside->voxel(); };
    if (!level.reached || level.attempts > 1 || is_near()) return level;
    const double whole = level.scale_world;
    const auto try_to_mesh = [&](double scale, const Closed& closing) {
      LodLevel other = mesh(mesh_params(target), scale, closing);
      if (other.mesh.triangles.size() > target.faces) return;
      measure(other);
      other.attempts = 1;
      if (other.error_world >= level.error_world) return;
      level = std::move(other);
      last_scale = scale;
    };
    if (level.error_world > kSpikes * whole) try_to_mesh(2 * whole, closing_at(2 * whole));
    if (options.scene.size() > kTrianglesPerFace * target.faces) return level;
    const auto surface_of = [&](const Closed& c) { return double(count_faces(ShelfSurface(*c.voxels, header.frame))); };
    // Where a room opens that the whole scale closes, its walls would take as many faces again. All of the scene's
    // triangles are enough for them.
    const bool may_open = options.scene.size() <= target.faces;
    const double most_surface = may_open ? 0 : kOpens * surface_of(closing_at(whole));
    double last = whole;
    for (const double part : kPartsOfScale) {
      const double scale = std::max(part * whole, least);
      if (is_near() || scale >= last) break;
      const Closed closing = closing_at(scale);
      if (!has_faces_for_parts(*closing.voxels, target.faces, kLeastFacesPerPart)) break;
      if (!may_open && surface_of(closing) > most_surface) break;
      try_to_mesh(scale, closing);
      last = scale;
    }
    return level;
  }

  /// Whether several ways lead to the level, which is measured then, and the nearest one is taken.
  [[nodiscard]] bool has_ways(const LodTarget& target) const {
    return options.mode == MeshMode::bounding && is_of_few_faces(target);
  }

  LodLevel nearest(const LodTarget& target, double scale, const Closed& closing) {
    LodLevel level = mesh(mesh_params(target), scale, closing, Keep::all);
    measure(level);
    if (!may_have_faces(level, target.faces)) return level;
    MeshParams params = mesh_params(target);  // anew: they hold the scene's triangles
    params.near = false;
    params.convex = false;  // convex_or() chooses by distance
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

  /// The closing at half of `scale`, which is halved then, where a budget has faces enough for what parts and holes it
  /// leaves. Where it does not, they take the faces that shape wants, and all of the level is farther off.
  Closed half_scale(const LodTarget& target, double& scale) {
    const double half = std::max(scale / 2, last_scale);
    const bool by_budget = target.faces > 0 && target.error_world == 0 && !target.scale_world;
    if (!by_budget || half >= scale) return {};
    const int n = reductions_for(ground(), target, finest_scale(options.field, half), reductions);
    if (half < kLeastScaleVox * outside->voxel() * std::ldexp(1.0, n)) return {};
    reduce_to(n);
    Closed closing = closing_at(half);
    if (!has_faces_for_parts(*closing.voxels, target.faces, faces_per_part())) return {};
    scale = half;
    return closing;
  }

  /// Of a closing: whether so many faces are enough for each of its parts and holes.
  [[nodiscard]] bool has_faces_for_parts(BrickShelf& closing, std::uint64_t faces, std::uint64_t per_part) const {
    repair_contacts(closing);  // as meshing would: it closes the tiniest holes
    check_memory_for_topology(closing);
    const SolidTopology topology = topology_of(closing);
    return (topology.parts + topology.handles) * per_part <= faces;
  }

  [[nodiscard]] std::uint64_t faces_per_part() const {
    return options.mode == MeshMode::fit ? kFacesPerPartOfFit : kFacesPerPart;
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

  [[nodiscard]] MeshParams mesh_params(const LodTarget& target) const {
    MeshParams params;
    if (target.faces > 0) params.faces = {target.faces};
    // What is enclosed is within a diagonal of a voxel of the scene.
    if (target.error_world > 0)
      params.error_world = std::max(target.error_world - std::sqrt(3.0) * (header.frame.voxel + outside->voxel()),
                                    target.error_world / 4);
    params.near = true;
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
