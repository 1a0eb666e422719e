#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/check/check_tileset.h"
#include "lib/check/tile_cover.h"

namespace bp {

/// Counts of what was read from the contents of a tileset.
struct ContentCounts {
  std::uint64_t contents = 0, triangles = 0;
  std::uint64_t leaves = 0;  ///< contents that are leaves: pieces of the scene itself
  std::uint64_t holes = 0;   ///< contents, except leaves, whose images may cut holes
};

/// A tileset in the form of check_cover(), and the places of its contents. If a tile's cell lies deeper in the cell of
/// the tile above than an octant, the octants between become tiles of their own (CoverTile::is_joint).
class CoverTiles {
 public:
  /// Keeps references. `folder`: that of the tileset. Throws bad_input if a tile with a cell is turned or scaled.
  CoverTiles(const Tileset& tileset, std::string folder, const SceneOptions& options, TilePart part);

  [[nodiscard]] const std::vector<CoverTile>& tiles() const { return tiles_; }
  [[nodiscard]] std::uint64_t tiles_of_file() const { return tiles_.size() - joints_.size(); }
  [[nodiscard]] bool mine(std::size_t i) const { return mine_[i]; }
  [[nodiscard]] bool has_cells() const;
  /// Reads the content of a tile with a uri; call it for all, in their order. It notes and counts the triangles. A tile
  /// of another part is taken to be all right: that part reports it.
  [[nodiscard]] TileContent look_at(const Tile& tile, ContentCounts& counts);
  /// Returns content i in the coordinates of the scene.
  [[nodiscard]] IndexedMesh content(std::size_t i) const;

 private:
  /// The state that a tile hands down to the tiles below it.
  struct Above {
    std::size_t number = 0;
    Transform transform = kNoTransform;
    const Tile* proven = nullptr;  ///< the nearest tile with content: the tile itself or one above it
    bool adds = false;
  };
  void add(const Tile& tile, const std::string& place, const Above* above);
  void read(const std::string& path, CoverTile& noted, TileContent& known, ContentCounts& counts) const;
  std::size_t joined(std::size_t parent, const Bounds3d& cell);
  [[nodiscard]] Vec3d to_scene(const Transform& transform, const Vec3d& p) const;
  [[nodiscard]] Bounds3d moved(const Bounds3d& cell, const Transform& transform) const;

  const Tileset& tileset_;
  const std::string folder_;
  const SceneOptions& options_;
  std::vector<CoverTile> tiles_;
  std::vector<bool> mine_;  ///< tiles of this part
  std::vector<Transform> transforms_;
  std::size_t next_ = 0;                                       ///< the search for a uri begins at this tile
  std::map<std::pair<std::size_t, int>, std::size_t> joints_;  ///< by the tile above and its octant
};

}  // namespace bp
