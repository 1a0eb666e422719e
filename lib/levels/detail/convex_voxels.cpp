#include "lib/levels/detail/convex_voxels.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <span>
#include <tuple>

#include "lib/core/parallel.h"
#include "lib/grid/count_bits.h"
#include "lib/hulls/convex_hull.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

using Points = std::vector<LatticeCoord>;

/// Appends the corners of one side of a hull in a plane across z, of points by x and y. Andrew's monotone chain.
template <class Range>
void add_side(const Range& points, Points& corners) {
  const std::size_t first = corners.size();
  const auto turn = [](const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  for (const LatticeCoord& p : points) {
    while (corners.size() >= first + 2 && turn(corners.end()[-2], corners.back(), p) <= 0) corners.pop_back();
    corners.push_back(p);
  }
}

/// Those of a slice that may be corners of a hull.
Points slice_corners(Points points) {
  std::sort(points.begin(), points.end(),
            [](const LatticeCoord& a, const LatticeCoord& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
  Points corners;
  add_side(points, corners);
  std::reverse(points.begin(), points.end());
  add_side(points, corners);
  return corners;
}

/// The middles of voxels, in voxels.
Points possible_corners(const BrickShelf& solid) {
  std::map<std::int32_t, Points> slices;
  for (const VoxelRun& run : boundary_of(solid).runs) {
    const LatticeCoord first{run.first.x, run.first.y, run.first.z};
    Points& slice = slices[run.first.z];
    slice.push_back(first);
    if (run.length > 1) slice.push_back(first + LatticeCoord{run.length - 1, 0, 0});
  }
  Points corners;
  for (auto& [z, slice] : slices) {
    const Points some = slice_corners(std::move(slice));
    corners.insert(corners.end(), some.begin(), some.end());
  }
  return corners;
}

}  // namespace

std::uint64_t count_voxels(const BrickShelf& solid) {
  const std::vector<BrickCoord> coords = solid.coords();
  std::atomic<std::uint64_t> count{0};
  parallel_for(std::int64_t(coords.size()), [&](std::int64_t i) {
    BrickBits bits;
    solid.get(coords[std::size_t(i)], bits);
    count += count_bits(std::as_bytes(std::span(bits)));
  });
  return count;
}

double voxels_beside_hull(const BrickShelf& solid) {
  const std::optional<ConvexHull> hull = hull_of(possible_corners(solid));
  return (hull ? volume6_of(*hull) / 6 : 0) - double(count_voxels(solid));
}

}  // namespace bp
