#include "lib/pass/close/detail/tile_closer.h"

#include <algorithm>
#include <optional>

#include "lib/core/error.h"
#include "lib/grid/clip.h"

namespace bp {

namespace {

std::vector<Backend*> first_of(Backends& backends, std::size_t at_work) {
  if (backends.empty()) fail(ErrorCode::bad_argument, "closing needs a backend, and none was made");
  std::vector<Backend*> some;
  for (std::size_t i = 0; i < std::min(at_work, backends.size()); ++i) some.push_back(backends[i].get());
  return some;
}

}  // namespace

Halo widest_halo(Scale s, const ClosingParams& params) {
  return {element_reach(s) + 1, element_reach(s, params)};
}

TileCloser::TileCloser(const Input& input, BrickShelf& shelf, Backends& backends, std::size_t at_work)
    : input_(input),
      widest_(widest_halo(input.scale.upper_bound(input.header.frame), input.params)),
      shelf_(shelf),
      backends_(first_of(backends, at_work)) {}

void TileCloser::flood(const VoxelBox& grid, std::int32_t tile_vox) {
  flood_ = std::make_unique<OutsideFlood>(grid, VoxelCoord{tile_vox, tile_vox, tile_vox});
}

Halo TileCloser::halo(const VoxelBox& tile) const {
  return input_.scale.constant() ? widest_ : halo_of(tile, input_.scale, input_.header.frame, input_.params);
}

bool TileCloser::in_reach(const VoxelBox& tile, const Halo& halo) const {
  return fill_of(tile.grown(halo.total_vox())) != BrickFill::empty;
}

/// Returns empty or full if all bricks that hold voxels of the box are so.
BrickFill TileCloser::fill_of(const VoxelBox& voxels) const {
  bool all_empty = true, all_full = true;
  const BrickBox wanted = bricks_of(voxels), there = intersect(wanted, input_.header.bricks);
  if (there.empty()) return BrickFill::empty;
  for_each(there, [&](BrickCoord c) {
    const BrickFill fill = input_.solid.fill(c);
    all_empty = all_empty && fill == BrickFill::empty;
    all_full = all_full && fill == BrickFill::full;
  });
  return all_empty ? BrickFill::empty : all_full && there == wanted ? BrickFill::full : BrickFill::mixed;
}

ScaleLattice TileCloser::scales(const VoxelBox& tile, const Halo& halo) const {
  VoxelBox sampled =
      hull(intersect(tile.grown(halo.total_vox()), voxels_of(input_.header.bricks)), tile.grown(halo.erosion_vox));
  sampled.min.x = floor_div(sampled.min.x, kBrickEdge) * kBrickEdge;  // whole words are computed
  sampled.max.x = ceil_div(sampled.max.x, kBrickEdge) * kBrickEdge;
  return input_.scale.sample(input_.header.frame, sampled);
}

void TileCloser::close(const VoxelBox& tile, const Halo& halo, BitBox& closed) {
  if (fill_of(tile) == BrickFill::full) {
    closed.reset(tile);
    std::fill_n(closed.data(), closed.word_count(), ~std::uint64_t(0));
    return;
  }
  const ScaleLattice lattice = scales(tile, halo);
  std::optional<Stopwatch> waits(waiting);
  const Pool<Backend*>::Lease backend(backends_);
  waits.reset();
  const Stopwatch works(closing);
  backend->close_from_shelf(input_.solid, input_.header.bricks, lattice, halo, input_.params, tile, closed);
}

void TileCloser::keep(const VoxelBox& tile, const BitBox& closed) {
  {
    const Stopwatch watch(shelving);
    store_voxels(closed, shelf_);
  }
  label(tile, closed);
}

void TileCloser::label(const VoxelBox& tile, const BitBox& closed) {
  if (!flood_) return;
  const Stopwatch watch(labelling);
  OutsideFlood::Labels labels = OutsideFlood::label(closed, tile);
  const std::lock_guard lock(flood_mutex_);
  flood_->join(std::move(labels));
}

std::uint64_t TileCloser::fill(const VoxelBox& tile, BitBox& bits, BrickShelf* filled_too) {
  const Stopwatch watch(filling);
  bits.reset(tile);
  load_voxels(shelf_, bits);
  BitBox cavities = filled_too != nullptr ? bits : BitBox();
  const std::uint64_t filled = flood_->fill_enclosed(tile, bits);
  store_voxels(bits, shelf_);
  if (filled_too == nullptr) return filled;
  for (std::int64_t i = 0; i < bits.word_count(); ++i) cavities.data()[i] ^= bits.data()[i];
  store_voxels(cavities, *filled_too);
  return filled;
}

}  // namespace bp
