#pragma once
#include <string>

#include "lib/levels/tiles/tile_plan.h"
#include "lib/levels/tiles/tile_pyramid.h"
#include "lib/pass/color/scene_colors.h"
#include "lib/tileset/tile_tree.h"

/// The levels of a tileset that are cut into tiles, each tile a job of its own.
namespace bp {

/// What all tiles have in common.
struct CutOptions {
  Cells cells;
  MeshMode mode = MeshMode::bounding;
  Enclose enclose = Enclose::input;
  SceneColors* colors = nullptr;       ///< null: none
  const TriangleBvh* scene = nullptr;  ///< of fits; null: the closing
  Rounding rounding;                   ///< of the scene's triangles
  std::optional<JobRange> jobs;        ///< empty: all
  bool make = true;                    ///< false: as TileParams::make
};

/// How the tiles of a level become files.
struct CutFiles {
  std::string encoding;  ///< as TileParams::encoding
  /// The file; the mesh has its colours. `origin`: of the lattice, near the middle of the cell.
  std::function<std::string(CellCoord, LatticeMesh&&, LatticeCoord origin)> encode;
  std::function<void(CellCoord, KeyHash&)> add_to_key;  ///< as TileParams::add_to_key; may be empty
};

/// What a caller does while levels are cut. Tiles come in no order, one at a time, on any thread.
struct CutSteps {
  std::function<void(const std::string&)> begin;
  std::function<CutFiles(std::size_t level, const GridFrame& frame)> files;
  std::function<void(std::size_t level, LevelTile&&)> take;
  std::function<void(double)> left;  ///< which share of all is not kept; may be empty
};

/// Makes all tiles of plan.cut. Then `pyramid` is at the first level that is not cut.
void make_cut_levels(TilePyramid& pyramid, const TilesetPlan& plan, const CutOptions& options, const CutSteps& steps);

/// The point that the vertices of a tile are relative to: the middle of its cell.
[[nodiscard]] LatticeCoord tile_origin(const Cells& cells, CellCoord cell);

/// What the tree must know of a tile of a level with this frame.
[[nodiscard]] TreeTile tree_tile(const LevelTile& tile, const Cells& cells, const GridFrame& frame, std::string uri);

}  // namespace bp
