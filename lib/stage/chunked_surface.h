#pragma once
#include <functional>

#include "lib/stage/surface_chunks.h"

/// The surface voxels of a scene from the chunks of earlier builds, and from the triangles of what is new.
namespace bp {

class ChunkedSurface {
 public:
  using NextTriangles = std::function<bool(std::vector<TriangleD>&)>;  ///< as TriangleSource::read()

  explicit ChunkedSurface(ResultStore& results) : results_(results) {}

  /// First pass: the triangles in their order, with ChunkCutter::places().
  void measure(std::span<const TriangleD> triangles, std::span<const std::uint32_t> places) {
    cutter_.add(triangles, places);
  }
  /// After it: looks up the voxels of every chunk. `memory_bytes`: for bricks in memory.
  void look_up(const GridFrame& frame, const BrickBox& grid, std::uint64_t memory_bytes, BrickShelf& shelf);
  [[nodiscard]] bool complete() const { return kept_ == chunks_.size(); }
  /// Voxelizes the other chunks, and keeps them. `next` gives all triangles once more; done(n): behind n more of them.
  /// Throws bad_input if they are not those of the first pass.
  void add_missing(const NextTriangles& next, const std::function<void(std::uint64_t)>& done);

  [[nodiscard]] std::uint64_t chunks() const { return chunks_.size(); }
  [[nodiscard]] std::uint64_t kept() const { return kept_; }
  [[nodiscard]] BrickSum& bricks() { return *bricks_; }

 private:
  class Reader;
  struct Item;
  void make(const Item& item);

  ResultStore& results_;
  ChunkCutter cutter_;
  std::vector<ChunkCutter::Chunk> chunks_;
  std::vector<char> found_;
  std::uint64_t kept_ = 0;
  GridFrame frame_;
  BrickBox grid_;
  std::unique_ptr<BrickSum> bricks_;
};

}  // namespace bp
