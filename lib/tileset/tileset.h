#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/up_axis.h"
#include "lib/place/placement.h"

/// A 3D Tiles 1.1 tileset (OGC 22-025r4), as it is written, read and checked.
namespace bp {

using Transform = std::array<double, 16>;  ///< 4 x 4 by columns
constexpr Transform kNoTransform{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// Oriented box: centre and three half-axes, in the space of its tile (z up).
struct TileBox {
  Vec3d centre{};
  std::array<Vec3d, 3> axes{};
  [[nodiscard]] std::array<Vec3d, 8> corners() const;
};
/// Returns the box around `bounds`, with axes along x, y, z. It holds them exactly: half-lengths are rounded up.
[[nodiscard]] TileBox box_of(const Bounds3d& bounds);

struct TileSphere {
  Vec3d centre{};
  double radius = 0;
};

/// The volume in which something is drawn; viewers cull by it. If there are a box and a sphere, a viewer may take
/// either. If there is neither, the volume is of a kind that is not read, and Tileset::not_understood tells it.
struct TileVolume {
  std::optional<TileBox> box;
  std::optional<TileSphere> sphere;
};

struct Tile {
  TileVolume volume;
  std::shared_ptr<const TileVolume> content_volume;  ///< volume of its content alone; null: none is told
  Transform transform = kNoTransform;
  double geometric_error = 0;
  std::string refine;  ///< "ADD", "REPLACE"; empty: the parent's
  std::string uri;     ///< of the content, as a path beside the tileset; empty: no content
  /// The cell of the tile, in its own space: the tile answers for the scene in it (lib/check/tile_cover.h). Only our
  /// tilesets have it (extras.cell). Without a cell, the tile answers for the whole scene.
  std::optional<Bounds3d> cell;
  bool is_leaf = false;  ///< its content is a piece of the scene itself; only in our tilesets (extras.leaf)
  std::vector<Tile> children;
};

struct Tileset {
  std::string version = "1.1";
  UpAxis up = UpAxis::z;          ///< of the scene it was made from; only in our tilesets (asset.extras.up)
  UpAxis content_up = UpAxis::y;  ///< of the glTF in its contents: x, y or z (asset.gltfUpAxis)
  double geometric_error = 0;
  std::vector<std::string> images;          ///< files that contents share; only in our tilesets (asset.extras.images)
  std::vector<std::string> not_understood;  ///< statements that may move, hide or cull and are not read; one a line
  /// Where it stands; only in our tilesets (asset.extras.placement). The root's transform is without it: proofs and
  /// scenes are about the tileset's own coordinates. Files have the product of both.
  std::optional<Placement> placement;
  Tile root;
};

/// Calls f(tile, path, transform to the tileset's space), depth first, parents before children.
template <class F>
void for_each_tile(const Tileset& tileset, const F& f);

[[nodiscard]] Transform product(const Transform& a, const Transform& b);  ///< first b, then a
/// Returns the largest factor by which the transform stretches a length along one of its axes; 1 if it differs from 1
/// by rounding only.
[[nodiscard]] double largest_scale(const Transform& m);
/// Returns whether lengths keep their proportions, up to rounding; then spheres stay spheres.
[[nodiscard]] bool keeps_spheres(const Transform& m);
[[nodiscard]] Vec3d transformed(const Transform& m, const Vec3d& p);

namespace detail {
template <class F>
void visit_tiles(const Tile& tile, const std::string& path, const Transform& parent, const F& f) {
  const Transform transform = product(parent, tile.transform);
  f(tile, path, transform);
  for (std::size_t i = 0; i < tile.children.size(); ++i)
    visit_tiles(tile.children[i], path + ".children[" + std::to_string(i) + "]", transform, f);
}
}  // namespace detail

template <class F>
void for_each_tile(const Tileset& tileset, const F& f) {
  detail::visit_tiles(tileset.root, "root", kNoTransform, f);
}

}  // namespace bp
