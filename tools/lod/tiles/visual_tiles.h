#pragma once
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "io/tiles/tileset_folder.h"
#include "lib/pass/leaf/scene_tiles.h"
#include "lib/tileset/tileset.h"
#include "tools/lod/scene/lod_scene.h"
#include "tools/lod/tiles/image_files.h"

namespace bp {

/// Triangles of a tile without --faces. A tile is drawn while its box fills no more than the screen: then a triangle
/// has some ten pixels. With a quarter of them, houses that are ten pixels wide became single triangles.
constexpr std::uint64_t kVisualTileTriangles = 65536;
/// Returns the most triangles of a tile.
[[nodiscard]] std::uint64_t most_tile_triangles(const BuildOptions& options);

/// Makes the tiles of bplod --profile 3dtiles --mode visual: those of the deepest octants first, then those above them.
/// Tiles of one depth are jobs of their own, which run at the same time as far as the memory goes. Tiles wait in
/// `files` until they are written.
class VisualTiles {
 public:
  /// Divides the scene. Keeps references. `results`: null: nothing is kept.
  VisualTiles(Build& build, const LodScene& scene, const SceneLooks& looks, Scratch& files, ResultStore* results);

  /// Makes all tiles. Throws NeedsMemory before the work if one of them, or an image, does not fit; bad_input if no
  /// triangle has an area.
  void make();
  /// Returns the tree of the tiles, once they are made.
  [[nodiscard]] Tileset tileset() const;
  /// Writes the tiles and their images.
  void write_to(TilesetFolder& out) const;
  /// Returns a row for each depth of the octree, the deepest first.
  [[nodiscard]] std::vector<LevelRow> rows() const;
  [[nodiscard]] const std::vector<Provenance>& provenance() const { return provenance_; }
  /// Returns what users should know about the tiles.
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  /// A tile of the octree.
  struct Job {
    LeafBox box;
    std::size_t depth = 0;
    std::vector<std::size_t> below{};  ///< numbers of the jobs of its octants
    ResultKey key{};                   ///< of its result; set if results are kept
    // make() sets the members below. After that, a job with 0 triangles has no tile.
    Scratch::Handle tile = 0;     ///< the SceneTile, until the tile above is made
    Scratch::Handle content = 0;  ///< the file
    std::uint64_t triangles = 0, bytes = 0;
    double error_world = 0, area = 0;  ///< area: of leaves only
    Bounds3d bounds{};                 ///< of the tile and those below it
    bool kept = false;
  };
  using ImageNames = std::map<std::uint32_t, std::string>;

  std::size_t add(const LeafTree& tree, std::size_t depth);
  void add_key(Job& job) const;
  void number_materials();
  [[nodiscard]] std::size_t depths() const;
  [[nodiscard]] std::string folder() const { return build_.options.name + "_tiles"; }
  [[nodiscard]] std::string name_of(const Job& job) const;
  [[nodiscard]] std::uint64_t planned(const Job& job) const;
  template <class Triangles>
  [[nodiscard]] std::uint64_t bytes_of(const Job& job, const Triangles& of) const;
  void require_memory() const;
  [[nodiscard]] int at_once(const std::vector<std::size_t>& jobs) const;
  void make(Job& job);
  [[nodiscard]] SceneTile made(const Job& job) const;
  [[nodiscard]] bool get_kept(const Job& job, SceneTile& tile, std::string& content) const;
  void keep(const Job& job, SceneTile tile, const std::string& content) const;
  [[nodiscard]] SceneTile taken(const Job& job) const;
  [[nodiscard]] ImageNames images_of(const SceneTile& tile);
  [[nodiscard]] std::string content_of(const Job& job, const SceneTile& tile, const ImageNames& images) const;
  [[nodiscard]] Tile tile_of(const Job& job, const Vec3d& parent) const;

  Build& build_;
  const LodScene& scene_;
  const SceneLooks& looks_;
  Scratch& files_;
  ResultStore* const results_;
  const TileCube cube_;
  const std::uint64_t most_;
  const MemoryShare memory_;
  ImageFiles images_;
  std::vector<Provenance> provenance_;
  std::vector<Job> jobs_;                         // those above come first
  std::map<ResultKey, std::uint32_t> materials_;  // their numbers; set if results are kept
  std::mutex mutex_;
  std::set<std::string> used_images_;
};

}  // namespace bp
