#pragma once
#include <functional>
#include <span>

#include "lib/pass/leaf/scene_leaf.h"

/// Tiles whose contents are the scene's own triangles at every distance. They form an octree: its leaves are pieces of
/// the scene (scene_leaf.h), and each tile above others has their triangles, reduced in number
/// (docs/decisions/0035-tiles-from-the-scene.md).
namespace bp {

/// The cube that is divided, and the lattice of all vertices. Float32 holds each vertex of each tile exactly, relative
/// to the middle of the tile's box: a vertex that tiles share is at the same place in all of them.
struct TileCube {
  Bounds3d box;
  double unit = 0;  ///< scene units; an 8,388,608th of the longest side, or less
};
[[nodiscard]] TileCube tile_cube(const Bounds3d& scene);

struct SceneTile {
  SceneLeaf leaf;
  /// A bound on how far the scene in the tile's box has moved: the distance from any point of the tile to the scene,
  /// and from any point of a part of the scene that is still there to the tile. Parts that vanished count with what is
  /// missing in a picture: half the side of the largest square that they half fill.
  double error_world = 0;
};

/// Memory of tile_above(), for each triangle of the tiles below.
constexpr std::uint64_t kTileBytesPerTriangle = 1000;

/// Returns the tile of a leaf of the octree: the scene in its box.
[[nodiscard]] SceneTile leaf_tile(const SceneLooks& looks, const Bounds3d& box, double unit);

/// Returns the tile above others: their triangles, reduced to `most`, unless the points on the faces of the box take
/// more. The distance by which this moves the surface is added to the largest error below, so errors never fall towards
/// the root. `key_of`: as SceneLooks::key_of(). One thread; the same bytes whatever the order of the work.
[[nodiscard]] SceneTile tile_above(std::span<const SceneTile> below, const Bounds3d& box, std::uint64_t most,
                                   const std::function<ResultKey(std::uint32_t material)>& key_of);

}  // namespace bp
