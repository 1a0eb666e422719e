#include "lib/pass/mesh/mesh_pass.h"

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"
#include "lib/enclosed/enclosed_triangles.h"
#include "lib/enclosed/enclosed_voxels.h"
#include "lib/grid/count_bits.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/pass/mesh/detail/coarse_start.h"
#include "lib/pass/mesh/detail/components.h"
#include "lib/pass/mesh/detail/fit_target.h"
#include "lib/pass/mesh/detail/ground.h"
#include "lib/pass/mesh/detail/make_level.h"
#include "lib/pass/mesh/detail/params_check.h"
#include "lib/pass/mesh/detail/proxy_limits.h"
#include "lib/pass/mesh/detail/scaled_edges.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/quads/limb_cage.h"
#include "lib/quads/quad_slack.h"
#include "lib/quads/quads.h"
#include "lib/simplify/surface_tree.h"
#include "lib/surface/repair.h"
#include "lib/tighten/tight_proxy.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

/// Distance by which a fit expects the scene's surface to lie inside the surface of the voxels, in extents of a voxel
/// along the normal. The mean is a half, for voxels that a surface touches and for their closing.
constexpr double kInset = 0.5;
/// Distance from the voxels' surface that a fit may reach at first: this many scales, and a voxel.
constexpr double kReachOfScale = 0.25;

[[noreturn]] void fail_empty(const StreamHeader& header) {
  if (header.fill != FillMode::inside)
    fail(ErrorCode::bad_input, "the stream holds no occupied voxel; there is nothing to mesh");
  Remedies remedies{Remedy::smaller_voxels};
  if (header.has_closing) remedies.push_back(Remedy::smaller_scale);
  fail(
      ErrorCode::bad_input, remedies,
      "nothing is left of the inside of the scene: it is open there, or thinner than {} (bpinfo on the stream of bpvox "
      "shows what is inside)",
      header.has_closing ? "two scales" : "the voxels");
}

Shelves read_layers(BrickSource& source, const ShelfFactory& make_shelf, bool want_input, MeshCounts& counts) {
  const Layer layer = source.header().has_closing ? Layer::closing : Layer::solid;
  Shelves shelves{make_shelf(), want_input ? make_shelf() : nullptr};
  for (Brick brick; source.read(brick);) {
    if (shelves.input && brick.layer == Layer::solid) shelves.input->put(brick.coord, brick.fill, brick.bits);
    if (brick.layer != layer) continue;
    counts.voxels += count_bits(std::as_bytes(std::span(brick.bits)));
    shelves.meshed->put(brick.coord, brick.fill, brick.bits);
  }
  if (counts.voxels == 0) fail_empty(source.header());
  if (shelves.input && shelves.input->coords().empty())
    fail(ErrorCode::bad_input, {Remedy::enclose_closing}, "the stream's solid layer holds no voxel to keep inside");
  return shelves;
}

/// Returns the edge of the voxels around a level. It is the stream's, or larger: so large that the next level's dense
/// surface has just enough faces, but at most a quarter of its share of the error.
double level_voxel(const LatticeMesh& inner, double voxel, std::uint64_t faces, double error_share) {
  constexpr double kFacesPerVoxelFace = 2 * kSlantedSteps;
  // Dense faces for each face, since there is no finer surface to tighten against.
  constexpr double kFacesPerFace = 200;
  constexpr double kVoxelsPerShare = 4;  // a touched voxel reaches as far as its diagonal
  const double most = error_share > 0 ? error_share / kVoxelsPerShare : HUGE_VAL;
  const double enough = std::sqrt(kFacesPerVoxelFace * area_world(inner) / (kFacesPerFace * double(faces)));
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

/// Makes all levels, one after the other.
class LevelMaker {
 public:
  LevelMaker(const StreamHeader& header, const PassContext& context, MeshParams params, MeshCounts& counts)
      : header_(header),
        context_(context),
        pieces_(context.pieces),
        make_shelf_(context.make_shelf),
        memory_(context.pieces),
        params_(std::move(params)),
        counts_(counts) {}

  std::vector<LatticeMesh> run(const Shelves& shelves) {
    const std::uint64_t triangles = params_.scene.size();
    return naming_limit([&] { return make(shelves); }, [&] { return least_limit(shelves, triangles); });
  }

  /// Returns the limit on memory at which all steps of the first level fit. `triangles`: number of the scene's
  /// triangles.
  [[nodiscard]] std::uint64_t least_limit(const Shelves& shelves, std::uint64_t triangles) const {
    if (params_.cage || params_.start != nullptr) return 0;
    std::unique_ptr<BrickShelf> within;
    if (inside()) within = repaired_within(*shelves.meshed, make_shelf_, *make_shelf_());
    const BrickShelf& meshed = within ? *within : *shelves.meshed;
    const ShelfSurface dense(meshed, header_.frame);
    const SurfaceWork flat = counted_work(pieces_, [&](const PieceMemory& memory) {
      SimplifyParams params;
      params.memory = memory;
      SimplifyCounts ignored;
      (void)simplified_surface(dense, params, {}, ignored);
    });
    const bool is_limited = params_.error_world > 0 || params_.volume_ratio > 0;
    const SurfaceWork work = is_limited ? flat : first_work(meshed, dense);
    std::uint64_t held = ground_bytes(shelves, params_, triangles, flat.flat_faces);
    if (params_.error_world > 0) held += ProxyLimits::kMostBytes;
    held += edge_bytes(dense.frame(), near_of(*shelves.meshed));
    const std::uint64_t faces = inside() ? count_faces(dense) : 0;
    return std::max(pieces_.without(held + faces * kBytesPerKeptFace).limit_for(work.whole_bytes, work.cell_bytes),
                    pieces_.limit_for(faces * kBytesPerMeshedFace));
  }

 private:
  /// Returns the work of the first level, without limits on its error and volume.
  [[nodiscard]] SurfaceWork first_work(const BrickShelf& meshed, const ShelfSurface& dense) const {
    const std::uint64_t faces = params_.faces.empty() ? 0 : params_.faces[0];
    const EdgeLimit edges = edges_for(dense.frame());
    return counted_work(pieces_, [&](const PieceMemory& memory) {
      if (params_.mode == MeshMode::fit) return void(fine_fit(dense, faces, inset_target(kInset), edges, memory));
      SimplifyParams params = simplify_params(header_, dense.frame(), params_, memory, faces);
      params.edge_limit = edges;
      const EnclosedTriangles nothing({}, dense.frame());
      const CoarseStarts starts{meshed, header_, make_shelf_};
      LevelCounts ignored;
      (void)make_level(dense, is_by_faces(faces) ? &starts : nullptr, params_.tighten ? &nothing : nullptr, params,
                       false, nullptr, ignored);
    });
  }

  /// Returns whether a level of so many faces may begin with a coarse surface, since only the number of faces matters.
  [[nodiscard]] bool is_by_faces(std::uint64_t faces) const {
    return !inside() && params_.tighten && faces >= kFewFaces && params_.error_world == 0 &&
           params_.volume_ratio == 0 && params_.edge_factor == 0;
  }

  /// Returns the limits of edges, which depend on the scale at their place; none if edge_factor is 0.
  [[nodiscard]] EdgeLimit edges_for(const GridFrame& frame) const {
    return params_.edge_factor > 0 ? scaled_edges(header_.scale, frame, params_.edge_factor) : EdgeLimit{};
  }

  /// Returns the voxels near which edges may be long: those that a level encloses. Null: no edge may be longer than
  /// params_.edge_factor allows.
  [[nodiscard]] const BrickShelf* near_of(const BrickShelf& voxels) const {
    return params_.edges_by_shape && params_.mode == MeshMode::bounding ? &voxels : nullptr;
  }
  /// Returns the memory that limits on edges take.
  [[nodiscard]] std::uint64_t edge_bytes(const GridFrame& frame, const BrickShelf* near) const {
    return near != nullptr && params_.edge_factor > 0 ? bytes_of_near_edges(header_.scale, frame, *near) : 0;
  }

  std::vector<LatticeMesh> make(const Shelves& shelves) {
    const std::vector<std::uint64_t> faces = params_.faces.empty() ? std::vector<std::uint64_t>{0} : params_.faces;
    Start start = make_start(shelves);
    if (start.mesh) context_.pieces = pieces_.without(start.mesh->triangles.size() * kBytesPerKeptFace);
    bounds_.volume_world = (inside() ? -1 : 1) * params_.volume_ratio * counts_.solid_volume_world;
    ground_ = make_ground(shelves, params_, start, header_.fill, context_);
    near_ = near_of(*shelves.meshed);
    memory_ = context_.pieces.without(ground_.bytes() + edge_bytes(header_.frame, near_));
    const bool fit = params_.mode == MeshMode::fit;
    const double error_share = params_.error_world / double(fit ? 1 : faces.size());
    bounds_.error_world = error_share;
    if (fit) return fits(shelves, *start.surface, faces);
    if (params_.cage) return cage(shelves, faces[0]);
    const CoarseStarts starts{*shelves.meshed, header_, make_shelf_};
    std::vector<LatticeMesh> levels{
        finish(*start.surface, ground_.enclosed, faces[0], is_by_faces(faces[0]) ? &starts : nullptr)};
    ground_.made.reset();
    ground_.enclosed = nullptr;
    start = {};
    context_.pieces = pieces_;
    for (std::size_t i = 1; i < faces.size(); ++i) {
      bounds_.error_world = error_share * double(i + 1);
      memory_ = context_.pieces.without(ground_.bytes() + bytes_of(levels));
      levels.push_back(next_level(levels.back(), faces[i], error_share));
    }
    return levels;
  }

  Start make_start(const Shelves& shelves) {
    Start start;
    if (!inside()) {
      start.surface = std::make_unique<ShelfSurface>(*shelves.meshed, header_.frame);
      return start;
    }
    start.around = make_shelf_();
    check_dense(count_faces(ShelfSurface(*shelves.meshed, header_.frame)), memory_);
    start.mesh =
        std::make_unique<LatticeMesh>(inward_surface(*shelves.meshed, header_.frame, make_shelf_, *start.around));
    if (start.mesh->triangles.empty())
      fail(ErrorCode::bad_input, {Remedy::smaller_voxels, Remedy::smaller_scale},
           "the inside of the scene is too thin to mesh");
    counts_.repaired = counts_.voxels - std::uint64_t(-volume6_of(*start.mesh) / kVolume6OfVoxel);
    counts_.solid_volume_world -= double(counts_.repaired) * std::pow(header_.frame.voxel, 3);
    drop_crumbs(*start.mesh);
    start.surface = std::make_unique<MeshSurface>(*start.mesh);
    return start;
  }

  std::vector<LatticeMesh> cage(const Shelves& shelves, std::uint64_t faces) {
    const std::optional<MirrorPlane>& plane = params_.cage->plane;
    return {finish(header_.frame, faces, [&](const SimplifyParams&, LevelCounts& counts) {
      counts.simplify.stop = StopReason::faces;
      std::shared_ptr<const Limbs> model = params_.cage->limbs;
      if (model == nullptr) model = std::make_shared<Limbs>(*shelves.meshed, *shelves.meshed);
      CageFit fit;
      const auto steps = [&](std::uint64_t done, std::uint64_t total) {
        context_.report("keeping limbs apart", "quads", done, total);
      };
      LatticeMesh mesh =
          cage_with_limbs(*shelves.meshed, header_.frame, *ground_.enclosed, faces, plane, *model, fit, steps);
      if (mesh.triangles.empty())
        fail(ErrorCode::bad_argument, "{} faces: {}", faces,
             plane ? "a symmetric cage has at least 20 triangles" : "a cage of quads has at least 12 triangles");
      counts.limbs.count = model->count();
      for (const LatticeCoord& tip : fit.joined) counts.limbs.joined.push_back(header_.frame.world(tip));
      return mesh;
    })};
  }

  /// Makes a level around `before`; in mode inside, a level within it.
  LatticeMesh next_level(const LatticeMesh& before, std::uint64_t faces, double error_share) {
    const double voxel = level_voxel(before, header_.frame.voxel, faces, error_share);
    if (!inside()) {
      const auto around = make_shelf_();
      const GridFrame frame = voxels_around(before, voxel, make_shelf_, memory_, *around);
      near_ = near_of(*around);
      memory_ = memory_.without(edge_bytes(frame, near_));
      LatticeMesh level = finish_around(before, ShelfSurface(*around, frame), faces);
      near_ = nullptr;  // the voxels end here
      return level;
    }
    LatticeMesh dense = surface_within(before, voxel, make_shelf_, memory_);
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
    const FitTarget target =
        params_.enclose == Enclose::scene ? scene_target(*ground_.tree, dense.frame(), kInset) : inset_target(kInset);
    const FineFit fine = fine_fit(dense, faces[0], target, edges_for(dense.frame()), memory_);
    std::vector<LatticeMesh> levels;
    levels.reserve(faces.size());
    for (const std::uint64_t n : faces) {
      levels.push_back(finish(dense.frame(), n, [&](SimplifyParams params, LevelCounts& counts) {
        params.enclosed = &near;
        if (n > 0 && params.limits == nullptr)
          params.reach = (kReachOfScale * header_.scale.base / dense.frame().voxel + 1) * kLatticePerVoxel;
        LatticeMesh level = fit_level(fine, params, counts.simplify);
        if (params_.quads) level.quads = pair_triangles(level, QuadKeeps::nothing, nullptr);
        return level;
      }));
    }
    return levels;
  }

  [[nodiscard]] bool inside() const { return params_.mode == MeshMode::inside; }

  void drop_crumbs(LatticeMesh& dense) {
    const DroppedComponents dropped = drop_small_components(dense, params_.least_part);
    counts_.dropped_parts = dropped.parts;
    counts_.dropped_voxels = std::uint64_t(std::llround(dropped.volume_vox));
    counts_.solid_volume_world -= dropped.volume_vox * std::pow(header_.frame.voxel, 3);
  }

  LatticeMesh finish(const SurfaceSource& dense, const Enclosed* enclosed, std::uint64_t faces,
                     const CoarseStarts* starts = nullptr) {
    return finish(dense.frame(), faces, [&](SimplifyParams params, LevelCounts& counts) {
      if (faces >= kLeastFacesWithRoom) params.room = room_around(dense.box(), faces);  // the box reads all voxels
      if (params_.near_world && params.limits == nullptr && faces > 0)
        params.reach = (*params_.near_world / dense.frame().voxel + 1) * kLatticePerVoxel;
      const bool only_faces = faces > 0 && params.limits == nullptr && !params.edge_limit && !params_.near_world;
      const bool few = only_faces && faces < kFewFaces;
      params.dense = params_.start == nullptr;
      LatticeMesh proxy = params_.start ? take(tight_proxy(*params_.start, *enclosed, params, params_.halfway), counts)
                                        : make_level(dense, starts, enclosed, params, few, params_.halfway, counts);
      if (only_faces && !inside() && params_.convex && enclosed != nullptr)
        take_convex(proxy, *enclosed, faces, counts);
      if (!params_.quads) return proxy;
      if (enclosed != nullptr) proxy = make_room_for_quads(proxy, *enclosed, params);
      proxy.quads = pair_triangles(proxy, QuadKeeps::enclosed, enclosed);
      return proxy;
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
    SimplifyParams params = simplify_params(header_, frame, params_, memory_, faces);
    if (edge_factor > 0) params.edge_limit = scaled_edges(header_.scale, frame, edge_factor, near_);
    params.memory = beside_limits(params.memory, ProxyLimits::bytes_needed(bounds_, frame, ground_.tree.get()));
    ProxyLimits limits(bounds_, frame, ground_.tree.get());
    if (bounds_.error_world > 0 || bounds_.volume_world != 0) params.limits = &limits;
    LatticeMesh proxy = make(params, counts);
    if (params.limits != nullptr) keep_pairs_within(limits, proxy);
    if (inside()) turn_over(proxy);
    const StopReason stop = counts.simplify.stop;
    counts.stopped_by = stop == StopReason::limits ? counts.simplify.limit : to_string(stop);
    counts.measures = measure(proxy);
    if (params_.distances) measure_distances(proxy, ground_.surface, *ground_.tree, counts.measures);
    proxy.provenance = header_.provenance;
    return proxy;
  }

  const StreamHeader& header_;
  PassContext context_;
  const PieceMemory pieces_;  // all of the memory
  const ShelfFactory& make_shelf_;
  PieceMemory memory_;  // the memory that is left
  MeshParams params_;
  MeshCounts& counts_;
  ProxyBounds bounds_;
  Ground ground_;
  const BrickShelf* near_ = nullptr;  // near_of() the level that is made
};

/// Reads the voxels of a stream, and repairs them if proxies lie around them.
Shelves read_voxels(BrickSource& source, const PassContext& context, const MeshParams& params, MeshCounts& counts) {
  check_params(params);
  const StreamHeader& header = source.header();
  check_fill(params, header);
  const bool distances = params.error_world > 0 || params.distances;
  const bool near_scene = params.mode == MeshMode::bounding && params.near_world && params.enclose == Enclose::scene;
  const bool makes_enclosed = params.tighten && params.enclosed == nullptr;
  const bool want_input = (makes_enclosed && (params.enclose == Enclose::input || near_scene)) ||
                          (distances && params.distances_to.value_or(params.enclose) == Enclose::input);
  Shelves shelves = read_layers(source, context.make_shelf, want_input, counts);
  counts.solid_volume_world = double(counts.voxels) * std::pow(header.frame.voxel, 3);
  if (params.mode != MeshMode::inside && !params.cage) {
    counts.repaired = repair_contacts(*shelves.meshed);
    counts.solid_volume_world += double(counts.repaired) * std::pow(header.frame.voxel, 3);
  }
  return shelves;
}

}  // namespace

std::vector<LatticeMesh> mesh_stream(BrickSource& source, const PassContext& context, MeshParams params,
                                     MeshCounts& counts) {
  counts = {};
  const Shelves shelves = read_voxels(source, context, params, counts);
  return LevelMaker(source.header(), context, std::move(params), counts).run(shelves);
}

std::uint64_t mesh_limit(BrickSource& source, const PassContext& context, const MeshParams& params,
                         std::uint64_t triangles) {
  MeshCounts counts;
  const Shelves shelves = read_voxels(source, context, params, counts);
  return LevelMaker(source.header(), context, params, counts).least_limit(shelves, triangles);
}

}  // namespace bp
