#include "lib/pass/mesh/mesh_pass.h"

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"
#include "lib/enclosed/enclosed_triangles.h"
#include "lib/enclosed/enclosed_voxels.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/pass/mesh/detail/coarse_start.h"
#include "lib/pass/mesh/detail/components.h"
#include "lib/pass/mesh/detail/fit_target.h"
#include "lib/pass/mesh/detail/ground.h"
#include "lib/pass/mesh/detail/level_inputs.h"
#include "lib/pass/mesh/detail/level_start.h"
#include "lib/pass/mesh/detail/make_level.h"
#include "lib/pass/mesh/detail/proxy_limits.h"
#include "lib/pass/mesh/detail/scaled_edges.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/quads/limb_cage.h"
#include "lib/quads/quad_slack.h"
#include "lib/quads/quads.h"
#include "lib/simplify/surface_tree.h"
#include "lib/tighten/tight_proxy.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

/// Distance from the voxels' surface that a fit may reach at first: this many scales, and a voxel.
constexpr double kReachOfScale = 0.25;

/// Returns the edge of the voxels around a level. It is the stream's, or larger: so large that the next level's dense
/// surface has just enough faces, but at most a quarter of its share of the error.
double level_voxel(const LatticeMesh& inner, double voxel, std::uint64_t faces, double error_share) {
  // Dense faces for each face, since there is no finer surface to tighten against.
  constexpr double kFacesPerFace = 200;
  constexpr double kVoxelsPerShare = 4;  // a touched voxel reaches as far as its diagonal
  const double most = error_share > 0 ? error_share / kVoxelsPerShare : HUGE_VAL;
  const double enough = std::sqrt(kDensePerArea * area_world(inner) / (kFacesPerFace * double(faces)));
  return std::max(voxel, std::min(enough, most));
}

std::uint64_t bytes_of(const std::vector<LatticeMesh>& meshes) {
  std::uint64_t sum = 0;
  for (const LatticeMesh& mesh : meshes)
    sum += mesh.vertices.size() * sizeof(mesh.vertices[0]) + mesh.triangles.size() * sizeof(mesh.triangles[0]);
  return sum;
}

/// Returns the memory that is left when the limits of a level take `bytes`.
PieceMemory beside_limits(const PieceMemory& memory, std::uint64_t bytes) {
  if (bytes <= memory.bytes()) return memory.without(bytes);
  throw NeedsMemory("keeping a level within a distance", bytes, memory.bytes(), memory.limit_for(bytes));
}

LatticeMesh cage_around(const BrickShelf& meshed, const GridFrame& frame, const Enclosed& enclosed, std::uint64_t faces,
                        const CageParams& params, const PassContext& context, LevelCounts& counts) {
  counts.simplify.stop = StopReason::faces;
  std::shared_ptr<const Limbs> model = params.limbs;
  if (model == nullptr) model = std::make_shared<Limbs>(meshed, meshed);
  CageFit fit;
  const auto steps = [&](std::uint64_t done, std::uint64_t total) {
    context.report("keeping limbs apart", "quads", done, total);
  };
  LatticeMesh mesh = cage_with_limbs(meshed, frame, enclosed, faces, params.plane, *model, fit, steps);
  if (mesh.triangles.empty())
    fail(ErrorCode::bad_argument, "{} faces: {}", faces,
         params.plane ? "a symmetric cage has at least 20 triangles" : "a cage of quads has at least 12 triangles");
  counts.limbs.count = model->count();
  for (const LatticeCoord& tip : fit.joined) counts.limbs.joined.push_back(frame.world(tip));
  return mesh;
}

/// Makes a proxy around `dense`, or within it in mode inside.
LatticeMesh proxy_around(const LevelInputs& in, const SurfaceSource& dense, const Enclosed* enclosed,
                         std::uint64_t faces, const CoarseStarts* starts, SimplifyParams params, LevelCounts& counts) {
  const MeshParams& asked = in.params;
  if (faces >= kLeastFacesWithRoom) params.room = room_around(dense.box(), faces);  // the box reads all voxels
  if (asked.near_world && params.limits == nullptr && faces > 0)
    params.reach = (*asked.near_world / dense.frame().voxel + 1) * kLatticePerVoxel;
  const bool only_faces = faces > 0 && params.limits == nullptr && !params.edge_limit && !asked.near_world;
  const bool few = only_faces && faces < kFewFaces;
  params.dense = asked.start == nullptr;
  LatticeMesh proxy = asked.start ? take(tight_proxy(*asked.start, *enclosed, params, asked.halfway), counts)
                                  : make_level(dense, starts, enclosed, params, few, asked.halfway, counts);
  if (only_faces && !in.inside() && asked.convex && enclosed != nullptr) take_convex(proxy, *enclosed, faces, counts);
  if (!asked.quads) return proxy;
  if (enclosed != nullptr) proxy = make_room_for_quads(proxy, *enclosed, params);
  proxy.quads = pair_triangles(proxy, QuadKeeps::enclosed, enclosed);
  return proxy;
}

/// Makes all levels, one after the other.
class LevelMaker {
 public:
  LevelMaker(const StreamHeader& header, const PassContext& context, MeshParams params, MeshCounts& counts)
      : params_(std::move(params)),
        in_{header, params_, context.make_shelf},
        context_(context),
        memory_(context.pieces),
        counts_(counts) {}

  std::vector<LatticeMesh> run(const Shelves& shelves) {
    const std::uint64_t triangles = params_.scene.size();
    return naming_limit([&] { return make(shelves); },
                        [&] { return least_limit(in_, context_.pieces, shelves, triangles); });
  }

 private:
  std::vector<LatticeMesh> make(const Shelves& shelves) {
    const std::vector<std::uint64_t> faces = params_.faces.empty() ? std::vector<std::uint64_t>{0} : params_.faces;
    Start start = make_start(in_, memory_, shelves, counts_);
    PassContext left = context_;
    if (start.mesh) left.pieces = left.pieces.without(start.mesh->triangles.size() * kBytesPerKeptFace);
    bounds_.volume_world = (in_.inside() ? -1 : 1) * params_.volume_ratio * counts_.solid_volume_world;
    ground_ = make_ground(shelves, params_, start, in_.header.fill, left);
    near_ = in_.near_of(*shelves.meshed);
    memory_ = left.pieces.without(ground_.bytes() + in_.edge_bytes(in_.header.frame, near_));
    const bool fit = params_.mode == MeshMode::fit;
    const double error_share = params_.error_world / double(fit ? 1 : faces.size());
    bounds_.error_world = error_share;
    if (fit) return fits(shelves, *start.surface, faces);
    if (params_.cage) {
      return {finish(in_.header.frame, faces[0], [&](const SimplifyParams&, LevelCounts& counts) {
        return cage_around(*shelves.meshed, in_.header.frame, *ground_.enclosed, faces[0], *params_.cage, context_,
                           counts);
      })};
    }
    const CoarseStarts starts{*shelves.meshed, in_.header, in_.make_shelf};
    std::vector<LatticeMesh> levels{
        finish(*start.surface, ground_.enclosed, faces[0], in_.is_by_faces(faces[0]) ? &starts : nullptr)};
    ground_.made.reset();
    ground_.enclosed = nullptr;
    start = {};
    for (std::size_t i = 1; i < faces.size(); ++i) {
      bounds_.error_world = error_share * double(i + 1);
      memory_ = context_.pieces.without(ground_.bytes() + bytes_of(levels));
      levels.push_back(next_level(levels.back(), faces[i], error_share));
    }
    return levels;
  }

  /// Makes a level around `before`; in mode inside, a level within it.
  LatticeMesh next_level(const LatticeMesh& before, std::uint64_t faces, double error_share) {
    const double voxel = level_voxel(before, in_.header.frame.voxel, faces, error_share);
    if (!in_.inside()) {
      const auto around = in_.make_shelf();
      const GridFrame frame = voxels_around(before, voxel, in_.make_shelf, memory_, *around);
      near_ = in_.near_of(*around);
      memory_ = memory_.without(in_.edge_bytes(frame, near_));
      LatticeMesh level = finish_around(before, ShelfSurface(*around, frame), faces);
      near_ = nullptr;  // the voxels end here
      return level;
    }
    LatticeMesh dense = surface_within(before, voxel, in_.make_shelf, memory_);
    drop_small_components(dense, params_.least_part);  // the level may fall into several parts
    return finish_around(before, MeshSurface(dense), faces);
  }

  LatticeMesh finish_around(const LatticeMesh& before, const SurfaceSource& dense, std::uint64_t faces) {
    if (!params_.tighten) return finish(dense, nullptr, faces);
    const EnclosedTriangles enclosed(drawable_world_triangles(before), dense.frame());
    memory_ = memory_.without(enclosed.bytes());
    return finish(dense, &enclosed, faces);
  }

  /// Makes levels of detail that do not enclose, all from the same fine surface.
  std::vector<LatticeMesh> fits(const Shelves& shelves, const SurfaceSource& dense,
                                const std::vector<std::uint64_t>& faces) {
    const EnclosedVoxels near(*shelves.meshed);
    memory_ = memory_.without(near.bytes());
    const FitTarget target = params_.enclose == Enclose::scene ? scene_target(*ground_.tree, dense.frame(), kFitInset)
                                                               : inset_target(kFitInset);
    const FineFit fine = fine_fit(dense, faces[0], target, in_.edges_for(dense.frame()), memory_);
    std::vector<LatticeMesh> levels;
    for (const std::uint64_t n : faces) {
      levels.push_back(finish(dense.frame(), n, [&](SimplifyParams params, LevelCounts& counts) {
        params.enclosed = &near;
        if (n > 0 && params.limits == nullptr)
          params.reach = (kReachOfScale * in_.header.scale.base / dense.frame().voxel + 1) * kLatticePerVoxel;
        LatticeMesh level = fit_level(fine, params, counts.simplify);
        if (params_.quads) level.quads = pair_triangles(level, QuadKeeps::nothing, nullptr);
        return level;
      }));
    }
    return levels;
  }

  LatticeMesh finish(const SurfaceSource& dense, const Enclosed* enclosed, std::uint64_t faces,
                     const CoarseStarts* starts = nullptr) {
    return finish(dense.frame(), faces, [&](SimplifyParams params, LevelCounts& counts) {
      return proxy_around(in_, dense, enclosed, faces, starts, std::move(params), counts);
    });
  }

  /// Makes one level by make(params, counts), and fills its counts and measures. If edges yield, it uses the shortest
  /// limit on edges that the number of faces allows.
  template <class Make>
  LatticeMesh finish(const GridFrame& frame, std::uint64_t faces, const Make& make) {
    constexpr double kLooser = 1.5, kMostFactor = 1000;
    LevelCounts& counts = counts_.levels.emplace_back();
    for (double factor = params_.edge_factor;;) {
      LatticeMesh level = finish(frame, faces, factor, make, counts);
      const std::uint64_t left = level.triangles.size();
      if (!params_.edges_yield || faces == 0 || factor == 0 || left <= faces) return level;
      if (counts.simplify.stop != StopReason::edge_length) return level;
      // The number of faces falls with the square of the edges.
      factor *= std::max(kLooser, std::sqrt(double(left) / double(faces)));
      if (factor > kMostFactor) factor = 0;
      counts = {};
    }
  }

  template <class Make>
  LatticeMesh finish(const GridFrame& frame, std::uint64_t faces, double edge_factor, const Make& make,
                     LevelCounts& counts) {
    counts.error_world = bounds_.error_world;
    counts.edge_factor = edge_factor;
    SimplifyParams params = simplify_params(in_.header, frame, params_, memory_, faces);
    if (edge_factor > 0) params.edge_limit = scaled_edges(in_.header.scale, frame, edge_factor, near_);
    params.memory = beside_limits(params.memory, ProxyLimits::bytes_needed(bounds_, frame, ground_.tree.get()));
    ProxyLimits limits(bounds_, frame, ground_.tree.get());
    if (bounds_.error_world > 0 || bounds_.volume_world != 0) params.limits = &limits;
    LatticeMesh proxy = make(params, counts);
    if (params.limits != nullptr) keep_pairs_within(limits, proxy);
    if (in_.inside()) turn_over(proxy);
    const StopReason stop = counts.simplify.stop;
    counts.stopped_by = stop == StopReason::limits ? counts.simplify.limit : to_string(stop);
    counts.measures = measure(proxy);
    if (params_.distances) measure_distances(proxy, ground_.surface, *ground_.tree, counts.measures);
    proxy.provenance = in_.header.provenance;
    return proxy;
  }

  MeshParams params_;
  const LevelInputs in_;
  const PassContext& context_;
  PieceMemory memory_;  // the memory that is left
  MeshCounts& counts_;
  ProxyBounds bounds_;
  Ground ground_;
  const BrickShelf* near_ = nullptr;  // LevelInputs::near_of() the level that is made
};

}  // namespace

std::vector<LatticeMesh> mesh_stream(BrickSource& source, const PassContext& context, MeshParams params,
                                     MeshCounts& counts) {
  counts = {};
  const Shelves shelves = read_voxels(source, context.make_shelf, params, counts);
  return LevelMaker(source.header(), context, std::move(params), counts).run(shelves);
}

std::uint64_t mesh_limit(BrickSource& source, const PassContext& context, const MeshParams& params,
                         std::uint64_t triangles) {
  MeshCounts counts;
  const Shelves shelves = read_voxels(source, context.make_shelf, params, counts);
  return least_limit({source.header(), params, context.make_shelf}, context.pieces, shelves, triangles);
}

}  // namespace bp
