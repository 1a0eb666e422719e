#include "lib/stage/mesh_stage.h"

#include <bit>
#include <cmath>

#include "lib/core/error.h"
#include "lib/core/predicates.h"
#include "lib/meshing/repair.h"
#include "lib/meshing/surface.h"
#include "lib/meshing/tight_proxy.h"

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

std::unique_ptr<Enclosed> make_enclosed(const Shelves& shelves, MeshParams& params, const GridFrame& frame) {
  if (params.enclose == Enclose::scene) return std::make_unique<EnclosedTriangles>(std::move(params.scene), frame);
  return std::make_unique<EnclosedVoxels>(params.enclose == Enclose::input ? *shelves.input : *shelves.meshed);
}

/// S at a lattice point, lattice units.
double scale_at(const StreamHeader& header, const LatticeCoord& p) {
  return header.scale.evaluate(header.frame.world(p)) / header.frame.voxel * kLatticePerVoxel;
}

SimplifyParams simplify_params(const StreamHeader& header, const MeshParams& params) {
  SimplifyParams out;
  out.faces =
      std::min<std::uint64_t>(params.faces, std::uint64_t(1) << 32);  // a mesh indexes fewer; multiples stay exact
  double error_world = params.error_world;
  if (params.faces == 0 && error_world == 0) {
    const bool cube = header.has_closing && header.element == StructuringElement::cube;
    error_world = header.bounds.diagonal() * (cube ? MeshParams::kErrorShareCube : MeshParams::kErrorShareBall);
  }
  out.error_vox = error_world / header.frame.voxel;
  if (params.edge_factor > 0) {
    out.edge_limit = [&header, factor = params.edge_factor](const LatticeCoord& p) {
      // Never below two voxels, or nothing could be merged where the scale vanishes.
      return std::max(factor * scale_at(header, p), 2.0 * kLatticePerVoxel);
    };
  }
  return out;
}

/// Enclosed volume, scene units cubed. Exact sum over the faces, rounded once.
double volume_world(const LatticeMesh& mesh) {
  int128 sum = 0;
  for (const auto& t : mesh.triangles) {
    sum += orient3d_value(mesh.vertices[0], mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
  }
  return double(sum) / 6 * std::pow(mesh.frame.voxel / kLatticePerVoxel, 3);
}

}  // namespace

LatticeMesh mesh_stream(BrickSource& source, const ShelfFactory& make_shelf, MeshParams params, MeshCounts& counts) {
  counts = {};
  const StreamHeader& header = source.header();
  const Shelves shelves = read_layers(source, make_shelf, params.tighten && params.enclose == Enclose::input, counts);
  counts.repaired = repair_contacts(*shelves.meshed);
  const SimplifyParams simplify = simplify_params(header, params);
  const LatticeMesh dense = dense_surface(*shelves.meshed, header.frame);
  LatticeMesh proxy = params.tighten ? tight_proxy(dense, *make_enclosed(shelves, params, header.frame), simplify,
                                                   counts.simplify, counts.tighten)
                                     : bp::simplify(dense, simplify, counts.simplify);
  counts.volume_world = volume_world(proxy);
  counts.solid_volume_world = double(counts.voxels) * std::pow(header.frame.voxel, 3);
  proxy.provenance = header.provenance;
  return proxy;
}

}  // namespace bp
