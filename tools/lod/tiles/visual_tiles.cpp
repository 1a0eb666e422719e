#include "tools/lod/tiles/visual_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "io/mesh/leaf_writer.h"
#include "io/store/scratch.h"
#include "io/tiles/tileset_file.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/pass/leaf/scene_tiles.h"
#include "lib/store/packing.h"
#include "lib/tileset/tile_tree.h"
#include "tools/lod/bake_levels.h"
#include "tools/lod/tiles/kept_tiles.h"
#include "tools/lod/tiles/tile_images.h"
#include "tools/lod/tiles/visual_octree.h"
#include "tools/run/provenance.h"

namespace bp {

namespace {

/// The parts of the memory for work that tiles have, and one image while it is made smaller. Looks have kLooksBeside.
constexpr double kTileShare = 0.45, kImageShare = 0.15;

std::span<const std::byte> bytes_of_text(const std::string& text) {
  return std::as_bytes(std::span(text));
}

/// Makes the tiles: those of the deepest octants first, then those above them. Tiles of one depth are jobs of their
/// own, which run at the same time as far as the memory goes. Tiles wait in `files` until they are written.
class VisualTiles {
 public:
  VisualTiles(Build& build, const LodScene& scene, const SceneLooks& looks, Scratch& files, ResultStore* results)
      : build_(build),
        scene_(scene),
        looks_(looks),
        files_(files),
        cube_(tile_cube(scene.size.bounds)),
        most_(most_tile_triangles(build.options)),
        memory_(build.context(nullptr, kTileShare).memory),
        images_(looks.images(), files, part_of(build.budget.work, kImageShare)),
        octree_(leaf_tree(looks, cube_.box, most_), most_) {
    OptionText text;
    text.add("mode", "visual").add("faces", most_);
    if (build.options.compression() == Compression::none) text.add("compression", "none");
    provenance_ = {make_provenance("bplod", text)};
    if (results == nullptr) return;
    kept_.emplace(*results, looks, cube_.box);
    for (std::size_t i = octree_.tiles().size(); i-- > 0;) octree_.at(i).key = key_of(octree_.at(i));
  }
  void make() {
    require_memory();
    check_outputs();
    for (std::size_t depth = octree_.depths(); depth-- > 0;) {
      const std::vector<std::size_t> jobs = octree_.numbers_at(depth);
      std::size_t next = 0;
      run_jobs<std::size_t>(
          at_once(jobs),
          [&](std::size_t& i) {
            if (next == jobs.size()) return false;
            i = jobs[next++];
            return true;
          },
          [&](const std::size_t& i) { make(octree_.at(i)); });
    }
    if (octree_.root().triangles == 0)
      fail(ErrorCode::bad_input, "no triangle of the scene has an area on a lattice of {:.3g}", cube_.unit);
  }
  std::vector<std::string> notes() const {
    std::vector<std::string> all;
    for (const std::string& fault : images_.faults()) all.push_back(fault + "; it is left out");
    for (std::string& note : octree_.notes(cube_.unit, scene_.size.bounds.longest_side()))
      all.push_back(std::move(note));
    return all;
  }
  Tileset tileset() const {
    Tileset tileset =
        tileset_of(tile_of(octree_.root(), {}), scene_.size.bounds.diagonal(), up(), build_.placed.placement);
    for (const std::string& name : images_.used()) tileset.images.push_back(folder() + "/" + name);
    return tileset;
  }
  void write_to(TilesetFolder& out) const {
    const std::vector<VisualTile>& tiles = octree_.tiles();
    parallel_for(std::int64_t(tiles.size()), [&](std::int64_t i) {  // each waits for the disk
      const VisualTile& tile = tiles[std::size_t(i)];
      if (tile.triangles == 0) return;
      std::vector<std::byte> bytes;
      files_.get(tile.content, bytes);
      out.write(name_of(tile), file_text(bytes));
    });
    for (const std::string& name : images_.used()) out.write(folder() + "/" + name, images_.bytes_of(name));
  }
  [[nodiscard]] std::vector<LevelRow> rows() const { return octree_.rows(folder()); }
  [[nodiscard]] const std::vector<Provenance>& provenance() const { return provenance_; }

 private:
  [[nodiscard]] std::string folder() const { return build_.options.name + "_tiles"; }
  [[nodiscard]] UpAxis up() const { return scene_.voxels.header.frame.up; }
  /// Returns the name of a tile's file: a digit for each octant from the root down to it.
  std::string name_of(const VisualTile& tile) const { return fmt::format("{}/0{}.glb", folder(), tile.box.path); }
  /// Returns the key of a tile's result; those of the tiles below it are set.
  ResultKey key_of(const VisualTile& tile) const {
    KeyHash hash("visual tile");
    hash.add(build_.options.name, tile.box.path, cube_.unit, build_.options.appearance, up(),
             provenance_.front().options, tile.below.size());
    if (tile.below.empty()) {
      add_leaf_to(hash, looks_, tile.box.box);
    } else {
      hash.add(tile.box.box);
    }
    for (const std::size_t i : tile.below) hash.add(octree_.tiles()[i].key);
    return hash.key();
  }
  /// Refuses before the work if a tile will not fit.
  void require_memory() const {
    const std::uint64_t most = octree_.expected_bytes();
    if (most > memory_.bytes) throw NeedsMemory("a tile of the scene", most, memory_.bytes, memory_.limit_for(most));
    images_.require_memory();
  }
  /// Returns how many of the tiles are made at the same time: the largest fit into the memory together. The tiles below
  /// are done.
  int at_once(const std::vector<std::size_t>& jobs) const {
    std::uint64_t most = 1;
    for (const std::size_t i : jobs) most = std::max(most, octree_.bytes_to_make(octree_.tiles()[i]));
    return int(std::clamp(memory_.bytes / most, std::uint64_t(1), std::uint64_t(thread_count())));
  }
  void make(VisualTile& tile) {
    SceneTile shape;
    std::string content;
    tile.kept = kept_ && kept_->get(tile.key, shape, content);
    if (!tile.kept) shape = made(tile);
    take_facts(tile, shape);
    const TileImages::Names images = images_.names_of(shape);
    if (!tile.kept) {
      if (tile.triangles > 0) content = content_of(tile, shape, images);
      if (kept_) kept_->put(tile.key, shape, content);
    }
    if (tile.triangles == 0) return;
    tile.bytes = content.size();
    tile.content = files_.put(bytes_of_text(content));
    std::string bytes;
    pack(bytes, shape);
    tile.tile = files_.put(bytes_of_text(bytes));
  }
  /// Takes what is known of the tile from its shape, and drops the shapes of the tiles below it.
  void take_facts(VisualTile& tile, const SceneTile& shape) {
    tile.bounds = shape.leaf.bounds;
    for (const std::size_t i : tile.below) {
      const VisualTile& below = octree_.at(i);
      if (below.triangles == 0) continue;
      tile.bounds.merge(below.bounds);
      files_.drop(below.tile);
    }
    tile.error_world = shape.error_world;
    tile.triangles = shape.leaf.triangles();
    if (!tile.below.empty()) return;
    for (const TriangleD& t : world_triangles(shape.leaf)) tile.area += area_of(t);
  }
  SceneTile made(const VisualTile& tile) const {
    if (tile.below.empty()) return leaf_tile(looks_, tile.box.box, cube_.unit);
    std::vector<SceneTile> below;
    for (const std::size_t i : tile.below) {
      if (octree_.tiles()[i].triangles > 0) below.push_back(taken(octree_.tiles()[i]));
    }
    if (below.empty()) return {};
    return tile_above(below, tile.box.box, most_, [&](std::uint32_t material) { return looks_.key_of(material); });
  }
  SceneTile taken(const VisualTile& below) const {
    std::vector<std::byte> bytes;
    files_.get(below.tile, bytes);
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    SceneTile shape;
    if (!unpack(text, shape)) fail(ErrorCode::failed, "a tile that waits in the scratch is damaged");
    return shape;
  }
  std::string content_of(const VisualTile& tile, const SceneTile& shape, const TileImages::Names& images) const {
    const auto name_of_image = [&](std::uint32_t image) {
      const auto found = images.find(image);
      return found == images.end() ? std::string() : found->second;
    };
    const LeafLooks looks{looks_.images(), name_of_image, build_.options.colors(), build_.options.compression()};
    return leaf_glb(build_.options.name + "_0" + tile.box.path, shape.leaf, looks, up(), provenance_, false);
  }
  Tile tile_of(const VisualTile& made, const Vec3d& parent) const {
    const Vec3d origin = middle_of(made.box.box);
    Tile tile = tile_at({name_of(made), origin, made.bounds, made.error_world}, parent, up());
    for (const std::size_t i : made.below) {
      const VisualTile& below = octree_.tiles()[i];
      if (below.triangles > 0) tile.children.push_back(tile_of(below, origin));
    }
    return tile;
  }

  Build& build_;
  const LodScene& scene_;
  const SceneLooks& looks_;
  Scratch& files_;
  const TileCube cube_;
  const std::uint64_t most_;
  const MemoryShare memory_;
  TileImages images_;
  VisualOctree octree_;
  std::vector<Provenance> provenance_;
  std::optional<KeptTiles> kept_;  // empty: nothing is kept
};

}  // namespace

std::uint64_t most_tile_triangles(const BuildOptions& options) {
  // A tile is drawn while its box fills no more than the screen: then a triangle has some ten pixels. With a quarter of
  // them, houses that are ten pixels wide became single triangles.
  constexpr std::uint64_t kVisualTileTriangles = 65536;
  return options.levels.faces.empty() ? kVisualTileTriangles : options.levels.faces.front();
}

std::vector<LevelRow> write_visual_tiles(Build& build, const LodScene& scene, const SceneLooks& looks,
                                         ResultStore* results, const std::string& cache_fault, TilesetFolder& folder) {
  build.report.begin("tiles");
  const std::unique_ptr<Scratch> files = make_scratch(build.budget.store, build.options.common.temp);
  VisualTiles tiles(build, scene, looks, *files, results);
  tiles.make();
  build.progress.end();
  if (!cache_fault.empty()) build.note(cache_fault + "; what is not in the cache was made, and is not kept");
  for (const std::string& text : tiles.notes()) build.note(text);
  build.report.begin("write");
  tiles.write_to(folder);
  folder.write("tileset.json", tileset_text(tiles.tileset(), tiles.provenance()));
  return tiles.rows();
}

}  // namespace bp
