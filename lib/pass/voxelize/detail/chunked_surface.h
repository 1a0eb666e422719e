#pragma once
#include <atomic>
#include <functional>

#include "lib/pass/voxelize/detail/surface_chunks.h"

/// Makes the surface voxels of a scene from the chunks of earlier builds, and from the triangles of the new chunks.
namespace bp {

class ChunkedSurface {
 public:
  /// Some consecutive triangles of the scene.
  struct Portion {
    std::vector<TriangleD> triangles;  ///< none if they were not kept
    std::uint64_t count = 0;
  };
  using NextPortion = std::function<bool(Portion&)>;  ///< as TriangleSource::read()

  /// `turn`: as in PassContext.
  ChunkedSurface(ResultStore& results, std::uint64_t turn) : results_(results), turn_(turn) {}

  /// First pass: takes the triangles in their order, with ChunkCutter::places().
  void measure(std::span<const TriangleD> triangles, std::span<const std::uint32_t> places);
  /// Returns whether the first `triangles` triangles of the scene all lie in complete chunks.
  [[nodiscard]] bool ended(std::uint64_t triangles) const { return triangles <= ended_; }
  /// Returns true if all of these triangles, counted from the first, lie in chunks that some build has voxelized. Such
  /// triangles need not stay in memory, though the voxels that are found may turn out to be of another frame.
  [[nodiscard]] bool met(std::uint64_t begin, std::uint64_t end) const;
  /// After the first pass: looks up the voxels of every chunk. `memory_bytes`: for bricks in memory.
  void look_up(const GridFrame& frame, std::int64_t slack, const BrickBox& grid, std::uint64_t memory_bytes,
               BrickShelf& shelf);
  [[nodiscard]] bool complete() const { return kept_ == chunks_.size(); }
  /// Returns true if triangles that are met() are needed after all.
  [[nodiscard]] bool needs_met() const;
  /// Voxelizes the missing chunks and keeps their voxels. `next` gives all triangles once more. Calls done(n, large)
  /// after n more triangles; `large` are those too large for a chunk, whose voxels the caller must find in every build.
  /// In a turn, chunks that another job has kept meanwhile are taken from there. `work_bytes`: for chunks at work.
  /// `window_bytes`: for triangles that wait, so that a turn has a choice. Throws bad_input if the triangles are not
  /// those of the first pass.
  void add_missing(const NextPortion& next, std::uint64_t work_bytes, std::uint64_t window_bytes,
                   const std::function<void(std::uint64_t, std::vector<TriangleD>&&)>& done);

  [[nodiscard]] std::uint64_t chunks() const { return chunks_.size(); }
  [[nodiscard]] std::uint64_t kept() const { return kept_; }  ///< with those that other jobs at work have kept
  [[nodiscard]] BrickSum& bricks() { return *bricks_; }

 private:
  class Reader;
  struct Item;
  [[nodiscard]] bool read_window(Reader& reader, std::uint64_t bytes, std::vector<Item>& window);
  [[nodiscard]] bool take_kept(std::size_t chunk);
  void make(Item& item);

  ResultStore& results_;
  const std::uint64_t turn_;
  ChunkCutter cutter_;
  std::vector<ChunkCutter::Chunk> chunks_;
  std::vector<char> met_, found_;  // by chunk
  std::uint64_t ended_ = 0;        // triangles in ended chunks
  // Ranges of triangles in chunks that were never voxelized.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> unmet_;
  std::atomic<std::uint64_t> kept_{0};
  std::size_t read_ = 0;  // chunks that add_missing() has passed
  GridFrame frame_;
  std::int64_t slack_ = kFixedSlack;
  BrickBox grid_;
  std::unique_ptr<BrickSum> bricks_;
};

}  // namespace bp
