#pragma once
#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <span>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include "lib/grid/tile_grid.h"
#include "lib/store/page_block.h"
#include "lib/store/scratch.h"
#include "lib/voxel/fixed_triangle.h"

/// Sorts triangles by the tiles that they meet, in memory up to a budget, then in a Scratch.
namespace bp {

/// Nine coordinates relative to the tile's corner, fixed point, 36 bytes: for triangles within 2^15 voxels of that
/// corner.
using NarrowTriangle = std::array<std::int32_t, 9>;

/// The triangles of some tiles, as one call of sort() found them.
struct TriangleBatch {
  struct Bin {
    std::uint64_t tile = 0;
    std::vector<NarrowTriangle> narrow;
    std::vector<FixedTriangle> wide;
  };
  std::vector<Bin> bins;
};

/// Records in blocks that grow with their number up to 64 KiB, so that nothing is copied when there are more.
template <class T>
class Blocks {
 public:
  void append(std::span<const T> records) {
    while (!records.empty()) {
      if (last_size_ == last_capacity_) grow();
      const std::size_t n = std::min(records.size(), last_capacity_ - last_size_);
      std::memcpy(blocks_.back().data() + last_size_ * sizeof(T), records.data(), n * sizeof(T));
      last_size_ += n;
      records = records.subspan(n);
    }
  }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }  ///< memory taken
  /// Calls body(span of T) for each block.
  template <class Body>
  void for_each(const Body& body) const {
    for (const PageBlock& block : blocks_) {
      const std::size_t n = &block == &blocks_.back() ? last_size_ : block.bytes() / sizeof(T);
      body(std::span<const T>(reinterpret_cast<const T*>(block.data()), n));
    }
  }

 private:
  static_assert(std::is_trivially_copyable_v<T>);
  void grow() {
    constexpr std::size_t kLeast = 512, kMost = 65536;
    const PageBlock& block = blocks_.emplace_back(std::clamp<std::size_t>(bytes_, kLeast, kMost));
    bytes_ += block.bytes();
    last_capacity_ = block.bytes() / sizeof(T);
    last_size_ = 0;
  }
  std::vector<PageBlock> blocks_;
  std::size_t last_size_ = 0, last_capacity_ = 0;  ///< of the last block, in records; the others are full
  std::uint64_t bytes_ = 0;
};

class TriangleBins {
 public:
  TriangleBins(const TileGrid& grid, Scratch& store) : grid_(grid), store_(store) {}

  /// Sorts triangles. Each goes into every tile that it meets (lib/voxel/voxelize.h, for_each_tile). Thread-safe.
  [[nodiscard]] TriangleBatch sort(std::span<const FixedTriangle> triangles, std::int64_t slack) const;
  /// Adds a batch. On one thread only.
  void add(TriangleBatch&& batch);

  [[nodiscard]] std::uint64_t memory_bytes() const { return memory_bytes_; }  ///< bytes of the triangles in memory
  /// Returns the bytes of the records about each tile ever added to and about each chunk in the store, with the maps
  /// around them.
  [[nodiscard]] std::uint64_t table_bytes() const;
  [[nodiscard]] std::uint64_t records() const { return records_; }     ///< triangles added so far, once for each tile
  [[nodiscard]] std::vector<std::uint64_t> tiles() const;              ///< all tiles ever added to, sorted
  [[nodiscard]] std::uint64_t memory_bytes(std::uint64_t tile) const;  ///< bytes in memory for one tile
  /// Calls body with the tile's triangles, some ten thousand at a time. Thread-safe for distinct tiles.
  void for_each(std::uint64_t tile, const std::function<void(std::span<const FixedTriangle>)>& body) const;
  /// Moves the triangles that the tiles have in memory to the store, in parallel.
  void spill(std::span<const std::uint64_t> tiles);
  /// Forgets the triangles of a tile, wherever they are. Thread-safe for distinct tiles, but not while add() runs.
  void release(std::uint64_t tile);
  /// Counts memory and chunks anew. To be called after release() of many tiles.
  void recount();

 private:
  struct Bin {
    Blocks<NarrowTriangle> narrow;
    Blocks<FixedTriangle> wide;
    std::vector<Scratch::Handle> narrow_chunks, wide_chunks;
    [[nodiscard]] std::uint64_t bytes() const { return narrow.bytes() + wide.bytes(); }
  };
  TileGrid grid_;
  Scratch& store_;
  std::unordered_map<std::uint64_t, Bin> bins_;
  std::uint64_t memory_bytes_ = 0, records_ = 0;
  std::uint64_t chunks_ = 0;  // chunks in the store when memory was last counted
};

}  // namespace bp
