#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/triangle_source.h"
#include "lib/levels/tile_plan.h"

/// Where the surface of a scene lies, roughly: what the work of each job of a tileset is estimated from.
namespace bp {

/// Neighbours in the scene's order.
struct SurfaceRun {
  Bounds3d bounds;
  double area = 0;  ///< of all triangles, scene units squared
};

/// Of at most 64 triangles each.
[[nodiscard]] std::vector<SurfaceRun> surface_runs(std::span<const TriangleD> triangles);

/// Keeps at most 2^16 runs: 4 MB. The same scene gives the same map.
class SurfaceMap {
 public:
  void add(std::span<const SurfaceRun> runs);
  [[nodiscard]] const SurfaceRun& all() const { return all_; }
  /// Of each job, by its number: faces of voxels that its share of the surface takes, about. A run's area counts evenly
  /// in its box.
  [[nodiscard]] std::vector<double> work(const TilesetPlan& plan, Cells cells) const;

 private:
  SurfaceRun all_;
  std::vector<SurfaceRun> runs_;
  std::uint64_t grain_ = 1;  ///< runs that were added, in each that is kept but the last
  std::uint64_t last_ = 0;   ///< in the last
};

}  // namespace bp
