#include "lib/volume/dilate_ball.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "lib/closing/ball_dilation.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/tile_grid.h"
#include "lib/volume/dilate.h"

// The space between cubes that are d apart along an axis is |d| - 1, or nothing. That is the distance of the middle of
// one cube from the nearest of the middles around the other. So voxels are grown by one along each axis, and then by a
// ball.

namespace bp {

namespace {

constexpr double kAround = 3;       // boxes, as large as everything in reach of a tile, at once
constexpr double kTiles = 5;        // boxes of a tile
constexpr double kFixed = 8 << 20;  // of the ball's transform
constexpr double kBitsPerByte = 8;
constexpr std::int32_t kMostHalos = 8;  // edges of a tile: larger tiles are hardly faster

class BallDilater {
 public:
  BallDilater(const BrickShelf& voxels, double reach, const MemoryShare& memory)
      : voxels_(voxels), bound_(std::int32_t(std::ceil(reach * reach))), halo_(std::int32_t(std::ceil(reach)) + 1) {
    const std::vector<BrickCoord> bricks = voxels.coords();
    for (const BrickCoord& c : bricks) solid_ = hull(solid_, voxels_of(c));
    space_ = voxels_of(bricks_of(solid_.grown(halo_)));
    lay_tiles(bricks, memory);
  }

  void run(BrickShelf& out, const std::function<void(std::uint64_t, std::uint64_t)>& progress) {
    struct Item {
      VoxelBox tile;
      BitBox grown;
    };
    std::size_t next = 0, done = 0;
    pipeline<Item>(
        at_once_,
        [&](Item& item) { return next < reached_.size() && (item.tile = tiles_.box(reached_[next++]), true); },
        [&](Item& item) { grow(item.tile, item.grown); },
        [&](Item& item) {
          store_voxels(item.grown, out);
          if (progress) progress(++done, reached_.size());
        });
  }

 private:
  [[nodiscard]] double bytes_around(std::int32_t edge) const {
    const auto side = [&](int axis) { return std::min(edge, space_.size()[axis]) + 2.0 * halo_; };
    return (side(0) + 128) * side(1) * side(2) / kBitsPerByte;
  }
  [[nodiscard]] double bytes_of(std::int32_t edge) const {
    return kAround * bytes_around(edge) + kTiles * std::pow(edge, 3) / kBitsPerByte + kFixed;
  }

  void lay_tiles(const std::vector<BrickCoord>& bricks, const MemoryShare& memory) {
    double best = 0;
    std::int32_t edge = kBrickEdge;
    const VoxelCoord size = space_.size();
    const std::int32_t most = std::min(2 * std::max({size.x, size.y, size.z}), std::max(kMostHalos * halo_, edge + 1));
    for (std::int32_t e = edge; e < most; e *= 2) {
      const double tiles = TileGrid(space_, e).total(), fit = std::floor(double(memory.bytes) / bytes_of(e));
      const double speed = std::min({fit, double(thread_count()), tiles}) / (tiles * bytes_around(e));
      if (speed > best) edge = e;
      best = std::max(best, speed);
    }
    if (bytes_of(edge) > double(memory.bytes)) {
      const auto needed = std::uint64_t(bytes_of(edge));
      throw NeedsMemory(fmt::format("growing a tile of {} voxels by {}", edge, halo_), needed, memory.bytes,
                        memory.limit_with(needed - memory.bytes), {Remedy::larger_voxels});
    }
    at_once_ = int(std::clamp(double(memory.bytes) / bytes_of(edge), 1.0, double(thread_count())));
    tiles_ = TileGrid(space_, edge);
    std::set<TileCoord> reached;
    for (const BrickCoord& c : bricks)
      for_each(tiles_.tiles_of(voxels_of(c).grown(halo_)), [&](const TileCoord& t) { reached.insert(t); });
    reached_.assign(reached.begin(), reached.end());
  }

  void grow(const VoxelBox& tile, BitBox& grown) const {
    BitBox around(intersect(tile.grown(halo_), solid_.grown(1)));
    load_voxels(voxels_, around);
    dilate(around, 1);
    grown.reset(tile);
    ClosingScratch scratch;
    dilate_by_ball(around, bound_, grown, scratch);
  }

  const BrickShelf& voxels_;
  const std::int32_t bound_;  ///< of squared distances
  const std::int32_t halo_;
  VoxelBox solid_, space_;
  TileGrid tiles_;
  std::vector<TileCoord> reached_;
  int at_once_ = 1;
};

}  // namespace

void dilate_ball(const BrickShelf& voxels, double reach, BrickShelf& out, const MemoryShare& memory,
                 const std::function<void(std::uint64_t, std::uint64_t)>& progress) {
  if (voxels.coords().empty()) return;
  if (reach > 0) return BallDilater(voxels, reach, memory).run(out, progress);
  BrickBits bits;
  for (const BrickCoord& c : voxels.coords()) out.put(c, voxels.get(c, bits), bits);
}

}  // namespace bp
