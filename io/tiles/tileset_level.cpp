#include "io/tiles/tileset_level.h"

#include <iterator>
#include <set>

#include "io/files/file.h"
#include "io/tiles/tileset_contents.h"
#include "io/tiles/tileset_rules.h"

namespace bp {

namespace {

/// Returns the tile without leaves, and without tiles that lead only to leaves.
Tile without_leaves(const Tile& tile) {
  Tile out = tile;
  out.children.clear();
  for (const Tile& child : tile.children) {
    if (child.is_leaf) continue;
    Tile kept = without_leaves(child);
    const bool led_to_leaves = kept.uri.empty() && kept.children.empty() && !child.children.empty();
    if (!led_to_leaves) out.children.push_back(std::move(kept));
  }
  return out;
}

/// Adds the depths of the tree at which there are contents.
void add_depths(const Tile& tile, std::size_t depth, std::set<std::size_t>& depths) {
  if (!tile.uri.empty()) depths.insert(depth);
  for (const Tile& child : tile.children) add_depths(child, depth + 1, depths);
}

class LevelFinder {
 public:
  LevelFinder(std::string folder, std::size_t depth, TilesetLevel& out)
      : folder_(std::move(folder)), depth_(depth), out_(out) {}

  /// adds: the tile above is refined by adding.
  void find(const Tile& tile, std::size_t depth, const Transform& parent, bool adds) {
    const Transform transform = product(parent, tile.transform);
    if (!tile.refine.empty()) adds = bp::adds(tile.refine);
    const bool ends = depth >= depth_ || tile.children.empty();
    if (!tile.uri.empty() && (ends || adds)) take(tile.uri, transform);
    if (ends && !tile.uri.empty()) return;
    for (const Tile& child : tile.children) find(child, depth + 1, transform, adds);
  }

 private:
  void take(const std::string& uri, const Transform& transform) {
    const std::string path = content_path(folder_, uri);
    if (is_regular_file(path)) {
      out_.contents.push_back({path, transform});
    } else {
      out_.missing.push_back(uri);
    }
  }

  std::string folder_;
  std::size_t depth_;
  TilesetLevel& out_;
};

}  // namespace

TilesetLevel tileset_level(const Tileset& tileset, const std::string& path, std::size_t level) {
  const Tile root = without_leaves(tileset.root);
  std::set<std::size_t> depths;
  add_depths(root, 0, depths);
  TilesetLevel out;
  out.levels = depths.size();
  if (level < out.levels) {
    const std::size_t depth = *std::next(depths.rbegin(), std::ptrdiff_t(level));
    LevelFinder(folder_of(path), depth, out).find(root, 0, kNoTransform, false);
  }
  return out;
}

std::unique_ptr<TriangleSource> open_contents(const Tileset& tileset, std::vector<PlacedContent> contents,
                                              const std::string& path, const SceneOptions& options) {
  TilesetContents all{tileset.up, {}};
  for (PlacedContent& content : contents)
    all.files.push_back({std::move(content.path), {scene_place(content.transform, tileset.up), tileset.content_up}});
  return filtered(path, open_contents(std::move(all), options), options);
}

}  // namespace bp
