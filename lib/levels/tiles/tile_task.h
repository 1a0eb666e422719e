#pragma once
#include <optional>
#include <string>

#include "lib/levels/tiles/tile_plan.h"
#include "lib/pass/mesh/mesh_params.h"

/// A level that is made in tiles (level_tiles.h): its voxels, and the parameters of its tiles.
namespace bp {

class TriangleBvh;

/// The voxels of one level. The cells consist of whole bricks.
struct TileLevel {
  StreamHeader header;  ///< of `solid`
  const BrickShelf& solid;
  const BrickShelf& surface;  ///< voxels that hold a point of what the scene shows to the outside
  const BrickShelf& closing;  ///< of solid; its bricks may lie outside header.bricks
  Cells cells;
};

/// The parameters that decide a tile, in addition to the voxels, the scene and the cell. The tile's key holds all of
/// them.
struct TileShape {
  MeshMode mode = MeshMode::bounding;  ///< bounding or fit
  /// For bounding tiles; Enclose::scene becomes input if a tile has more than kMostTriangles triangles nearby.
  Enclose enclose = Enclose::input;
  double scale_world = 0;  ///< scale of the closing
  StructuringElement element = StructuringElement::cube;
  std::uint64_t faces = 0;  ///< budget of each tile; 0: kDensePerFace decides
  /// Largest distance of a tile to what it encloses; 0: none. It replaces the budget of faces.
  double error_world = 0;
  std::string encoding;  ///< everything in a tile's file that does not follow from the cell and the mesh
};

/// The tiles of a level whose jobs are wanted.
struct WantedTiles {
  CutLevel level;
  JobRange jobs;
  [[nodiscard]] bool holds(CellCoord cell) const { return jobs.meets(level.number_of(cell), 1); }
};

/// How the tiles of a level are made.
struct TileParams : TileShape {
  /// The triangles that vertices of a fit move to; null: they move to the closing. With Enclose::scene, the triangles
  /// that stay inside; null: the solid stays inside.
  const TriangleBvh* scene = nullptr;
  Rounding rounding;                                    ///< of the scene's triangles
  std::optional<WantedTiles> wanted;                    ///< the tiles that are made; empty: all
  static constexpr std::uint64_t kLeastTileFaces = 60;  ///< the least faces of a tile without a budget
  /// A bounding tile without a budget gets more faces if it would lie farther than this from what it encloses. Thin
  /// parts that lie apart in one tile need that: the voxels' surface is small, so the budget is, too. It is done only
  /// for a surface of at most kMostFacesForError faces, which is whole in memory (16 MiB), as a limit on distances
  /// needs it; larger surfaces have a large budget.
  static constexpr double kErrorVox = 3;
  static constexpr std::uint64_t kMostFacesForError = std::uint64_t(1) << 16;
  static constexpr std::size_t kMostTriangles = std::size_t(1) << 18;  ///< a tile with more triangles encloses voxels
};

/// The options that the tiles of all cut levels share.
struct CutOptions {
  Cells cells;
  TileParams tile;               ///< without what tile_params() sets
  std::optional<JobRange> jobs;  ///< empty: all
};

/// Returns what decides the tiles of a level, besides the names of files.
[[nodiscard]] TileParams tile_params(const TilesetPlan& plan, std::size_t level, const CutOptions& options);

struct TileMeasures {
  LatticeCoord min{}, max{};                 ///< box around its vertices, in the frame of the level
  std::uint64_t faces = 0, faces_asked = 0;  ///< asked 0: an error was asked for instead
  std::uint64_t faces_dense = 0;
  double volume = 0;  ///< scene units cubed
  /// Upper bound of the error that a viewer can see, scene units, as LodLevel::error_world: the distance from a point
  /// of the tile to the surface of the solid's part in the cell, with the cell's walls. For a fit, also the distance
  /// from points of that surface that lie outside. Where neighbouring tiles are drawn, walls lie inside, so it bounds
  /// the distance to the scene.
  double error_world = 0;
};

/// A level that TileJobs makes.
struct TileTask {
  std::size_t number = 0;  ///< number of the level; 0: the finest
  TileLevel level;
  TileParams params;
};

/// Returns how many voxels beyond its cell a tile of this scale looks for triangles of the scene.
[[nodiscard]] std::int32_t tile_reach(double scale_world, double voxel);
/// Returns the origin of the vertices of a tile: the middle of its cell.
[[nodiscard]] LatticeCoord tile_origin(const Cells& cells, CellCoord cell);

}  // namespace bp
