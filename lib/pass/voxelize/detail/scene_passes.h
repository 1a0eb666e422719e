#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/pool.h"
#include "lib/pass/pass_progress.h"
#include "lib/pass/voxelize/detail/chunked_surface.h"
#include "lib/pass/voxelize/detail/surface_sums.h"
#include "lib/pass/voxelize/detail/triangle_bins.h"

namespace bp {

/// The two passes over the triangles of a scene: the first for its bounds, the second for the triangles. If the
/// triangles fit in memory, they stay there in between. If not, the scene is read a second time; it is an error if it
/// gives other triangles then.
class ScenePasses {
 public:
  using Portion = ChunkedSurface::Portion;
  using NextPortion = ChunkedSurface::NextPortion;

  /// Keeps references. `memory_bytes`: for triangles that stay. `chunks`: null, or gets all triangles of the first
  /// pass; triangles that it has met do not stay.
  ScenePasses(TriangleSource& source, std::uint64_t memory_bytes, ChunkedSurface* chunks)
      : source_(source), memory_bytes_(memory_bytes), chunks_(chunks) {}

  /// Work on the triangles that is done in the first pass already, if they lie in `bounds`.
  struct Sorter {
    Bounds3d bounds;
    std::function<TriangleBatch(std::span<const TriangleD>)> sort;  ///< on any thread
    std::function<void(TriangleBatch&&)> add;                       ///< in order
  };
  /// First pass. With a sorter no triangles stay in memory. Throws bad_input if there is no triangle.
  void measure(const PassProgress& progress, const std::optional<Sorter>& sorter);
  /// Returns whether the sorter was given all triangles.
  [[nodiscard]] bool sorted() const { return sorted_; }
  [[nodiscard]] const SurfaceSums& sums() const { return sums_; }              ///< sums over all triangles
  [[nodiscard]] const std::string& input_hash() const { return input_hash_; }  ///< as in VoxelizeCounts
  [[nodiscard]] bool reads_twice() const { return reads_twice_; }

  /// Takes the memory of a portion's triangles back for the next portion.
  void give_back(std::vector<TriangleD>&& triangles) { spare_.give(std::move(triangles)); }
  /// Says that triangles which did not stay are needed: the second pass reads the scene again.
  void read_twice() { reads_twice_ = true; }
  /// Second pass, once: calls `body` with a function that gives all portions. Triangles that did not stay are missing
  /// in them, unless the scene is read twice. Throws bad_input if the scene has changed.
  void again(const std::function<void(const NextPortion&)>& body);
  /// Frees the triangles that stayed, and the memory kept for others.
  void release() {
    std::vector<Portion>().swap(kept_);
    spare_.clear();
  }

 private:
  struct Item;
  void keep(std::vector<TriangleD>&& triangles);
  void drop_met();

  TriangleSource& source_;
  const std::uint64_t memory_bytes_;
  ChunkedSurface* const chunks_;
  SurfaceSums sums_;
  std::string input_hash_;
  bool reads_twice_ = false;
  std::vector<Portion> kept_;
  std::size_t dropped_ = 0;                         // first portion of kept_ that drop_met() has not decided on
  std::uint64_t dropped_end_ = 0, kept_bytes_ = 0;  // triangles before that portion; bytes of those that stay
  std::atomic<bool> sorted_{false};
  Spares<std::vector<TriangleD>> spare_;
};

}  // namespace bp
