#include "lib/pass/mesh/detail/level_start.h"

#include <atomic>
#include <cmath>

#include "lib/core/error.h"
#include "lib/grid/count_bits.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/pass/mesh/complement.h"
#include "lib/pass/mesh/detail/components.h"
#include "lib/pass/mesh/detail/params_check.h"
#include "lib/pass/mesh/mesh_measures.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/simplify/surface_tree.h"
#include "lib/surface/repair.h"

namespace bp {

namespace {

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
  std::atomic<std::uint64_t> voxels{0};
  for_bricks(source, [&](const Brick& brick) {
    if (shelves.input && brick.layer == Layer::solid) shelves.input->put(brick.coord, brick.fill, brick.bits);
    if (brick.layer != layer) return;
    voxels += count_bits(std::as_bytes(std::span(brick.bits)));
    shelves.meshed->put(brick.coord, brick.fill, brick.bits);
  });
  counts.voxels += voxels;
  if (counts.voxels == 0) fail_empty(source.header());
  if (shelves.input && shelves.input->coords().empty())
    fail(ErrorCode::bad_input, {Remedy::enclose_closing}, "the stream's solid layer holds no voxel to keep inside");
  return shelves;
}

void drop_crumbs(const LevelInputs& in, LatticeMesh& dense, MeshCounts& counts) {
  const DroppedComponents dropped = drop_small_components(dense, in.params.least_part);
  counts.dropped_parts = dropped.parts;
  counts.dropped_voxels = std::uint64_t(std::llround(dropped.volume_vox));
  counts.solid_volume_world -= dropped.volume_vox * std::pow(in.header.frame.voxel, 3);
}

}  // namespace

Shelves read_voxels(BrickSource& source, const ShelfFactory& make_shelf, const MeshParams& params, MeshCounts& counts) {
  check_params(params);
  const StreamHeader& header = source.header();
  check_fill(params, header);
  const bool distances = params.error_world > 0 || params.distances;
  const bool near_scene = params.mode == MeshMode::bounding && params.near_world && params.enclose == Enclose::scene;
  const bool makes_enclosed = params.tighten && params.enclosed == nullptr;
  const bool want_input = (makes_enclosed && (params.enclose == Enclose::input || near_scene)) ||
                          (distances && params.distances_to.value_or(params.enclose) == Enclose::input);
  Shelves shelves = read_layers(source, make_shelf, want_input, counts);
  counts.solid_volume_world = double(counts.voxels) * std::pow(header.frame.voxel, 3);
  if (params.mode != MeshMode::inside && !params.cage) {
    counts.repaired = repair_contacts(*shelves.meshed);
    counts.solid_volume_world += double(counts.repaired) * std::pow(header.frame.voxel, 3);
  }
  return shelves;
}

Start make_start(const LevelInputs& in, const PieceMemory& memory, const Shelves& shelves, MeshCounts& counts) {
  Start start;
  if (!in.inside()) {
    start.surface = std::make_unique<ShelfSurface>(*shelves.meshed, in.header.frame);
    return start;
  }
  start.around = in.make_shelf();
  check_dense(count_faces(ShelfSurface(*shelves.meshed, in.header.frame)), memory);
  start.mesh =
      std::make_unique<LatticeMesh>(inward_surface(*shelves.meshed, in.header.frame, in.make_shelf, *start.around));
  if (start.mesh->triangles.empty())
    fail(ErrorCode::bad_input, {Remedy::smaller_voxels, Remedy::smaller_scale},
         "the inside of the scene is too thin to mesh");
  counts.repaired = counts.voxels - std::uint64_t(-volume6_of(*start.mesh) / kVolume6OfVoxel);
  counts.solid_volume_world -= double(counts.repaired) * std::pow(in.header.frame.voxel, 3);
  drop_crumbs(in, *start.mesh, counts);
  start.surface = std::make_unique<MeshSurface>(*start.mesh);
  return start;
}

}  // namespace bp
