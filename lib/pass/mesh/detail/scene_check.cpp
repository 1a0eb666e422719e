#include "lib/pass/mesh/detail/scene_check.h"

#include <algorithm>
#include <atomic>

#include "lib/core/parallel.h"
#include "lib/voxel/voxelize.h"

namespace bp {

namespace {

/// Bricks of `shelf` as the tiles that triangles are sorted into.
struct Bins {
  BrickCoord first{};
  TileCoord count{};
  std::vector<std::pair<TileCoord, std::uint32_t>> items;  // tile, triangle
};

/// False for a point outside the bricks from `low` to `high`, or so near to their outside that a voxel there would be
/// set.
bool is_among(const GridFrame& frame, const Vec3d& p, const BrickCoord& low, const BrickCoord& high) {
  const Vec3d v = frame.to_voxels(p);
  for (int i = 0; i < 3; ++i) {
    const double x = v[std::size_t(i)] / kBrickEdge;
    if (!(x > low[i] - 1 && x < high[i] + 2)) return false;  // far off, or no number
  }
  const FixedPoint f = to_fixed(frame, p);
  const std::array<std::int64_t, 3> x = {f.x, f.y, f.z};
  for (int i = 0; i < 3; ++i) {
    if (x[std::size_t(i)] <= low[i] * kBrickEdge * kFixedOne + kFixedSlack) return false;
    if (x[std::size_t(i)] >= (high[i] + 1) * kBrickEdge * kFixedOne - kFixedSlack) return false;
  }
  return true;
}

/// False if a corner lies outside the bricks of the shelf.
bool sort_into_bricks(std::span<const TriangleD> triangles, const GridFrame& frame, std::span<const BrickCoord> coords,
                      Bins& bins) {
  BrickCoord low = coords[0], high = coords[0];
  for (const BrickCoord& c : coords) {
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], c[i]), high[i] = std::max(high[i], c[i]);
  }
  bins.first = low;
  for (int i = 0; i < 3; ++i) bins.count[i] = high[i] - low[i] + 1;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const Vec3d& p : triangles[t]) {
      if (!is_among(frame, p, low, high)) return false;
    }
    for_each_tile(to_fixed(frame, triangles[t]), first_voxel(low), kBrickEdge, bins.count,
                  [&](TileCoord tile) { bins.items.emplace_back(tile, std::uint32_t(t)); });
  }
  std::sort(bins.items.begin(), bins.items.end());
  return true;
}

}  // namespace

bool lies_within(std::span<const TriangleD> triangles, const GridFrame& frame, const BrickShelf& shelf) {
  const std::vector<BrickCoord> coords = shelf.coords();
  if (triangles.empty()) return true;
  Bins bins;
  if (coords.empty() || !sort_into_bricks(triangles, frame, coords, bins)) return false;
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < bins.items.size(); ++i) {
    if (i == 0 || bins.items[i].first != bins.items[i - 1].first) begins.push_back(i);
  }
  begins.push_back(bins.items.size());
  std::atomic<bool> within = true;
  parallel_for(std::int64_t(begins.size()) - 1, [&](std::int64_t k) {
    const std::size_t begin = begins[std::size_t(k)], end = begins[std::size_t(k) + 1];
    const TileCoord tile = bins.items[begin].first;
    const BrickCoord brick{bins.first.x + tile.x, bins.first.y + tile.y, bins.first.z + tile.z};
    const VoxelCoord low = first_voxel(brick);
    BitBox met({low, {low.x + kBrickEdge, low.y + kBrickEdge, low.z + kBrickEdge}});
    std::vector<FixedTriangle> fixed;
    for (std::size_t i = begin; i < end; ++i) fixed.push_back(to_fixed(frame, triangles[bins.items[i].second]));
    voxelize_surface(fixed, met);
    BrickBits bits{};
    (void)shelf.get(brick, bits);
    for (std::size_t i = 0; i < kBrickWords; ++i) {
      if ((met.data()[i] & ~bits[i]) != 0) within = false;
    }
  });
  return within;
}

}  // namespace bp
