#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/check/check_tileset.h"
#include "lib/check/tile_cover.h"

namespace bp {

/// What was read of the contents of a tileset.
struct ContentCounts {
  std::uint64_t contents = 0, triangles = 0;
  std::uint64_t leaves = 0;  ///< of the contents: pieces of the scene itself
  std::uint64_t holes = 0;   ///< contents whose images may cut holes; not of leaves
};

/// A tileset as check_cover() wants it, and where its contents lie. Where a tile's cell lies deeper in that of the tile
/// above than an octant, the octants between them are tiles of their own (CoverTile::is_joint).
class CoverTiles {
 public:
  /// Keeps references. `folder`: of the tileset. Throws bad_input if a tile with a cell is turned or scaled.
  CoverTiles(const Tileset& tileset, std::string folder, const SceneOptions& options, TilePart part);

  [[nodiscard]] const std::vector<CoverTile>& tiles() const { return tiles_; }
  [[nodiscard]] std::uint64_t tiles_of_file() const { return tiles_.size() - joints_.size(); }
  [[nodiscard]] bool mine(std::size_t i) const { return mine_[i]; }
  [[nodiscard]] bool has_cells() const;
  /// For each tile with a uri, in their order: what is known of it. The number of triangles is noted, and counted. Of
  /// another part's tile, it is taken to be there: that part tells.
  [[nodiscard]] TileContent look_at(const Tile& tile, ContentCounts& counts);
  /// In the coordinates of the scene.
  [[nodiscard]] IndexedMesh content(std::size_t i) const;

 private:
  /// Above the tiles that are added.
  struct Above {
    std::size_t number = 0;
    Transform transform = kNoTransform;
    const Tile* proven = nullptr;  ///< with content: the tile itself, or the nearest above
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
  std::size_t next_ = 0;                                       ///< tile to look for a uri at
  std::map<std::pair<std::size_t, int>, std::size_t> joints_;  ///< by the tile above and the octant of it
};

}  // namespace bp
