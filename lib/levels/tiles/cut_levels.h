#pragma once
#include <string>

#include "lib/levels/tiles/tile_plan.h"
#include "lib/levels/tiles/tile_pyramid.h"
#include "lib/pass/color/scene_colors.h"
#include "lib/tileset/tile_tree.h"

/// Makes the levels of a tileset that are cut into tiles; each tile is a job of its own.
namespace bp {

/// The options that all tiles share.
struct CutOptions {
  Cells cells;
  MeshMode mode = MeshMode::bounding;
  Enclose enclose = Enclose::input;
  SceneColors* colors = nullptr;       ///< null: none
  const TriangleBvh* scene = nullptr;  ///< the triangles that fits follow; null: they follow the closing
  Rounding rounding;                   ///< of the scene's triangles
  std::optional<JobRange> jobs;        ///< empty: all
  bool make = true;                    ///< TileParams::make
};

/// How the tiles of a level become files.
struct CutFiles {
  std::string encoding;  ///< TileParams::encoding
  /// Makes the file's bytes from a mesh that has its colours. `origin`: a lattice point near the middle of the cell.
  std::function<std::string(CellCoord, LatticeMesh&&, LatticeCoord origin)> encode;
  std::function<void(CellCoord, KeyHash&)> add_to_key;  ///< TileParams::add_to_key; may be empty
};

/// The caller's steps while levels are cut. Tiles arrive in no order, one at a time, on any thread.
struct CutSteps {
  std::function<void(const std::string&)> begin;
  std::function<CutFiles(std::size_t level, const GridFrame& frame)> files;
  std::function<void(std::size_t level, LevelTile&&)> take;
  std::function<void(double)> left;  ///< is told which share of all tiles is not kept; may be empty
};

/// Returns what decides the tiles of a level, besides its scale and the names of files. Keeps references.
[[nodiscard]] TileParams tile_params(const TilesetPlan& plan, std::size_t level, const CutOptions& options);

/// Makes all tiles of plan.cut. Afterwards `pyramid` is at the first level that is not cut.
void make_cut_levels(TilePyramid& pyramid, const TilesetPlan& plan, const CutOptions& options, const CutSteps& steps);

/// Returns the origin of the vertices of a tile: the middle of its cell.
[[nodiscard]] LatticeCoord tile_origin(const Cells& cells, CellCoord cell);

/// Returns what the tree must know of a tile. `frame`: the frame of the tile's level.
[[nodiscard]] TreeTile tree_tile(const LevelTile& tile, const Cells& cells, const GridFrame& frame, std::string uri);

}  // namespace bp
