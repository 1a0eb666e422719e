#include "lib/levels/margin.h"

#include <cmath>

#include "lib/core/error.h"
#include "lib/volume/dilate_ball.h"

namespace bp {

std::unique_ptr<BrickShelf> add_margin(VoxelizedScene& scene, double margin_world, const PassContext& context) {
  constexpr double kRounding = 1 + 1e-12;  // rounding of the quotient and of squares
  const double reach = margin_world / scene.header.frame.voxel * kRounding;
  if (!(reach <= kMostReach))
    fail(ErrorCode::bad_argument, {Remedy::larger_voxels}, "a margin of {} is {:.0f} voxels, more than {}",
         margin_world, reach, kMostReach);
  auto grown = context.make_shelf();
  dilate_ball(*scene.solid, reach, *grown, context.memory, [&](std::uint64_t done, std::uint64_t total) {
    context.report("growing by the margin", "tiles", done, total);
  });
  std::unique_ptr<BrickShelf> before = std::move(scene.solid);
  put_solid(scene, std::move(grown));
  return before;
}

double farthest_of_margin(double margin_world, double voxel) {
  // The grown voxel holds the point, and the voxel that it is near to holds a point of the scene; each adds a diagonal.
  return margin_world + 2 * std::sqrt(3.0) * voxel;
}

}  // namespace bp
