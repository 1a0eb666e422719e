#include "io/tiles/tileset_contents.h"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>

#include "io/files/file.h"
#include "io/files/kept_files.h"
#include "io/files/lower.h"
#include "io/gltf/gltf_nodes.h"
#include "io/tiles/tileset_rules.h"
#include "lib/core/error.h"

namespace bp {

namespace {

// What real tilesets stay far below; beyond it a file asks for more than it can hold.
constexpr std::size_t kMostNested = 16;  // tilesets below tilesets
constexpr std::size_t kMostTilesets = 1 << 16;

bool is_file(const std::string& path) {
  struct stat file {};
  return ::stat(path.c_str(), &file) == 0 && S_ISREG(file.st_mode);
}

/// A tileset that is looked at.
struct Around {
  std::string folder;
  UpAxis up;        ///< of its contents
  bool has_leaves;  ///< ours: they are the scene (extras.leaf), and what stands beside them is not
};

/// Looks at all tiles, so that those who come after need not.
bool has_leaves(const GltfObject& tile, int depth) {
  check_tile(tile, depth);
  bool has = is_leaf(tile);
  for (std::size_t i = 0; i < tile.array("children").size(); ++i)
    has = has_leaves(tile.item("children", i), depth + 1) || has;
  return has;
}

/// Of older tilesets; glTF has y up.
UpAxis content_up(const GltfObject& root) {
  if (!root.has("asset") || !root.object("asset").has("gltfUpAxis")) return UpAxis::y;
  const std::string named = lower(root.object("asset").text("gltfUpAxis"));
  return up_axis_named(named).value_or(UpAxis::y);
}

/// Depth first, as they are drawn.
class ContentFinder {
 public:
  explicit ContentFinder(const SceneOptions& options) : options_(options) {}

  TilesetContents run(const CountedJson& tileset, const std::string& path) {
    held_ = tileset.bytes;
    const GltfObject root(tileset.json, path, "");
    out_.up = gltf_up(root).value_or(UpAxis::z);
    add_tileset(root, path, affine_of(to_y_up(out_.up).inverse()) * affine_of(to_y_up(UpAxis::z)));
    if (missing_ > 0)
      fail(ErrorCode::bad_input,
           "{}: {} of {} contents are missing, and the scene is not whole without them; the first is {}", path,
           missing_, missing_ + out_.files.size(), first_missing_);
    return std::move(out_);
  }

 private:
  void add_tileset(const GltfObject& root, const std::string& path, const Affine& place) {
    const std::string real = std::filesystem::weakly_canonical(path).string();
    if (std::find(open_.begin(), open_.end(), real) != open_.end())
      fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: is a content of itself, so it has no end", path);
    if (open_.size() == kMostNested || ++tilesets_ > kMostTilesets)
      fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: tilesets within tilesets are read {} deep, and {} of them",
           path, kMostNested, kMostTilesets);
    check_required_extensions(root);
    open_.push_back(real);
    const GltfObject tile = root.object("root");
    add_tile(tile, {folder_of(path), content_up(root), has_leaves(tile, 0)}, place, false);
    open_.pop_back();
  }

  /// adds: tiles are drawn beside those below them, as the tile above says.
  void add_tile(const GltfObject& tile, const Around& around, const Affine& parent, bool adds) {
    const Affine place = parent * gltf_matrix(tile, "transform");
    if (tile.has("refine")) adds = bp::adds(tile.text("refine"));
    const std::size_t below = tile.array("children").size();
    const bool drawn = around.has_leaves ? is_leaf(tile) : adds || below == 0;
    if (tile.has("content")) add_content(tile.object("content"), around, place, drawn);
    for (std::size_t i = 0; i < tile.array("contents").size(); ++i)
      add_content(tile.item("contents", i), around, place, drawn);
    for (std::size_t i = 0; i < below; ++i) add_tile(tile.item("children", i), around, place, adds);
  }

  void add_content(const GltfObject& content, const Around& around, const Affine& place, bool drawn) {
    std::string path = content_uri(content);
    if (path.find("://") != std::string::npos) content.unfit("lies on the network; download it");
    if (path.starts_with("data:")) content.unfit("is embedded, which is not read");
    if (!path.starts_with('/')) path.insert(0, around.folder + "/");
    if (!is_file(path)) path.resize(std::min(path.size(), path.find('?')));
    const bool is_tileset = names_tileset(path);  // stands for the tiles below
    if (!drawn && !is_tileset) return;
    if (!is_file(path)) {
      if (missing_++ == 0) first_missing_ = path;
    } else if (is_tileset) {
      const CountedJson tileset = read_json(open_scene_file(path, temp_dir_of(options_), NamedBy::file), options_, held_);
      held_ += tileset.bytes;
      add_tileset(GltfObject(tileset.json, path, ""), path, place);
      held_ -= tileset.bytes;
    } else {
      add_file({std::move(path), {place, around.up}});
    }
  }

  void add_file(ContentFile file) {
    held_ += sizeof(ContentFile) + file.path.size();
    check_document(options_, open_.front(), "its JSON and the list of its contents", held_, options_.document.bytes);
    keep_file(file.path);
    out_.files.push_back(std::move(file));
  }

  const SceneOptions& options_;
  TilesetContents out_;
  std::vector<std::string> open_;  // tilesets around the place
  std::size_t tilesets_ = 0, missing_ = 0;
  std::uint64_t held_ = 0;  // of the tilesets around the place, and of the list
  std::string first_missing_;
};

}  // namespace

TilesetContents contents_of(const CountedJson& json, const std::string& path, const SceneOptions& options) {
  return ContentFinder(options).run(json, path);
}

}  // namespace bp
