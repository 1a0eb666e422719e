// A voxel's closing depends on the scales of voxels within the erosion's reach and one more (lib/closing/halo.cpp): of
// those whose erosion may reach it, and of the voxels beside them. The largest scale of both closings bounds that
// reach.
#include "lib/pass/close/detail/earlier_tiles.h"

#include <algorithm>

#include "lib/grid/clip.h"
#include "lib/pass/close/detail/tile_closer.h"
#include "lib/pass/close/same_scales.h"

namespace bp {

EarlierTiles::EarlierTiles(const EarlierClosing* earlier, const ScaleField& scale, const GridFrame& frame,
                           const ClosingParams& params)
    : earlier_(earlier), scale_(scale), frame_(frame) {
  if (earlier == nullptr) return;
  const Scale largest = std::max(scale.upper_bound(frame), earlier->scale.upper_bound(frame));
  reach_vox_ = widest_halo(largest, params).erosion_vox;
}

bool EarlierTiles::mostly_stays() const {
  return earlier_ != nullptr && earlier_->scale.base == scale_.base && earlier_->scale.slope == scale_.slope;
}

bool EarlierTiles::stays(const VoxelBox& tile) const {
  return earlier_ != nullptr && same_scales(earlier_->scale, scale_, frame_, tile.grown(reach_vox_));
}

void EarlierTiles::load(const VoxelBox& tile, BitBox& closed) const {
  closed.reset(tile);
  load_voxels(*earlier_->voxels, closed);
  for_each_brick(tile, [&](BrickCoord c) {
    BrickBits filled;
    if (earlier_->filled->get(c, filled) == BrickFill::empty) return;
    const VoxelCoord first = first_voxel(c);
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y) {
        closed.row(first.y + y, first.z + z)[(first.x - closed.box().min.x) / kBrickEdge] &=
            ~filled[std::size_t(z * kBrickEdge + y)];
      }
    }
  });
}

}  // namespace bp
