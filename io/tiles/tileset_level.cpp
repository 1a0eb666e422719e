#include "io/tiles/tileset_level.h"

#include <sys/stat.h>

#include <iterator>
#include <set>

#include "io/files/file.h"

namespace bp {

namespace {

/// Without leaves, nor tiles that only lead to some.
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

/// Depths of the tree at which there are contents.
void add_depths(const Tile& tile, std::size_t depth, std::set<std::size_t>& depths) {
  if (!tile.uri.empty()) depths.insert(depth);
  for (const Tile& child : tile.children) add_depths(child, depth + 1, depths);
}

class LevelFinder {
 public:
  LevelFinder(std::string folder, std::size_t depth, TilesetLevel& out)
      : folder_(std::move(folder)), depth_(depth), out_(out) {}

  /// adds: as the tile above is refined.
  void find(const Tile& tile, std::size_t depth, const Transform& parent, bool adds) {
    const Transform transform = product(parent, tile.transform);
    if (!tile.refine.empty()) adds = tile.refine == "ADD";
    const bool ends = depth >= depth_ || tile.children.empty();
    if (!tile.uri.empty() && (ends || adds)) take(tile.uri, transform);
    if (ends && !tile.uri.empty()) return;
    for (const Tile& child : tile.children) find(child, depth + 1, transform, adds);
  }

 private:
  void take(const std::string& uri, const Transform& transform) {
    const std::string path = folder_ + "/" + uri;
    struct stat file {};
    if (::stat(path.c_str(), &file) == 0 && S_ISREG(file.st_mode)) {
      out_.contents.push_back({path, transform});
    } else {
      out_.missing.push_back(uri);
    }
  }

  std::string folder_;
  std::size_t depth_;
  TilesetLevel& out_;
};

/// Files in a row, each moved to its place.
class ContentsSource final : public TriangleSource {
 public:
  ContentsSource(UpAxis up, std::vector<PlacedContent> contents, std::string name, const SceneOptions& options)
      : up_(up), contents_(std::move(contents)), name_(std::move(name)), options_(options) {}

  bool read(std::vector<TriangleD>& out) override {
    out.clear();
    return read_next(out, [&](TriangleSource& content) { return content.read(out); });
  }
  bool read_colored(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors) override {
    out.clear();
    colors.clear();
    return read_next(out, [&](TriangleSource& content) { return content.read_colored(out, colors); });
  }
  bool read_textured(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors,
                     std::vector<TriangleTexture>& textures) override {
    out.clear();
    colors.clear();
    textures.clear();
    return read_next(out, [&](TriangleSource& content) { return content.read_textured(out, colors, textures); });
  }
  [[nodiscard]] bool has_colors() const override { return has_colors_; }
  [[nodiscard]] bool has_textures() const override { return has_textures_; }
  void rewind() override {
    content_.reset();
    next_ = 0;
    counts_ = finished_ = {};
  }
  [[nodiscard]] const SceneCounts& counts() const override { return counts_; }
  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::optional<UpAxis> up() const override { return up_; }

 private:
  template <class Read>
  bool read_next(std::vector<TriangleD>& out, const Read& read) {
    for (; next_ < contents_.size(); ++next_) {
      if (!content_) content_ = open_scene(contents_[next_].path, options_);
      const bool more = read(*content_);
      has_colors_ = has_colors_ || content_->has_colors();
      has_textures_ = has_textures_ || content_->has_textures();
      counts_ = finished_;
      counts_.add(content_->counts());
      if (more) {
        place(out);
        return true;
      }
      finished_ = counts_;
      content_.reset();
    }
    return false;
  }

  /// glTF has y up, and 3D Tiles turns it to z up; a file of ours is delivered in the axes of its scene.
  void place(std::vector<TriangleD>& triangles) const {
    const UpAxis axes = content_->up().value_or(UpAxis::y);
    for (TriangleD& t : triangles) {
      for (Vec3d& p : t)
        p = turned(transformed(contents_[next_].transform, turned(p, axes, UpAxis::z)), UpAxis::z, up_);
    }
  }

  UpAxis up_;
  std::vector<PlacedContent> contents_;
  std::string name_;
  SceneOptions options_;
  std::unique_ptr<TriangleSource> content_;
  std::size_t next_ = 0;
  bool has_colors_ = false, has_textures_ = false;
  SceneCounts finished_, counts_;
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
  return std::make_unique<ContentsSource>(tileset.up, std::move(contents), path, options);
}

}  // namespace bp
