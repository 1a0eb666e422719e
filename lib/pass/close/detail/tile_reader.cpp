#include "lib/pass/close/detail/tile_reader.h"

#include <limits>

#include "lib/pass/close/detail/tile_closer.h"

namespace bp {

TileReader::TileReader(BrickSource& source, BrickShelf& solid, const TileGrid& tiles, const Halo& widest)
    : source_(source), solid_(solid), tiles_(tiles), widest_(widest), axis_(source.header().slab_axis) {
  more_ = source_.read(next_brick_);
}

bool TileReader::next(TileCoord& tile) {
  while (queue_.empty()) {
    if (next_slab_ == tiles_.count[axis_]) return false;
    read_before(end_of(next_slab_) + widest_.total_vox());
    const std::lock_guard lock(mutex_);
    const auto found = slabs_.lower_bound(next_slab_);
    if (found == slabs_.end() && !more_) return false;
    if (found != slabs_.end() && found->first == next_slab_)
      queue_.assign(found->second.rbegin(), found->second.rend());
    ++next_slab_;
  }
  tile = queue_.back();
  queue_.pop_back();
  return true;
}

void TileReader::read_rest() {
  read_before(std::numeric_limits<std::int64_t>::max());
}

/// Takes the bricks that begin before `end_vox` across the slab axis.
void TileReader::read_before(std::int64_t end_vox) {
  const Stopwatch watch(seconds);
  const auto next = [&](Brick& brick) {
    if (!more_ || std::int64_t(next_brick_.coord[axis_]) * kBrickEdge >= end_vox) return false;
    brick = next_brick_;
    more_ = source_.read(next_brick_);
    list_tiles(brick);
    return true;
  };
  for_bricks(next, [&](const Brick& brick) {
    if (brick.layer == Layer::solid) solid_.put(brick.coord, brick.fill, brick.bits);
  });
}

void TileReader::list_tiles(const Brick& brick) {
  if (brick.layer != Layer::solid) {
    ++ignored_bricks;
    return;
  }
  const BrickCoord end{brick.coord.x + 1, brick.coord.y + 1, brick.coord.z + 1};
  const VoxelBox reach = intersect(voxels_of({brick.coord, end}).grown(widest_.dilation_vox), tiles_.voxels);
  const std::lock_guard lock(mutex_);
  for_each(tiles_.tiles_of(reach), [&](TileCoord t) { slabs_[t[axis_]].insert(t); });
}

std::optional<TileReader::SlabTiles> TileReader::take_before(std::int32_t current) {
  const std::lock_guard lock(mutex_);
  const auto first = slabs_.begin();
  if (first == slabs_.end() || end_of(first->first) + widest_.total_vox() > end_of(current - 1)) return {};
  return std::move(slabs_.extract(first).mapped());
}

std::vector<std::pair<std::int32_t, TileReader::SlabTiles>> TileReader::take_all() {
  std::vector<std::pair<std::int32_t, SlabTiles>> all(slabs_.begin(), slabs_.end());
  slabs_.clear();
  return all;
}

}  // namespace bp
