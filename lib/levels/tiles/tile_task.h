#pragma once
#include <functional>
#include <string>

#include "lib/grid/cells.h"
#include "lib/pass/mesh/mesh_params.h"
#include "lib/store/result_key.h"

/// A level that is made in tiles (level_tiles.h): its voxels, the parameters of its tiles, and what is told of each.
namespace bp {

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
  std::uint64_t faces = 0;  ///< budget of each tile; 0: kDenseFacesPerFace decides
  /// Largest distance of a tile to what it encloses; 0: none. It replaces the budget of faces.
  double error_world = 0;
  std::string encoding;  ///< all that encode() puts into a file, except the cell and the mesh
};

/// How tiles are made and kept.
struct TileParams : TileShape {
  /// The triangles that vertices of a fit move to; null: they move to the closing. With Enclose::scene, the triangles
  /// that stay inside; null: the solid stays inside.
  const TriangleBvh* scene = nullptr;
  Rounding rounding;                      ///< of the scene's triangles
  std::function<bool(CellCoord)> wanted;  ///< tells which tiles are made; empty: all
  bool make = true;                       ///< false: tiles that are not kept are passed on without measures and content
  std::function<void(CellCoord, KeyHash&)>
      add_to_key;  ///< adds further inputs of a tile to its cache key; may be empty

  static constexpr std::uint64_t kDenseFacesPerFace = 100, kLeastTileFaces = 60;  ///< for tiles without a budget
  /// A bounding tile without a budget gets more faces if it would lie farther than this from what it encloses. Thin
  /// parts that lie apart in one tile need that: the voxels' surface is small, so the budget is, too. It is done only
  /// for a surface of at most kMostFacesForError faces, which is whole in memory (16 MiB), as a limit on distances
  /// needs it; larger surfaces have a large budget.
  static constexpr double kErrorVox = 3;
  static constexpr std::uint64_t kMostFacesForError = std::uint64_t(1) << 16;
  static constexpr std::size_t kMostTriangles = std::size_t(1) << 18;  ///< a tile with more triangles encloses voxels
};

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

struct LevelTile {
  CellCoord cell{};
  TileMeasures measures;
  std::string content;  ///< what encode() returned
  bool kept = false;    ///< its result was kept by an earlier run
};

/// Makes the file of a tile. The mesh is in the frame of the level. Called on any thread.
using TileEncoder = std::function<std::string(CellCoord, const LatticeMesh&)>;

/// A level that make_tiles() makes.
struct TileTask {
  TileLevel level;
  TileParams params;
  TileEncoder encode;
  /// Receives the tiles of all levels: in no order, one at a time, on any thread.
  std::function<void(LevelTile&&)> consume;
};

/// Returns how many voxels beyond its cell a tile of this scale looks for triangles of the scene.
[[nodiscard]] std::int32_t tile_reach(double scale_world, double voxel);

}  // namespace bp
