#pragma once
#include <functional>
#include <string>
#include <vector>

#include "lib/core/box.h"
#include "lib/pass/pass_progress.h"
#include "lib/pass/voxelize/detail/chunked_surface.h"
#include "lib/pass/voxelize/detail/surface_sums.h"

namespace bp {

/// The two passes over the triangles of a scene: one for its bounds, one for the triangles. They stay in between as
/// long as they fit in memory; else the scene is read a second time, which must give the same triangles.
class ScenePasses {
 public:
  using Portion = ChunkedSurface::Portion;
  using NextPortion = ChunkedSurface::NextPortion;

  /// Keeps references. `memory_bytes`: for triangles that stay. `chunks`: null, or told all triangles of the first
  /// pass; those that it has met do not stay.
  ScenePasses(TriangleSource& source, std::uint64_t memory_bytes, ChunkedSurface* chunks)
      : source_(source), memory_bytes_(memory_bytes), chunks_(chunks) {}

  /// First pass. Throws bad_input if there is no triangle.
  void measure(const PassProgress& progress);
  [[nodiscard]] const Bounds3d& bounds() const { return bounds_; }
  /// Sums over the triangles, scene units: areas, and sides of their boxes.
  [[nodiscard]] double area() const { return sums_.area(); }
  [[nodiscard]] double extent() const { return extent_; }
  [[nodiscard]] const SurfaceSums& sums() const { return sums_; }
  [[nodiscard]] const std::string& input_hash() const { return input_hash_; }  ///< of VoxelizeCounts
  [[nodiscard]] bool reads_twice() const { return reads_twice_; }

  /// Those that did not stay are needed after all.
  void read_twice() { reads_twice_ = true; }
  /// Second pass, once: calls body with what gives all portions, and those that did not stay without triangles, unless
  /// the scene is read twice. Throws bad_input if it is not what it was.
  void again(const std::function<void(const NextPortion&)>& body);
  /// Forgets the triangles that stayed.
  void release() { std::vector<Portion>().swap(kept_); }

 private:
  struct Item;
  void keep(Item&& item);
  void drop_met();

  TriangleSource& source_;
  const std::uint64_t memory_bytes_;
  ChunkedSurface* const chunks_;
  Bounds3d bounds_;
  double extent_ = 0;
  SurfaceSums sums_;
  std::string input_hash_;
  bool reads_twice_ = false;
  std::vector<Portion> kept_;
  std::size_t dropped_ = 0;                         // first of kept_ that drop_met() has not settled
  std::uint64_t dropped_end_ = 0, kept_bytes_ = 0;  // triangles before it; of those that stay
};

}  // namespace bp
