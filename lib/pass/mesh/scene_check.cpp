#include "lib/pass/mesh/scene_check.h"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/pass/mesh/complement.h"
#include "lib/voxel/voxelize.h"

namespace bp {

namespace {

constexpr std::int64_t kTrianglesAtOnce = 1 << 14;

/// Returns false for a point outside the box of bricks, or so near to its boundary that voxelization would set a voxel
/// outside.
bool is_among(const GridFrame& frame, std::int64_t slack, const Vec3d& p, const BrickBox& all) {
  const Vec3d v = frame.to_voxels(p);
  for (int i = 0; i < 3; ++i) {
    const double x = v[std::size_t(i)] / kBrickEdge;
    if (!(x > all.min[i] - 1 && x < all.max[i] + 1)) return false;  // far away, or not a number
  }
  const FixedPoint f = to_fixed(frame, p);
  const std::array<std::int64_t, 3> x = {f.x, f.y, f.z};
  for (int i = 0; i < 3; ++i) {
    if (x[std::size_t(i)] <= all.min[i] * kBrickEdge * kFixedOne + slack) return false;
    if (x[std::size_t(i)] >= all.max[i] * kBrickEdge * kFixedOne - slack) return false;
  }
  return true;
}

// Bricks, counted from the lowest one, with the number of a triangle that meets them.
using Items = std::vector<std::pair<TileCoord, std::uint32_t>>;

/// Lists the triangles that each brick meets, sorted by brick. Returns false if a corner lies outside all bricks.
bool sort_into_bricks(std::span<const TriangleD> triangles, const GridFrame& frame, std::int64_t slack,
                      const BrickBox& all, Items& items) {
  TileCoord count;
  for (int i = 0; i < 3; ++i) count[i] = all.max[i] - all.min[i];
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const Vec3d& p : triangles[t]) {
      if (!is_among(frame, slack, p, all)) return false;
    }
    for_each_tile(
        to_fixed(frame, triangles[t]), first_voxel(all.min), kBrickEdge, count,
        [&](TileCoord tile) { items.emplace_back(tile, std::uint32_t(t)); }, slack);
  }
  std::sort(items.begin(), items.end());
  return true;
}

bool holds(const BrickShelf& shelf, const BrickCoord& brick, std::span<const FixedTriangle> triangles,
           std::int64_t slack) {
  const VoxelCoord low = first_voxel(brick);
  BitBox met({low, {low.x + kBrickEdge, low.y + kBrickEdge, low.z + kBrickEdge}});
  voxelize_surface(triangles, met, slack);
  BrickBits bits{};
  (void)shelf.get(brick, bits);
  for (std::size_t i = 0; i < kBrickWords; ++i) {
    if ((met.data()[i] & ~bits[i]) != 0) return false;
  }
  return true;
}

bool lie_within(std::span<const TriangleD> triangles, const GridFrame& frame, std::int64_t slack,
                const BrickShelf& shelf, const BrickBox& all) {
  Items items;
  if (!sort_into_bricks(triangles, frame, slack, all, items)) return false;
  std::vector<FixedTriangle> fixed;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const TileCoord tile = items[i].first;
    fixed.push_back(to_fixed(frame, triangles[items[i].second]));
    if (i + 1 < items.size() && items[i + 1].first == tile) continue;
    if (!holds(shelf, {all.min.x + tile.x, all.min.y + tile.y, all.min.z + tile.z}, fixed, slack)) return false;
    fixed.clear();
  }
  return true;
}

}  // namespace

bool lies_within(std::span<const TriangleD> triangles, const Rounding& rounding, const GridFrame& frame,
                 const BrickShelf& shelf) {
  if (triangles.empty()) return true;
  const std::int64_t slack = fixed_slack(frame, rounding.any() ? rounding.of(bounds_of(triangles)) : 0);
  const BrickBox all = box_of_bricks(shelf);
  if (all.empty() || slack > kMostFixedSlack) return false;
  std::atomic<bool> within = true;
  parallel_ranges(std::int64_t(triangles.size()), kTrianglesAtOnce, [&](std::int64_t begin, std::int64_t end) {
    if (within &&
        !lie_within(triangles.subspan(std::size_t(begin), std::size_t(end - begin)), frame, slack, shelf, all))
      within = false;
  });
  return within;
}

void require_within(std::span<const TriangleD> triangles, const Rounding& rounding, const GridFrame& frame,
                    const BrickShelf& shelf) {
  if (lies_within(triangles, rounding, frame, shelf)) return;
  fail(ErrorCode::bad_input, {Remedy::enclose_own_scene},
       "the scene to be enclosed does not lie inside the voxels of the stream: the stream was made from another scene");
}

}  // namespace bp
