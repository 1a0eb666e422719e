#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/up_axis.h"

/// A 3D Tiles 1.1 tileset (OGC 22-025r4) and what must hold of it beyond its schema.
namespace bp {

using Transform = std::array<double, 16>;  ///< 4 x 4 by columns
constexpr Transform kNoTransform{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// Oriented box: centre and three half-axes, in the space of its tile (z up).
struct TileBox {
  Vec3d centre{};
  std::array<Vec3d, 3> axes{};
  [[nodiscard]] std::array<Vec3d, 8> corners() const;
};
/// The box around `bounds`, axes along x, y, z.
[[nodiscard]] TileBox box_of(const Bounds3d& bounds);

struct Tile {
  std::optional<TileBox> box;  ///< none: a sphere or a region, whose contents are not looked at
  Transform transform = kNoTransform;
  double geometric_error = 0;
  std::string refine;  ///< "ADD", "REPLACE"; empty: the parent's
  std::string uri;     ///< of the content, percent-decoded: a file name; empty: none
  /// Cell of the tile, in its own space: it answers for the scene in it (tile_cover.h). Ours only (extras.cell); none:
  /// for all of the scene.
  std::optional<Bounds3d> cell;
  std::vector<Tile> children;
};

struct Tileset {
  std::string version = "1.1";
  UpAxis up = UpAxis::z;  ///< of the scene it was made from; ours only (asset.extras.up)
  double geometric_error = 0;
  Tile root;
};

/// What is known of the content of a tile.
struct TileContent {
  bool found = false;           ///< there, and readable
  std::string complaint;        ///< why not
  std::vector<Vec3d> vertices;  ///< in the space of its tile: glTF turned to z up
};
/// Reads the content of a tile that has a uri; each is asked for once, depth first, and gone before the next.
using TileContents = std::function<TileContent(const Tile&)>;

/// One finding per line, with the path of the tile ("root.children[0]"); empty if all holds:
///   - the version is 1.1; the root says how it refines; errors are finite and not negative;
///   - the tileset's error is at least the root's; no child's error is above its parent's;
///   - the corners of a child's box lie in its parent's box, and the content's vertices in its tile's box, each with
///   its
///     transforms, but for 1e-9 of the box's size: transforms of doubles round;
///   - every content is there.
[[nodiscard]] std::vector<std::string> check_tileset(const Tileset& tileset, const TileContents& content_of);

/// Calls f(tile, path, transform to the tileset's space), depth first, parents before children.
template <class F>
void for_each_tile(const Tileset& tileset, const F& f);

[[nodiscard]] Transform product(const Transform& a, const Transform& b);  ///< first b, then a
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
