#include "lib/pass/mesh/mesh_stage.h"

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"
#include "lib/enclosed/enclosed_scene.h"
#include "lib/enclosed/enclosed_triangles.h"
#include "lib/enclosed/enclosed_voxels.h"
#include "lib/grid/count_bits.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/pass/mesh/complement.h"
#include "lib/pass/mesh/detail/components.h"
#include "lib/pass/mesh/detail/fit_target.h"
#include "lib/pass/mesh/detail/proxy_limits.h"
#include "lib/pass/mesh/detail/scene_check.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/quads/quad_slack.h"
#include "lib/quads/quads.h"
#include "lib/simplify/flatten.h"
#include "lib/simplify/surface_tree.h"
#include "lib/surface/repair.h"
#include "lib/tighten/few_faces.h"
#include "lib/tighten/tight_proxy.h"
#include "lib/volume/boundary_rects.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

struct Shelves {
  std::unique_ptr<BrickShelf> meshed;  // the closing, or the solid of a stream without one
  std::unique_ptr<BrickShelf> input;   // the solid; null if nobody asks for it
};

[[noreturn]] void fail_empty(const StreamHeader& header) {
  if (header.fill != FillMode::inside)
    fail(ErrorCode::bad_input, "the stream holds no occupied voxel; there is nothing to mesh");
  fail(ErrorCode::bad_input,
       "nothing is left of the inside of the scene: it is open there, or thinner than {}; try smaller voxels{}, and "
       "bpinfo on the stream of bpvox shows what is inside",
       header.has_closing ? "two scales" : "the voxels", header.has_closing ? ", a smaller --scale" : "");
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
    fail(ErrorCode::bad_input, "the stream's solid layer holds no voxel; --enclose input has nothing to keep inside");
  return shelves;
}

void check(const MeshParams& params) {
  for (std::size_t i = 1; i < params.faces.size(); ++i) {
    if (params.faces[i] < params.faces[i - 1]) continue;
    fail(ErrorCode::bad_argument, "{} faces after {}: each level must have fewer than the one before", params.faces[i],
         params.faces[i - 1]);
  }
  if (params.mode == MeshMode::inside && params.enclose == Enclose::scene)
    fail(ErrorCode::bad_argument, "a proxy inside a scene is kept by voxels; --enclose takes closing or input");
  if (params.mode == MeshMode::fit && params.enclose == Enclose::input)
    fail(ErrorCode::bad_argument, "a fit is drawn to the closing or to scene files; --enclose input has no meaning");
  if (params.mode == MeshMode::fit && params.volume_ratio != 0)
    fail(ErrorCode::bad_argument, "a fit encloses nothing; --volume has no meaning");
  if (!(params.error_world >= 0)) fail(ErrorCode::bad_argument, "an error of {} is below 0", params.error_world);
  if (!(params.volume_ratio >= 0))
    fail(ErrorCode::bad_argument, "a volume ratio of {} is below 0", params.volume_ratio);
  if (!(params.edge_factor >= 0))
    fail(ErrorCode::bad_argument, "an edge length of {} times the scale is below 0", params.edge_factor);
  if (!(params.inset >= 0 && params.inset <= 1))
    fail(ErrorCode::bad_argument, "the inset of a fit is 0 to 1 extents of a voxel, not {}", params.inset);
  if (params.least_part < 0 || params.least_part > 1)
    fail(ErrorCode::bad_argument, "the least part is a share of the largest, from 0 to 1, not {}", params.least_part);
  if (params.mode != MeshMode::inside && params.least_part != 0)
    fail(ErrorCode::bad_argument, "only a proxy inside a scene may leave parts out; --least-part needs --mode inside");
  if (params.mode == MeshMode::inside && params.volume_ratio > 1)
    fail(ErrorCode::bad_argument, "a volume ratio of {} is above 1, and what lies inside is no larger",
         params.volume_ratio);
  if (params.mode == MeshMode::bounding && params.volume_ratio != 0 && params.volume_ratio < 1)
    fail(ErrorCode::bad_argument, "a volume ratio of {} is below 1, and a proxy is no smaller than what it encloses",
         params.volume_ratio);
}

void check_fill(const MeshParams& params, const StreamHeader& header) {
  const bool inside = header.fill == FillMode::inside;
  if (params.mode == MeshMode::inside && !inside) {
    fail(ErrorCode::bad_input,
         "the stream holds voxels that the scene touches; --mode inside needs bpvox --fill inside");
  }
  if (params.mode == MeshMode::inside || !inside) return;
  fail(ErrorCode::bad_input, "the stream holds the inside of the scene only (bpvox --fill inside); use --mode inside");
}

/// What must stay inside, and its surface where distances to it are asked for.
struct Ground {
  std::unique_ptr<Enclosed> enclosed;  // null: nothing is tightened
  std::vector<TriangleD> surface;
  std::unique_ptr<TriangleBvh> tree;

  [[nodiscard]] std::uint64_t bytes() const {
    return (enclosed ? enclosed->bytes() : 0) + surface.capacity() * sizeof(TriangleD) + (tree ? tree->bytes() : 0);
  }
};

/// The surface that simplification begins with. A proxy inside is one around the complement, turned over: what must
/// stay "inside" is then what surrounds it.
struct Start {
  std::unique_ptr<BrickShelf> around;  // inside: the complement of the layer that is meshed
  std::unique_ptr<LatticeMesh> mesh;   // inside: its surface
  std::unique_ptr<SurfaceSource> surface;
};

/// The same surface with few triangles.
std::vector<TriangleD> merged_triangles(const SurfaceSource& surface, const PieceMemory& memory) {
  SimplifyParams params;
  params.memory = memory;
  SimplifyCounts counts;
  Piece whole = simplified_surface(surface, params, {}, counts);
  HalfEdgeMesh mesh(std::move(whole.vertices), whole.triangles, kEverywhere);
  merge_flat_regions(mesh);
  return world_triangles(mesh.compact(surface.frame()));
}

/// The same for voxels that may touch along edges, where no faces can be merged but those in a rectangle.
std::vector<TriangleD> rect_triangles(const BrickShelf& shelf, const GridFrame& frame, const PieceMemory& memory) {
  const std::vector<FaceRect> rects = boundary_rects(shelf);
  const std::uint64_t n = 2 * rects.size();
  const std::uint64_t bytes = rects.size() * sizeof(FaceRect) + n * sizeof(TriangleD) + TriangleBvh::bytes_needed(n);
  if (bytes > memory.bytes()) {
    fail(ErrorCode::out_of_resource,
         "the surface that distances are measured from takes {} MiB, and --memory leaves {} MiB for it; raise "
         "--memory{}, or use larger voxels",
         (bytes >> 20) + 1, memory.bytes() >> 20, memory.enough_for(bytes - memory.bytes()));
  }
  std::vector<TriangleD> triangles;
  triangles.reserve(n);
  for (const FaceRect& r : rects) {
    const int across = r.min.x == r.max.x ? 0 : r.min.y == r.max.y ? 1 : 2, u = across == 0 ? 1 : 0;
    VoxelCoord b = r.min, d = r.max;
    b[u] = r.max[u];
    d[u] = r.min[u];
    const auto world = [&](const VoxelCoord& c) {
      return frame.world({std::int64_t(c.x) * kLatticePerVoxel, std::int64_t(c.y) * kLatticePerVoxel,
                          std::int64_t(c.z) * kLatticePerVoxel});
    };
    triangles.push_back({world(r.min), world(b), world(r.max)});
    triangles.push_back({world(r.min), world(r.max), world(d)});
  }
  return triangles;
}

std::unique_ptr<Enclosed> make_enclosed(const Shelves& shelves, MeshParams& params, const Start& start,
                                        const ShelfFactory& make_shelf) {
  if (params.enclose == Enclose::scene) {
    const GridFrame& frame = start.surface->frame();
    if (params.mode == MeshMode::bounding && !lies_within(params.scene, frame, *shelves.meshed)) {
      fail(ErrorCode::bad_input,
           "--enclose: the scene named lies not inside the voxels of the stream, so the stream was made from another "
           "one; name the scene that bpvox read");
    }
    if (params.near && params.mode == MeshMode::bounding)
      return std::make_unique<EnclosedScene>(std::move(params.scene), frame, *shelves.input);
    return std::make_unique<EnclosedTriangles>(std::move(params.scene), frame);
  }
  if (params.enclose == Enclose::closing)
    return std::make_unique<EnclosedVoxels>(start.around ? *start.around : *shelves.meshed);
  if (params.mode == MeshMode::bounding) return std::make_unique<EnclosedVoxels>(*shelves.input);
  const auto around = make_shelf();
  complement(*shelves.input, bricks_around(*shelves.input), *around);
  return std::make_unique<EnclosedVoxels>(*around);
}

Ground make_ground(const Shelves& shelves, MeshParams& params, const Start& start, const ShelfFactory& make_shelf) {
  Ground ground;
  const bool target = params.mode == MeshMode::fit && params.enclose == Enclose::scene;
  if (params.error_world > 0 || params.distances || target) {
    const Enclose to = params.distances_to.value_or(params.enclose);
    ground.surface = to == Enclose::scene   ? params.scene
                     : to == Enclose::input ? rect_triangles(*shelves.input, start.surface->frame(), params.memory)
                                            : merged_triangles(*start.surface, params.memory);
    ground.tree = std::make_unique<TriangleBvh>(ground.surface);
  }
  if (params.tighten && params.mode != MeshMode::fit)
    ground.enclosed = make_enclosed(shelves, params, start, make_shelf);
  return ground;
}

/// No edge longer than `factor` times S anywhere along it; but never below two voxels, or nothing could be merged where
/// the scale vanishes.
EdgeLimit scaled_edges(const ScaleField& scale, const GridFrame& frame, double factor) {
  return [&scale, frame, factor](const LatticeCoord& a, const LatticeCoord& b) {
    const double edge = length(to_double(b - a));
    return edge <= 2 * kLatticePerVoxel ||
           scale.reaches_along(frame.world(a), frame.world(b), edge / kLatticePerVoxel * frame.voxel / factor,
                               frame.voxel);
  };
}

SimplifyParams simplify_params(const StreamHeader& header, const GridFrame& frame, const MeshParams& params,
                               std::uint64_t faces) {
  SimplifyParams out;
  out.memory = params.memory;
  out.faces = std::min<std::uint64_t>(faces, std::uint64_t(1) << 32);  // a mesh indexes fewer; multiples stay exact
  if (faces == 0 && params.error_world == 0 && params.volume_ratio == 0) {
    const bool cube = header.has_closing && header.element == StructuringElement::cube;
    const double share = cube ? MeshParams::kErrorShareCube : MeshParams::kErrorShareBall;
    out.error_vox = header.bounds.diagonal() * share / frame.voxel;
  }
  if (params.edge_factor > 0) out.edge_limit = scaled_edges(header.scale, frame, params.edge_factor);
  return out;
}

/// Tightening made room below the limits: more collapses, more tightening, until they merge little.
LatticeMesh use_room(LatticeMesh proxy, const Enclosed& enclosed, SimplifyParams params, LevelCounts& counts) {
  constexpr int kRounds = 8;
  params.dense = false;
  params.enclosed = &enclosed;
  TightenParams tightening;
  static_cast<ShapeLimits&>(tightening) = params;
  for (int round = 0; round < kRounds && counts.simplify.stop == StopReason::limits; ++round) {
    const std::size_t before = proxy.triangles.size();
    SimplifyCounts more;
    proxy = simplify(proxy, params, more);
    counts.simplify.add(more);
    if (proxy.triangles.size() * 20 > before * 19) break;
    proxy = tighten(proxy, enclosed, tightening, counts.tighten);
  }
  return proxy;
}

/// One level, from the surface of all that it must enclose. `few`: nothing but a number of faces below kFewFaces
/// matters.
LatticeMesh make_level(const SurfaceSource& dense, const Enclosed* enclosed, const SimplifyParams& params, bool few,
                       LevelCounts& counts) {
  if (enclosed == nullptr) return simplify(dense, params, counts.simplify);
  if (few) return tight_proxy_of_few(dense, *enclosed, params, counts.simplify, counts.tighten);
  LatticeMesh proxy = tight_proxy(dense, *enclosed, params, counts.simplify, counts.tighten);
  return params.limits == nullptr ? proxy : use_room(std::move(proxy), *enclosed, params, counts);
}

double area_world(const LatticeMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += length(to_double(normal_of(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]))) / 2;
  return sum * std::pow(mesh.frame.voxel / kLatticePerVoxel, 2);
}

/// Edge of the voxels around a level: the stream's, or as large as gives a dense surface of enough faces for the next
/// and takes no more than half of its share of the error.
double level_voxel(const LatticeMesh& inner, double voxel, std::uint64_t faces, double error_share) {
  constexpr double kFacesPerFace = 200;
  constexpr double kFacesPerVoxelFace = 2 * kSlantedSteps;
  constexpr double kVoxelsPerShare = 4;  // a voxel that is touched reaches as far as its diagonal
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

/// What is left beside what the limits of a level take.
PieceMemory beside_limits(const PieceMemory& memory, std::uint64_t bytes) {
  if (bytes <= memory.bytes()) return memory.without(bytes);
  fail(ErrorCode::out_of_resource,
       "keeping a level within a distance takes {} MiB, and --memory leaves {} MiB for it; raise --memory{}",
       bytes >> 20, memory.bytes() >> 20, memory.enough_for(bytes - memory.bytes()));
}

constexpr int kVolume6OfVoxel = 6 * kLatticePerVoxel * kLatticePerVoxel * kLatticePerVoxel;

/// All levels, one after the other.
class LevelMaker {
 public:
  LevelMaker(const StreamHeader& header, const ShelfFactory& make_shelf, MeshParams params, MeshCounts& counts)
      : header_(header), make_shelf_(make_shelf), params_(std::move(params)), counts_(counts) {}

  std::vector<LatticeMesh> run(const Shelves& shelves) {
    const std::vector<std::uint64_t> faces = params_.faces.empty() ? std::vector<std::uint64_t>{0} : params_.faces;
    Start start = make_start(shelves);
    bounds_.volume_world = (inside() ? -1 : 1) * params_.volume_ratio * counts_.solid_volume_world;
    ground_ = make_ground(shelves, params_, start, make_shelf_);
    const PieceMemory memory = params_.memory;
    params_.memory = memory.without(ground_.bytes());
    const bool fit = params_.mode == MeshMode::fit;
    const double error_share = params_.error_world / double(fit ? 1 : faces.size());
    bounds_.error_world = error_share;
    if (fit) return fits(*start.surface, faces);
    std::vector<LatticeMesh> levels{finish(*start.surface, ground_.enclosed.get(), faces[0])};
    ground_.enclosed.reset();
    start = {};
    for (std::size_t i = 1; i < faces.size(); ++i) {
      bounds_.error_world = error_share * double(i + 1);
      params_.memory = memory.without(ground_.bytes() + bytes_of(levels));
      levels.push_back(next_level(levels.back(), faces[i], error_share));
    }
    return levels;
  }

 private:
  Start make_start(const Shelves& shelves) {
    Start start;
    if (!inside()) {
      start.surface = std::make_unique<ShelfSurface>(*shelves.meshed, header_.frame);
      return start;
    }
    start.around = make_shelf_();
    check_work(count_faces(ShelfSurface(*shelves.meshed, header_.frame)), params_.memory);
    start.mesh =
        std::make_unique<LatticeMesh>(inward_surface(*shelves.meshed, header_.frame, make_shelf_, *start.around));
    if (start.mesh->triangles.empty())
      fail(ErrorCode::bad_input,
           "the inside of the scene is too thin to mesh; use smaller voxels or a smaller --scale");
    counts_.repaired = counts_.voxels - std::uint64_t(-volume6_of(*start.mesh) / kVolume6OfVoxel);
    counts_.solid_volume_world -= double(counts_.repaired) * std::pow(header_.frame.voxel, 3);
    drop_crumbs(*start.mesh);
    start.surface = std::make_unique<MeshSurface>(*start.mesh);
    return start;
  }

  /// A level around `before`, or within it.
  LatticeMesh next_level(const LatticeMesh& before, std::uint64_t faces, double error_share) {
    const double voxel = level_voxel(before, header_.frame.voxel, faces, error_share);
    if (!inside()) {
      const auto around = make_shelf_();
      const GridFrame frame = voxels_around(before, voxel, make_shelf_, params_.memory, *around);
      return finish_around(before, ShelfSurface(*around, frame), faces);
    }
    LatticeMesh dense = surface_within(before, voxel, make_shelf_, params_.memory);
    drop_small_parts(dense, params_.least_part);  // a level may fall into parts
    return finish_around(before, MeshSurface(dense), faces);
  }

  LatticeMesh finish_around(const LatticeMesh& before, const SurfaceSource& dense, std::uint64_t faces) {
    if (!params_.tighten) return finish(dense, nullptr, faces);
    const EnclosedTriangles enclosed(drawable_world_triangles(before), dense.frame());
    params_.memory = params_.memory.without(enclosed.bytes());
    return finish(dense, &enclosed, faces);
  }

  /// Levels of detail that do not enclose: each of the same fine surface.
  std::vector<LatticeMesh> fits(const SurfaceSource& dense, const std::vector<std::uint64_t>& faces) {
    const FitTarget target = params_.enclose == Enclose::scene
                                 ? scene_target(*ground_.tree, dense.frame(), params_.inset)
                                 : inset_target(params_.inset);
    const EdgeLimit edges = simplify_params(header_, dense.frame(), params_, faces[0]).edge_limit;
    const FineFit fine = fine_fit(dense, faces[0], target, edges, params_.memory);
    std::vector<LatticeMesh> levels;
    for (const std::uint64_t n : faces) {
      levels.push_back(finish(dense.frame(), n, [&](const SimplifyParams& params, LevelCounts& counts) {
        LatticeMesh level = fit_level(fine, params, counts.simplify);
        if (params_.quads) level.quads = pair_triangles(level, QuadKeeps::nothing, nullptr);
        return level;
      }));
    }
    return levels;
  }

  [[nodiscard]] bool inside() const { return params_.mode == MeshMode::inside; }

  void drop_crumbs(LatticeMesh& dense) {
    const DroppedParts dropped = drop_small_parts(dense, params_.least_part);
    counts_.dropped_parts = dropped.parts;
    counts_.dropped_voxels = std::uint64_t(std::llround(dropped.volume_vox));
    counts_.solid_volume_world -= dropped.volume_vox * std::pow(header_.frame.voxel, 3);
  }

  LatticeMesh finish(const SurfaceSource& dense, const Enclosed* enclosed, std::uint64_t faces) {
    return finish(dense.frame(), faces, [&](SimplifyParams params, LevelCounts& counts) {
      if (faces >= kLeastFacesWithRoom) params.room = room_around(dense.box(), faces);  // the box reads all voxels
      if (params_.near && params.limits == nullptr && faces > 0)
        params.reach = (header_.scale.base / dense.frame().voxel + 1) * kLatticePerVoxel;
      const bool few = faces > 0 && faces < kFewFaces && params.limits == nullptr && !params.edge_limit &&
                       !params_.near && !inside();
      LatticeMesh proxy = make_level(dense, enclosed, params, few, counts);
      if (!params_.quads) return proxy;
      if (enclosed != nullptr) proxy = make_room_for_quads(proxy, *enclosed, params);
      proxy.quads = pair_triangles(proxy, QuadKeeps::enclosed, enclosed);
      return proxy;
    });
  }

  /// One level by make(params, counts), with its counts and measures.
  template <class Make>
  LatticeMesh finish(const GridFrame& frame, std::uint64_t faces, const Make& make) {
    LevelCounts& counts = counts_.levels.emplace_back();
    counts.error_world = bounds_.error_world;
    SimplifyParams params = simplify_params(header_, frame, params_, faces);
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
  const ShelfFactory& make_shelf_;
  MeshParams params_;
  MeshCounts& counts_;
  ProxyBounds bounds_;
  Ground ground_;
};

}  // namespace

std::vector<LatticeMesh> mesh_stream(BrickSource& source, const ShelfFactory& make_shelf, MeshParams params,
                                     MeshCounts& counts) {
  counts = {};
  check(params);
  const StreamHeader& header = source.header();
  check_fill(params, header);
  const bool distances = params.error_world > 0 || params.distances;
  const bool near_scene = params.mode == MeshMode::bounding && params.near && params.enclose == Enclose::scene;
  const bool want_input = (params.tighten && (params.enclose == Enclose::input || near_scene)) ||
                          (distances && params.distances_to.value_or(params.enclose) == Enclose::input);
  const Shelves shelves = read_layers(source, make_shelf, want_input, counts);
  counts.solid_volume_world = double(counts.voxels) * std::pow(header.frame.voxel, 3);
  if (params.mode != MeshMode::inside) {
    counts.repaired = repair_contacts(*shelves.meshed);
    counts.solid_volume_world += double(counts.repaired) * std::pow(header.frame.voxel, 3);
  }
  return LevelMaker(header, make_shelf, std::move(params), counts).run(shelves);
}

}  // namespace bp
