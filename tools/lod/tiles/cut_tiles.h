#pragma once
#include <map>
#include <optional>

#include "lib/levels/tiles/tile_pyramid.h"
#include "lib/tileset/tile_tree.h"
#include "tools/lod/leaves.h"
#include "tools/lod/scene/lod_scene.h"

/// Makes the levels of a tileset that are cut into tiles, and its leaves (bplod --profile 3dtiles).
namespace bp {

/// The purpose of a run: the whole tileset, results of some jobs, or a list of the kept results.
enum class Task { tileset, some_jobs, look_up };

/// The tools that the jobs of a tileset share.
struct Shop {
  Build& build;
  Task task;
  ResultStore* results;  ///< may be null
  Scratch* files;        ///< where files wait until all are made
  bool tells_time;       ///< the time is told before the work; false: later, when it is known how many results are kept
  [[nodiscard]] const BuildOptions& options() const { return build.options; }
  [[nodiscard]] Cells cells() const { return {build.options.tile_vox}; }
  [[nodiscard]] bool wants(std::uint64_t number, std::uint64_t count) const {
    return task != Task::some_jobs || options().tiles->meets(number, count);
  }
};

struct MadeTileset {
  LodScene scene;
  std::unique_ptr<SceneLooks> held_looks;  ///< null: neither textures nor leaves need them
  TilesetPlan plan;
  std::vector<FoundJobs> found;
  // These members are set only for a whole tileset.
  std::vector<LevelRow> rows;
  std::optional<LevelRow> leaves;
  std::vector<WaitingFile> files;
  std::map<std::string, std::uint32_t> images;  ///< images that leaves use: numbers in the scene's TextureSet
  std::optional<TileTree> tree;
  std::vector<Provenance> provenance;  ///< empty: each tile has its own

  /// Returns the looks that textures are baked from; null: levels get no textures.
  [[nodiscard]] const SceneLooks* looks() const { return scene.textured ? held_looks.get() : nullptr; }
};

/// Returns the options of all cut levels. `tree`: over the scene's triangles that tiles enclose or follow; null: none.
[[nodiscard]] CutOptions cut_options(const Shop& shop, const MadeTileset& made, const TriangleBvh* tree = nullptr);
/// Makes the levels of more than one cell: their rows and files, and the tree with its leaves. Afterwards `pyramid` is
/// at the first level that is not cut.
void make_cut(const Shop& shop, TilePyramid& pyramid, const CutOptions& cut, MadeTileset& made);
/// Adds the scene's own triangles as leaves below the tiles of the finest level, which must be in the tree.
void add_leaves(const Shop& shop, const std::vector<CellCoord>& cells, const GridFrame& frame, MadeTileset& made);
/// Tells the time that is left when the kept results are known. `share`: the part of the work that is left.
void tell_time(const Shop& shop, const VoxelizedScene& scene, double share);

}  // namespace bp
