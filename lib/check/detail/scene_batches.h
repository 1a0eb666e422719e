#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "lib/core/pool.h"
#include "lib/core/triangle_source.h"

namespace bp {

/// Triangles of a scene as its source gives them.
struct SceneChunk {
  std::vector<TriangleD> triangles;
  std::vector<std::uint8_t> inner_edges;  ///< TriangleSource::read_faces()
};

/// Some triangles of a scene. They stay in the chunks that they were read into, since copying all triangles would be
/// serial work.
struct SceneBatch {
  struct Part {
    std::shared_ptr<const SceneChunk> chunk;
    std::size_t begin, end;
  };
  std::uint64_t first = 0;  ///< number of the first triangle
  std::size_t count = 0;    ///< of triangles
  std::vector<Part> parts;

  /// Calls f(number, triangle, inner edges) for each triangle.
  template <class F>
  void for_each(F&& f) const {
    std::uint64_t number = first;
    for (const Part& part : parts) {
      const SceneChunk& chunk = *part.chunk;
      for (std::size_t i = part.begin; i < part.end; ++i) f(number++, chunk.triangles[i], chunk.inner_edges[i]);
    }
  }
};

/// Pulls from a source whose reads are of any size, and hands out batches of about one size and of whole polygons: sums
/// over batches do not depend on how the source reads.
class SceneBatches {
 public:
  explicit SceneBatches(TriangleSource& source) : source_(source) {}
  /// Returns false at the end, when the batch is empty. On one thread at a time.
  bool next(SceneBatch& batch) {
    batch.first = count_;
    while ((batch.count < kBatch || is_open(batch)) && refill()) {
      const std::size_t room = batch.count < kBatch ? kBatch - batch.count : 1;
      const std::size_t n = std::min(room, chunk_->triangles.size() - used_);
      if (batch.parts.empty() || batch.parts.back().chunk != chunk_) batch.parts.push_back({chunk_, used_, used_});
      batch.parts.back().end += n;
      batch.count += n;
      used_ += n, count_ += n;
    }
    return batch.count > 0;
  }

 private:
  static constexpr std::size_t kBatch = 8192;  // triangles

  /// Returns whether the next triangle belongs to the polygon of the last one.
  static bool is_open(const SceneBatch& batch) {
    const SceneBatch::Part& last = batch.parts.back();
    return (last.chunk->inner_edges[last.end - 1] & kSamePolygonAfter) != 0;
  }
  bool refill() {
    while (!ended_ && (!chunk_ || used_ == chunk_->triangles.size())) {
      SceneChunk chunk = spares_->take();
      ended_ = !source_.read_faces(chunk.triangles, colors_, chunk.inner_edges);
      if (ended_) break;
      used_ = 0;
      if (chunk.triangles.size() < chunk.triangles.capacity() / 4) {  // many chunks of few triangles make a batch
        chunk.triangles.shrink_to_fit();
        chunk.inner_edges.shrink_to_fit();
      }
      chunk_ =
          std::shared_ptr<const SceneChunk>(new SceneChunk(std::move(chunk)), [spares = spares_](SceneChunk* used) {
            spares->give(std::move(*used));
            delete used;
          });
    }
    return !ended_;
  }

  TriangleSource& source_;
  const std::shared_ptr<Spares<SceneChunk>> spares_ = std::make_shared<Spares<SceneChunk>>();
  std::shared_ptr<const SceneChunk> chunk_;
  std::vector<TriangleColors> colors_;  // not looked at
  std::size_t used_ = 0;                // of the chunk
  std::uint64_t count_ = 0;
  bool ended_ = false;
};

}  // namespace bp
