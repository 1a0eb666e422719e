#include "lib/stage/chunked_surface.h"

#include <algorithm>

#include "lib/core/error.h"
#include "lib/core/parallel.h"

namespace bp {

/// A chunk to be made.
struct ChunkedSurface::Item {
  std::size_t chunk = 0;
  std::uint64_t skipped = 0;  // triangles before it, of chunks that are known
  std::vector<TriangleD> triangles;
};

/// Triangles by number, one batch at a time.
class ChunkedSurface::Reader {
 public:
  explicit Reader(const NextTriangles& next) : next_(next) {}
  /// Appends the next n to `out`, unless it is null; false if there are fewer.
  bool take(std::uint64_t n, std::vector<TriangleD>* out) {
    while (n > 0) {
      if (at_ == batch_.size()) {
        at_ = 0;
        if (!next_(batch_)) return false;
      }
      const auto here = std::size_t(std::min<std::uint64_t>(n, batch_.size() - at_));
      const auto first = batch_.begin() + std::ptrdiff_t(at_);
      if (out != nullptr) out->insert(out->end(), first, first + std::ptrdiff_t(here));
      at_ += here;
      n -= here;
    }
    return true;
  }

 private:
  const NextTriangles& next_;
  std::vector<TriangleD> batch_;
  std::size_t at_ = 0;
};

void ChunkedSurface::look_up(const GridFrame& frame, const BrickBox& grid, std::uint64_t memory_bytes,
                             BrickShelf& shelf) {
  frame_ = frame;
  grid_ = grid;
  chunks_ = cutter_.finish();
  found_.assign(chunks_.size(), 0);
  bricks_ = std::make_unique<BrickSum>(grid, memory_bytes, shelf);
  parallel_for(std::int64_t(chunks_.size()), [&](std::int64_t i) {
    std::string bytes;
    const bool there = results_.get(chunk_key(chunks_[std::size_t(i)], frame_), bytes);
    found_[std::size_t(i)] = there && bricks_->add(bytes);
  });
  kept_ = std::uint64_t(std::count(found_.begin(), found_.end(), 1));
}

void ChunkedSurface::add_missing(const NextTriangles& next, const std::function<void(std::uint64_t)>& done) {
  Reader reader(next);
  std::size_t chunk = 0;
  const auto changed = [] { fail(ErrorCode::bad_input, "the scene changed between the first and the second reading"); };
  pipeline<Item>(
      thread_count() + 1,
      [&](Item& item) {
        for (; chunk < chunks_.size() && found_[chunk] != 0; ++chunk) {
          item.skipped += chunks_[chunk].triangles;
          if (!reader.take(chunks_[chunk].triangles, nullptr)) changed();
        }
        if (chunk == chunks_.size()) return false;
        item.chunk = chunk;
        if (!reader.take(chunks_[chunk++].triangles, &item.triangles)) changed();
        return true;
      },
      [&](Item& item) {
        if (ChunkCutter::content_of(item.triangles) != chunks_[item.chunk].content) changed();
        make(item);
      },
      [&](Item& item) { done(item.skipped + item.triangles.size()); });
}

void ChunkedSurface::make(const Item& item) {
  const std::string bytes = chunk_voxels(item.triangles, frame_, grid_);
  results_.put(chunk_key(chunks_[item.chunk], frame_), bytes);
  if (!bricks_->add(bytes)) fail(ErrorCode::failed, "a chunk of triangles has voxels outside the grid of its scene");
}

}  // namespace bp
