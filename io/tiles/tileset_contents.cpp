#include "io/tiles/tileset_contents.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "io/files/file.h"
#include "io/files/kept_files.h"
#include "io/files/lower.h"
#include "io/gltf/gltf_nodes.h"
#include "io/tiles/tileset_rules.h"
#include "lib/core/error.h"

namespace bp {

namespace {

// Limits that real tilesets stay far below; a file beyond them claims more than it can hold.
constexpr std::size_t kMostNested = 16;  // tilesets below tilesets
constexpr double kMostTilesets = 1 << 16;
constexpr double kMostContents = 1 << 24;

/// Checks all tiles, so that later functions need not. Returns whether there are leaves of this suite: they are the
/// scene (extras.leaf), and tiles without leaves are not.
bool has_leaves(const GltfObject& tile, int depth) {
  check_tile(tile, depth);
  bool has = is_leaf(tile);
  for (std::size_t i = 0; i < tile.array("children").size(); ++i)
    has = has_leaves(tile.item("children", i), depth + 1) || has;
  return has;
}

bool refines_by_adding(const GltfObject& tile) {
  const std::string refine = tile.text("refine");
  if (!adds(refine) && lower(refine) != "replace")
    tile.unfit("has a 'refine' that is neither ADD nor REPLACE, and viewers take it as either");
  return adds(refine);
}

struct FoundContent {
  std::string path;
  bool is_tileset = false;  ///< the content is a tileset with further tiles
  bool adds = false;        ///< the tile is refined by adding
  Affine place;
};

/// Calls f(FoundContent) for each content that shows one tileset at its finest. Depth first, in drawing order.
template <class F>
class TileWalk {
 public:
  TileWalk(const GltfObject& root, const std::string& path, const F& f)
      : folder_(folder_of(path)), has_leaves_(has_leaves(root.object("root"), 0) && has_record(root)), f_(f) {}

  /// adds: the tile above is refined by adding, so this tile is drawn in addition to those below it.
  void walk(const GltfObject& tile, const Affine& place, bool adds = false) const {
    if (tile.has("refine")) adds = refines_by_adding(tile);
    const std::size_t below = tile.array("children").size();
    const bool has_content = tile.has("content") || !tile.array("contents").empty();
    const bool ends = tile.has("geometricError") && tile.real("geometricError") == 0;
    if (below > 0 && !adds && has_content && !has_leaves_ && ends)
      tile.unfit("has the geometricError 0 and tiles below, which viewers need not draw");
    const bool drawn = has_leaves_ ? is_leaf(tile) : adds || below == 0;
    if (tile.has("content")) find(tile.object("content"), place, drawn, adds);
    for (std::size_t i = 0; i < tile.array("contents").size(); ++i) find(tile.item("contents", i), place, drawn, adds);
    for (std::size_t i = 0; i < below; ++i) {
      const GltfObject child = tile.item("children", i);
      walk(child, place * affine_of_transform(tile_transform(child)), adds);
    }
  }

 private:
  void find(const GltfObject& content, const Affine& place, bool drawn, bool adds) const {
    const std::string uri = content_uri(content);
    FoundContent found{content_path(folder_, uri), names_tileset(uri), adds, place};
    if (drawn || found.is_tileset) f_(std::move(found));
  }

  const std::string folder_;
  const bool has_leaves_;
  const F& f_;
};

/// `place`: that of the root tile.
template <class F>
void for_each_content(const GltfObject& tileset, const std::string& path, const Affine& place, const F& f) {
  TileWalk<F>(tileset, path, f).walk(tileset.object("root"), place);
}

std::string real_path(const std::string& path) {
  return std::filesystem::weakly_canonical(path).string();
}

/// Counts the contents of a tileset and of those within it before any is opened: a few tilesets that name each other
/// repeatedly can mean more contents than there are numbers. Each file is read once.
class ContentCounter {
 public:
  struct Count {
    double tilesets = 1, contents = 0, bytes = 0;  ///< bytes: of the list of contents
    std::size_t deep = 1;
  };

  explicit ContentCounter(const SceneOptions& options) : options_(options) {}

  /// Counts all. Throws out_of_resource if a tileset within does not fit. The limit in the error has room for each that
  /// was met.
  Count count_all(const GltfObject& tileset, const std::string& path, std::uint64_t bytes) {
    const Count all = count(tileset, path, bytes);
    if (refused_) throw Error(refused_->code(), refused_->what(), refused_->remedies(), least_limit_);
    return all;
  }

  [[noreturn]] static void too_deep(const std::string& path) {
    fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: tilesets within tilesets are read {} deep", path,
         kMostNested);
  }

 private:
  Count count(const GltfObject& tileset, const std::string& path, std::uint64_t bytes) {
    const std::string real = real_path(path);
    if (std::find(open_.begin(), open_.end(), real) != open_.end())
      fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: is a content of itself, so it has no end", path);
    if (const auto known = known_.find(real); known != known_.end()) return known->second;
    if (open_.size() == kMostNested) too_deep(path);
    check_required_extensions(tileset);
    open_.push_back(real);
    held_ += bytes + real.size() + sizeof(Count);
    Count all;
    for_each_content(tileset, path, Affine{}, [&](const FoundContent& found) { add(found, all); });
    held_ -= bytes;
    open_.pop_back();
    return known_[real] = all;
  }

  void add(const FoundContent& found, Count& all) {
    if (!found.is_tileset) {
      all.contents += 1;
      all.bytes += double(sizeof(ContentFile) + found.path.size());
    } else if (is_regular_file(found.path)) {
      const Count within = counted(found.path);
      all.tilesets += within.tilesets;
      all.contents += within.contents;
      all.bytes += within.bytes;
      all.deep = std::max(all.deep, 1 + within.deep);
    }
  }
  Count counted(const std::string& path) {
    const auto known = known_.find(real_path(path));
    if (known != known_.end()) return known->second;
    try {
      const CountedJson json = read_json(open_scene_file(path, temp_dir_of(options_), NamedBy::file), options_, held_);
      return count(GltfObject(json.json, path, ""), path, json.bytes);
    } catch (const NeedsMemory& e) {
      if (!refused_) refused_ = e;
      least_limit_ = std::max(least_limit_, e.memory_bytes());
      return known_[real_path(path)] = {};
    }
  }

  const SceneOptions& options_;
  std::map<std::string, Count> known_;
  std::vector<std::string> open_;  // tilesets around the current place
  std::uint64_t held_ = 0;
  std::optional<NeedsMemory> refused_;  // the first refusal
  std::uint64_t least_limit_ = 0;
};

std::string number_text(double n) {
  return n < 1e18 ? fmt::format("{:.0f}", n) : fmt::format("{:.3g}", n);
}

/// Finds the contents, depth first, in drawing order.
class ContentFinder {
 public:
  explicit ContentFinder(const SceneOptions& options) : options_(options) {}

  TilesetContents run(const CountedJson& tileset, const std::string& path) {
    const GltfObject root(tileset.json, path, "");
    check_counts(ContentCounter(options_).count_all(root, path, tileset.bytes), path, tileset.bytes);
    held_ = tileset.bytes;
    out_.up = gltf_up(root).value_or(UpAxis::z);
    content_up_ = bp::content_up(root);
    add_tileset(root, path, scene_place(root_transform(root), out_.up));
    if (missing_ > 0)
      fail(ErrorCode::bad_input,
           "{}: {} of {} contents are missing, and the scene is not whole without them; the first is {}", path,
           missing_, missing_ + out_.files.size(), first_missing_);
    return std::move(out_);
  }

 private:
  void check_counts(const ContentCounter::Count& count, const std::string& path, std::uint64_t held) const {
    if (count.tilesets > kMostTilesets || count.contents > kMostContents)
      fail(ErrorCode::bad_input, {Remedy::repair_file},
           "{}: stands for {} contents in {} tilesets within each other, and at most {:.0f} in {:.0f} are read", path,
           number_text(count.contents), number_text(count.tilesets), kMostContents, kMostTilesets);
    if (count.deep > kMostNested) ContentCounter::too_deep(path);
    const std::uint64_t all = options_.document.bytes;
    check_document(options_, path, "the list of its contents", std::uint64_t(count.bytes), all - std::min(all, held));
  }

  void add_tileset(const GltfObject& root, const std::string& path, const Affine& place) {
    for_each_content(root, path, place, [&](FoundContent found) { add_content(std::move(found)); });
  }

  void add_content(FoundContent found) {
    if (!is_regular_file(found.path)) {
      if (missing_++ == 0) first_missing_ = found.path;
    } else if (found.is_tileset) {
      const CountedJson tileset =
          read_json(open_scene_file(found.path, temp_dir_of(options_), NamedBy::file), options_, held_);
      held_ += tileset.bytes;
      const GltfObject root(tileset.json, found.path, "");
      if (found.adds && !root.object("root").has("refine"))
        root.object("root").unfit("has no 'refine', and viewers may take that of the tileset around it");
      add_tileset(root, found.path, found.place * affine_of_transform(tile_transform(root.object("root"))));
      held_ -= tileset.bytes;
    } else {
      keep_file(found.path);
      out_.files.push_back({std::move(found.path), {found.place, content_up_}});
    }
  }

  const SceneOptions& options_;
  TilesetContents out_;
  UpAxis content_up_ = UpAxis::y;
  std::size_t missing_ = 0;
  std::uint64_t held_ = 0;  // memory of the tilesets around the current place
  std::string first_missing_;
};

}  // namespace

TilesetContents contents_of(const CountedJson& json, const std::string& path, const SceneOptions& options) {
  return ContentFinder(options).run(json, path);
}

}  // namespace bp
