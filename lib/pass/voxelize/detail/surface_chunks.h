#pragma once
#include <array>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/core/triangle_source.h"
#include "lib/grid/stream.h"
#include "lib/pass/voxelize/detail/surface_bricks.h"
#include "lib/store/result_key.h"

/// The voxels that triangles touch, chunk by chunk: what a build keeps of a scene, so that the next one voxelizes only
/// what has changed (docs/decisions/0007-surface-chunks.md).
namespace bp {

/// Cuts a sequence of triangles where its content says so: triangles that are added, removed or moved change their own
/// chunks, perhaps the next one, and no others. Cost: 2 ns a triangle, and its hash.
class ChunkCutter {
 public:
  static constexpr std::uint64_t kLeast = 1 << 12, kMost = 1 << 16;  ///< triangles; the last chunk may be smaller
  static constexpr int kMeanBits = 14;  ///< one place in 2^14 may end a chunk, if it is not too near the last end

  struct Chunk {
    std::uint64_t triangles = 0;
    ResultKey content;  ///< content_of() its triangles
  };
  /// Returns the XXH3-128 of the coordinates, in order.
  [[nodiscard]] static ResultKey content_of(std::span<const TriangleD> triangles);

  /// Returns the triangles after which a chunk may end, by number in the span. Thread-safe.
  [[nodiscard]] static std::vector<std::uint32_t> places(std::span<const TriangleD> triangles);

  /// Takes the next triangles, with their places().
  void add(std::span<const TriangleD> triangles, std::span<const std::uint32_t> places);
  [[nodiscard]] const std::vector<Chunk>& chunks() const { return chunks_; }  ///< chunks that have ended
  [[nodiscard]] std::vector<Chunk> finish();

 private:
  void take(std::span<const TriangleD> triangles);
  void cut();
  ContentHash hash_;
  std::uint64_t open_ = 0;  // triangles in the chunk that has not ended
  std::vector<Chunk> chunks_;
};

/// Returns the key of a chunk's voxels in this frame. `slack`: as of voxelize_surface(), here and below.
[[nodiscard]] ResultKey chunk_key(const ChunkCutter::Chunk& chunk, const GridFrame& frame,
                                  std::int64_t slack = kFixedSlack);

/// Returns the voxels that the triangles touch (voxelize_surface), as bytes for BrickSum::add(): for each brick its
/// coordinates, a bit for each of its words that is not 0, and these words. `grid`: the bricks of the scene. Returns
/// nothing if the triangles are too large for a chunk: if the bytes exceed kChunkBytes, or the sum of the bricks that
/// each triangle meets exceeds kChunkMeetings. Memory: kChunkWorkBytes, and the bricks of one triangle.
[[nodiscard]] std::optional<std::string> chunk_voxels(std::span<const TriangleD> triangles, const GridFrame& frame,
                                                      const BrickBox& grid, std::int64_t slack = kFixedSlack);
constexpr std::size_t kChunkBytes = std::size_t(4) << 20, kChunkMeetings = std::size_t(1) << 17;
/// With the triangles, and with the bytes packed for the store.
constexpr std::uint64_t kChunkWorkBytes = std::uint64_t(24) << 20;

/// Adds up chunks. Bricks for which there is no room go to a shelf.
class BrickSum {
 public:
  BrickSum(const BrickBox& grid, std::uint64_t memory_bytes, BrickShelf& shelf)
      : grid_(grid), bricks_(memory_bytes), shelf_(shelf) {}

  /// Adds a chunk. Returns false, and adds nothing, if the bytes are no chunk in this grid. Thread-safe.
  [[nodiscard]] bool add(const std::string& chunk);
  /// Returns all bricks, in no order.
  [[nodiscard]] std::vector<BrickCoord> coords() const;
  /// Sets the voxels of the box, which consists of whole bricks, in `out`, and forgets them. To be called after the
  /// last add(). Thread-safe for boxes without common bricks.
  void take(BitBox& out);

 private:
  struct Shelved {
    std::mutex mutex;
    std::vector<BrickCoord> bricks;
  };
  const BrickBox grid_;
  SurfaceBricks bricks_;
  BrickShelf& shelf_;
  std::array<Shelved, 64> shelved_;  // by hash, so that threads seldom wait
};

}  // namespace bp
