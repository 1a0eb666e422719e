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

/// Triangles sorted by the tiles they meet, in memory up to a budget, then in a Scratch.
namespace bp {

/// Nine coordinates relative to the tile's corner, fixed point, 36 bytes: for triangles within 2^15 voxels of it.
using NarrowTriangle = std::array<std::int32_t, 9>;

/// The triangles of some tiles: what one call of sort() found.
struct TriangleBatch {
  struct Bin {
    std::uint64_t tile = 0;
    std::vector<NarrowTriangle> narrow;
    std::vector<FixedTriangle> wide;
  };
  std::vector<Bin> bins;
};

/// Records in blocks that grow with their number up to 64 KiB: nothing is copied when there are more.
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
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }  ///< taken from memory
  /// body(span of T) for each block.
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

  /// Thread-safe. A triangle goes into each tile that it meets (lib/voxel/voxelize.h, for_each_tile).
  [[nodiscard]] TriangleBatch sort(std::span<const FixedTriangle> triangles) const;
  /// On one thread.
  void add(TriangleBatch&& batch);

  [[nodiscard]] std::uint64_t memory_bytes() const { return memory_bytes_; }  ///< of the triangles held
  /// Of what is kept of each tile ever added to, and of each chunk in the store, with the map around it.
  [[nodiscard]] std::uint64_t table_bytes() const;
  [[nodiscard]] std::uint64_t records() const { return records_; }     ///< added so far
  [[nodiscard]] std::vector<std::uint64_t> tiles() const;              ///< ever added to; sorted
  [[nodiscard]] std::uint64_t memory_bytes(std::uint64_t tile) const;  ///< held for one tile
  /// Calls body with the tile's triangles, some ten thousand at a time. Thread-safe for distinct tiles.
  void for_each(std::uint64_t tile, const std::function<void(std::span<const FixedTriangle>)>& body) const;
  /// Puts into the store what the tiles hold in memory, in parallel.
  void spill(std::span<const std::uint64_t> tiles);
  /// Forgets the triangles of a tile, wherever they are. Thread-safe for distinct tiles, but not beside add().
  void release(std::uint64_t tile);
  /// After release() of many tiles: counts memory and chunks anew.
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
  std::uint64_t chunks_ = 0;  // in the store, when memory was counted last
};

}  // namespace bp
