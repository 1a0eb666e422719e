#include "lib/stage/mesh_stage.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lib/core/error.h"
#include "lib/meshing/flatten.h"
#include "lib/meshing/lattice_geometry.h"
#include "lib/meshing/repair.h"
#include "lib/meshing/surface.h"
#include "lib/meshing/tight_proxy.h"
#include "lib/stage/proxy_limits.h"
#include "lib/stage/surface_around.h"

namespace bp {

namespace {

struct Shelves {
  std::unique_ptr<BrickShelf> meshed;  // the closing, or the solid of a stream without one
  std::unique_ptr<BrickShelf> input;   // the solid; null if nobody asks for it
};

Shelves read_layers(BrickSource& source, const ShelfFactory& make_shelf, bool want_input, MeshCounts& counts) {
  const Layer layer = source.header().has_closing ? Layer::closing : Layer::solid;
  Shelves shelves{make_shelf(), want_input ? make_shelf() : nullptr};
  for (Brick brick; source.read(brick);) {
    if (shelves.input && brick.layer == Layer::solid) shelves.input->put(brick.coord, brick.fill, brick.bits);
    if (brick.layer != layer) continue;
    for (const std::uint64_t w : brick.bits) counts.voxels += std::uint64_t(std::popcount(w));
    shelves.meshed->put(brick.coord, brick.fill, brick.bits);
  }
  if (counts.voxels == 0) fail(ErrorCode::bad_input, "the stream holds no occupied voxel; there is nothing to mesh");
  return shelves;
}

void check(const MeshParams& params) {
  for (std::size_t i = 1; i < params.faces.size(); ++i) {
    if (params.faces[i] < params.faces[i - 1]) continue;
    fail(ErrorCode::bad_argument, "{} faces after {}: each level must have fewer than the one before", params.faces[i],
         params.faces[i - 1]);
  }
  if (params.volume_ratio != 0 && params.volume_ratio < 1)
    fail(ErrorCode::bad_argument, "a volume ratio of {} is below 1, and a proxy is no smaller than what it encloses",
         params.volume_ratio);
}

/// What must stay inside, and its surface where distances to it are asked for.
struct Ground {
  std::unique_ptr<Enclosed> enclosed;  // null: nothing is tightened
  std::vector<TriangleD> surface;
  std::unique_ptr<TriangleBvh> tree;
};

/// The same surface with few triangles.
std::vector<TriangleD> merged_triangles(const LatticeMesh& dense) {
  HalfEdgeMesh mesh(dense);
  merge_flat_regions(mesh);
  return world_triangles(mesh.compact(dense.frame));
}

Ground make_ground(const Shelves& shelves, MeshParams& params, const LatticeMesh& dense) {
  Ground ground;
  if (params.error_world > 0 || params.distances) {
    ground.surface = params.enclose == Enclose::scene   ? params.scene
                     : params.enclose == Enclose::input ? world_triangles(dense_surface(*shelves.input, dense.frame))
                                                        : merged_triangles(dense);
    ground.tree = std::make_unique<TriangleBvh>(ground.surface);
  }
  if (!params.tighten) return ground;
  if (params.enclose == Enclose::scene) {
    ground.enclosed = std::make_unique<EnclosedTriangles>(std::move(params.scene), dense.frame);
  } else {
    ground.enclosed =
        std::make_unique<EnclosedVoxels>(params.enclose == Enclose::input ? *shelves.input : *shelves.meshed);
  }
  return ground;
}

/// S at a lattice point of `frame`, its lattice units.
double scale_at(const StreamHeader& header, const GridFrame& frame, const LatticeCoord& p) {
  return header.scale.evaluate(frame.world(p)) / frame.voxel * kLatticePerVoxel;
}

SimplifyParams simplify_params(const StreamHeader& header, const GridFrame& frame, const MeshParams& params,
                               std::uint64_t faces) {
  SimplifyParams out;
  out.faces = std::min<std::uint64_t>(faces, std::uint64_t(1) << 32);  // a mesh indexes fewer; multiples stay exact
  if (faces == 0 && params.error_world == 0 && params.volume_ratio == 0) {
    const bool cube = header.has_closing && header.element == StructuringElement::cube;
    const double share = cube ? MeshParams::kErrorShareCube : MeshParams::kErrorShareBall;
    out.error_vox = header.bounds.diagonal() * share / frame.voxel;
  }
  if (params.edge_factor > 0) {
    out.edge_limit = [&header, frame, factor = params.edge_factor](const LatticeCoord& p) {
      // Never below two voxels, or nothing could be merged where the scale vanishes.
      return std::max(factor * scale_at(header, frame, p), 2.0 * kLatticePerVoxel);
    };
  }
  return out;
}

/// Tightening made room below the limits: more collapses, more tightening, until they merge little.
LatticeMesh use_room(LatticeMesh proxy, const Enclosed& enclosed, SimplifyParams params, LevelCounts& counts) {
  constexpr int kRounds = 8;
  params.dense = false;
  params.enclosed = &enclosed;
  TightenParams tightening;
  tightening.edge_limit = params.edge_limit;
  tightening.limits = params.limits;
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

/// One level, from the surface of all that it must enclose.
LatticeMesh make_level(const LatticeMesh& dense, const Enclosed* enclosed, const SimplifyParams& params,
                       LevelCounts& counts) {
  if (enclosed == nullptr) return simplify(dense, params, counts.simplify);
  LatticeMesh proxy = tight_proxy(dense, *enclosed, params, counts.simplify, counts.tighten);
  return params.limits == nullptr ? proxy : use_room(std::move(proxy), *enclosed, params, counts);
}

double area_world(const LatticeMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += length(to_double(normal_of(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]))) / 2;
  return sum * std::pow(mesh.frame.voxel / kLatticePerVoxel, 2);
}

/// Edge of the voxels around a level: the stream's, or as large as gives a dense surface of enough faces for the next.
double level_voxel(const LatticeMesh& inner, double voxel, std::uint64_t faces) {
  constexpr double kFacesPerFace = 200;
  constexpr double kFacesPerVoxelFace = 2 * 1.5;  // two triangles, and a slanted plane has 1.5 times its area of steps
  return std::max(voxel, std::sqrt(kFacesPerVoxelFace * area_world(inner) / (kFacesPerFace * double(faces))));
}

/// All levels, one after the other.
class LevelMaker {
 public:
  LevelMaker(const StreamHeader& header, const ShelfFactory& make_shelf, MeshParams params, MeshCounts& counts)
      : header_(header), make_shelf_(make_shelf), params_(std::move(params)), counts_(counts) {
    bounds_.error_world = params_.error_world;
    bounds_.volume_world = params_.volume_ratio * counts.solid_volume_world;
  }

  std::vector<LatticeMesh> run(const Shelves& shelves) {
    const std::vector<std::uint64_t> faces = params_.faces.empty() ? std::vector<std::uint64_t>{0} : params_.faces;
    LatticeMesh dense = dense_surface(*shelves.meshed, header_.frame);
    ground_ = make_ground(shelves, params_, dense);
    std::vector<LatticeMesh> levels{finish(dense, ground_.enclosed.get(), faces[0])};
    for (std::size_t i = 1; i < faces.size(); ++i) {
      const LatticeMesh& inner = levels.back();
      dense = surface_around(inner, level_voxel(inner, header_.frame.voxel, faces[i]), make_shelf_);
      const EnclosedTriangles enclosed(world_triangles(inner), dense.frame);
      levels.push_back(finish(dense, params_.tighten ? &enclosed : nullptr, faces[i]));
    }
    return levels;
  }

 private:
  LatticeMesh finish(const LatticeMesh& dense, const Enclosed* enclosed, std::uint64_t faces) {
    LevelCounts& counts = counts_.levels.emplace_back();
    SimplifyParams params = simplify_params(header_, dense.frame, params_, faces);
    ProxyLimits limits(bounds_, dense, ground_.tree.get());
    if (bounds_.error_world > 0 || bounds_.volume_world > 0) params.limits = &limits;
    LatticeMesh proxy = make_level(dense, enclosed, params, counts);
    const StopReason stop = counts.simplify.stop;
    counts.stopped_by = stop == StopReason::limits ? limits.last_refusal() : to_string(stop);
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
  const bool distances = params.error_world > 0 || params.distances;
  const bool want_input = (params.tighten || distances) && params.enclose == Enclose::input;
  const Shelves shelves = read_layers(source, make_shelf, want_input, counts);
  counts.repaired = repair_contacts(*shelves.meshed);
  counts.solid_volume_world = double(counts.voxels) * std::pow(header.frame.voxel, 3);
  return LevelMaker(header, make_shelf, std::move(params), counts).run(shelves);
}

}  // namespace bp
