#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "lib/grid/bit_box.h"
#include "lib/grid/brick.h"
#include "lib/grid/coord_hash.h"
#include "lib/voxel/fixed_triangle.h"

namespace bp {

/// Surface voxels of a scene, in bricks that all threads add to at once while there is room for them. A surface of 2048
/// voxels a side lies in some thousand bricks: 32 KiB for some ten thousand triangles of a large scene.
class SurfaceBricks {
 public:
  explicit SurfaceBricks(std::uint64_t memory_bytes) : most_(memory_bytes / sizeof(BrickBits)) {}

  /// Sets the voxels that the triangles touch (voxelize_surface). Appends to `rest` triangles with a box longer than a
  /// brick, since they are few and one may be work for many threads, and triangles that meet a brick for which there is
  /// no room. Thread-safe.
  void add(std::span<const TriangleD> triangles, const GridFrame& frame, std::int64_t slack,
           std::vector<FixedTriangle>& rest);

  /// Returns the bits of a brick, which is made if it is new; null if there is no room. Thread-safe.
  [[nodiscard]] BrickBits* find(BrickCoord c);
  [[nodiscard]] std::uint64_t memory_bytes() const { return count_ * sizeof(BrickBits); }
  /// Returns the bricks with voxels, in no order.
  [[nodiscard]] std::vector<BrickCoord> coords() const;
  /// Sets the voxels of the box, which consists of whole bricks, in `out`, and forgets them. To be called after the
  /// last add(). Thread-safe for boxes without common bricks.
  void take(BitBox& out);

 private:
  class Finder;
  /// Adds a triangle's voxels; returns false if it belongs to the rest.
  [[nodiscard]] bool add(const TriangleD& t, std::int64_t slack, const VoxelBox& touched, const FixedFrame& to_fixed,
                         Finder& find);
  static constexpr std::size_t kShards = 64;  // more than threads, so that few wait for another
  struct Shard {
    mutable std::mutex mutex;
    std::unordered_map<BrickCoord, std::unique_ptr<BrickBits>, CoordHash> bricks;
  };
  [[nodiscard]] Shard& shard_of(BrickCoord c) { return shards_[CoordHash()(c) % kShards]; }

  const std::uint64_t most_;
  std::atomic<std::uint64_t> count_{0};
  std::array<Shard, kShards> shards_;
};

}  // namespace bp
