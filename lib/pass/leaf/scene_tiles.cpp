#include "lib/pass/leaf/scene_tiles.h"

#include <algorithm>
#include <cmath>

#include "lib/geometry/surface_distance.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/pass/leaf/detail/missing_length.h"
#include "lib/pass/leaf/fewer_triangles.h"
#include "lib/pass/leaf/joined_leaves.h"
#include "lib/tileset/tile_tree.h"

namespace bp {

namespace {

/// Half of the cube has at most 2^24 units, which float32 holds. Its edge is a multiple of 2^13 units, so that
/// twelve halvings leave boxes whose middles are whole units.
constexpr int kCubeBits = 24, kStepBits = 13;
/// The cube begins so many units before a multiple of 2^13, so that the faces of all boxes lie at odd multiples of the
/// unit. Scenes like round numbers: a ground at 0 would lie in a face, where points stay.
constexpr double kOffRound = 3127;
/// Distances are measured to this share of a box's diagonal. A tile is looked at when its box is about as large as the
/// screen, so that this is about a pixel.
constexpr double kToleranceShare = 1.0 / 1024;

/// Returns how far the surface moved: a bound on the distance from any point of what is left to what was there, and the
/// other way round, and what parts that vanished leave missing in a picture.
double moved(const FewerTriangles& fewer, double tolerance) {
  const std::vector<TriangleD> now = world_triangles(fewer.leaf);
  const TriangleBvh left(now);
  return std::max({largest_distance(now, TriangleBvh(fewer.before), tolerance).at_most,
                   largest_distance(fewer.before, left, tolerance).at_most, missing_length(fewer.gone, left)});
}

}  // namespace

TileCube tile_cube(const Bounds3d& scene) {
  int exponent = 0;
  (void)std::frexp(scene.longest_side(), &exponent);
  TileCube cube;
  cube.unit = std::ldexp(1.0, exponent - kCubeBits);
  const double step = std::ldexp(cube.unit, kStepBits);
  double edge = step;
  for (std::size_t i = 0; i < 3; ++i) {
    cube.box.min[i] = std::floor(scene.min[i] / step) * step - kOffRound * cube.unit;
    edge = std::max(edge, (std::floor((scene.max[i] - cube.box.min[i]) / step) + 1) * step);
  }
  for (std::size_t i = 0; i < 3; ++i) cube.box.max[i] = cube.box.min[i] + edge;
  return cube;
}

SceneTile leaf_tile(const SceneLooks& looks, const Bounds3d& box, double unit) {
  return {cut_leaf(looks, box, unit), leaf_error(unit)};
}

SceneTile tile_above(std::span<const SceneTile> below, const Bounds3d& box, std::uint64_t most,
                     const std::function<ResultKey(std::uint32_t material)>& key_of) {
  SceneTile tile;
  std::vector<SceneLeaf> leaves;
  for (const SceneTile& t : below) {
    leaves.push_back(t.leaf);
    tile.error_world = std::max(tile.error_world, t.error_world);
  }
  const SceneLeaf all = joined(leaves, middle_of(box), key_of);
  if (all.triangles() <= most) {
    tile.leaf = all;
    return tile;
  }
  FewerTriangles fewer = tile_with_fewer_triangles(all, box, most);
  tile.error_world += moved(fewer, kToleranceShare * box.diagonal());
  tile.leaf = std::move(fewer.leaf);
  return tile;
}

}  // namespace bp
