#pragma once
#include <algorithm>
#include <vector>

#include "io/scene/detail/vertex_pool.h"
#include "io/scene/raw_source.h"

namespace bp {

/// Makes a batch's triangles of faces, as PolygonSource does.
class FaceMaker {
 public:
  /// `pool`: all vertices, in memory. `fans`: as SceneOptions::fans.
  FaceMaker(const VertexPool& pool, bool fans, RawBatch& batch) : pool_(pool), batch_(batch), cut_(fans) {}

  /// Adds a face. A corner that is no vertex of the pool makes it a bad one.
  void add(const std::vector<std::uint64_t>& corners) {
    const bool is_good = corners.size() >= 3 &&
                         std::all_of(corners.begin(), corners.end(), [&](std::uint64_t i) { return i < pool_.size(); });
    if (!is_good) {
      ++batch_.bad_faces;
      return;
    }
    const auto place = [&](std::size_t k) { return pool_.in_memory(corners[k]); };
    cut_.cut(corners.size(), place);
    const bool is_cut = corners.size() > 3;
    if (is_cut) batch_.inner_edges.resize(batch_.triangles.size());
    for (std::size_t i = 0; i < cut_.triangles(); ++i) {
      batch_.triangles.push_back(cut_.places(cut_[i], place));
      if (is_cut) batch_.inner_edges.push_back(cut_.inner_edges(i));
    }
  }

 private:
  const VertexPool& pool_;
  RawBatch& batch_;
  FaceTriangles cut_;
};

/// Empties a batch for the faces of the next of `blocks` blocks, whose number becomes its `records`, and counts it.
/// Returns false if there is none left.
inline bool next_block(RawBatch& batch, std::size_t& next, std::size_t blocks) {
  batch.bad_faces = 0;
  batch.triangles.clear();
  batch.inner_edges.clear();
  batch.records = next;
  return next++ < blocks;
}

}  // namespace bp
