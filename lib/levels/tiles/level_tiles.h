#pragma once
#include <functional>
#include <span>

#include "lib/grid/cells.h"
#include "lib/pass/context.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "lib/store/result_key.h"

/// A level of detail in pieces: one proxy for each cell of the grid, as an independent job.
///
/// A tile is the proxy of (closing ∩ its cell grown by one voxel), less what the closing has there for other cells'
/// voxels only, closed by walls where the cell ends. By section 2 of docs/bounding.md the scene's part in the closed
/// cell lies in the open interior of the solid's voxels in the grown cell, so each tile strictly encloses its part by
/// itself: neighbours overlap by two voxels, and no crack can open, whichever levels are drawn side by side. What stays
/// inside while it is tightened is the closing, the solid, or that part of the scene's triangles, exactly. A job reads
/// nothing but the voxels and triangles around its cell and the parameters: same input, same bytes.
namespace bp {

/// The voxels of one level, on whole bricks; cells are aligned to them.
struct TileLevel {
  StreamHeader header;  ///< of `solid`
  const BrickShelf& solid;
  const BrickShelf& surface;  ///< voxels that hold a point of what the scene shows to the outside
  const BrickShelf& closing;  ///< of solid; its bricks may lie outside header.bricks
  Cells cells;
};

/// What decides a tile, besides the voxels, the scene and the cell. Its key has all of it.
struct TileShape {
  MeshMode mode = MeshMode::bounding;  ///< bounding or fit
  Enclose enclose = Enclose::input;    ///< of bounding tiles; scene: of a tile with many triangles nearby, the input
  double scale_world = 0;              ///< that the closing was made with
  StructuringElement element = StructuringElement::cube;
  std::uint64_t faces = 0;  ///< of each tile; 0: kDenseFacesPerFace
  /// Largest distance of a tile to what it encloses; 0: none. A budget of faces has no meaning then.
  double error_world = 0;
  std::string encoding;  ///< all that encode() puts into a file besides cell and mesh
};

/// How tiles are made and kept.
struct TileParams : TileShape {
  /// What vertices of a fit move to; null: the closing. Of Enclose::scene, what stays inside; null: the solid.
  const TriangleBvh* scene = nullptr;
  Rounding rounding;                      ///< of the scene's triangles
  std::function<bool(CellCoord)> wanted;  ///< other tiles are passed over; empty: all are wanted
  bool make = true;                       ///< false: what is not kept comes without measures and content
  std::function<void(CellCoord, KeyHash&)>
      add_to_key;  ///< adds further inputs of a tile to its cache key; may be empty

  static constexpr std::uint64_t kDenseFacesPerFace = 100, kLeastTileFaces = 60;  ///< of a tile without a budget
  /// A bounding tile without a budget keeps more faces where these would take it farther from what it encloses: thin
  /// parts that lie apart in one tile have few faces of their voxels' surface, and none to spare. Only where the
  /// surface is small enough to be whole in memory (16 MiB): a limit on distances wants that, and larger ones have
  /// many.
  static constexpr double kErrorVox = 3;
  static constexpr std::uint64_t kMostFacesForError = std::uint64_t(1) << 16;
  static constexpr std::size_t kMostTriangles = std::size_t(1) << 18;  ///< that a tile encloses; else voxels
};

struct TileMeasures {
  LatticeCoord min{}, max{};                 ///< of its vertices, in the frame of the level
  std::uint64_t faces = 0, faces_asked = 0;  ///< asked 0: an error was asked for
  std::uint64_t faces_dense = 0;
  double volume = 0;  ///< scene units cubed
  /// What a viewer can see of it, as LodLevel::error_world: upper bound of the distance of a point of the tile to the
  /// surface of the solid's part in the cell, walls included, scene units; of a fit, also of what sticks out of it.
  /// Where tiles are drawn together, walls lie inside, and it bounds the distance to the scene.
  double error_world = 0;
};

struct LevelTile {
  CellCoord cell{};
  TileMeasures measures;
  std::string content;  ///< what encode() made of it
  bool kept = false;    ///< found among the results
};

/// The file of a tile; its mesh is in the frame of the level. On any thread.
using TileEncoder = std::function<std::string(CellCoord, const LatticeMesh&)>;

/// A level to be made.
struct TileTask {
  TileLevel level;
  TileParams params;
  TileEncoder encode;
  /// Gets the tiles in no order, on any thread, one at a time, whatever their level.
  std::function<void(LevelTile&&)> consume;
};

/// All tiles of all levels: those whose cell holds voxels of the closing, but for cavities that the closing fills.
/// First those that are kept among the results, then the others, large ones first; none waits for another. `left`, if
/// given, is told between the two which share of all is to be made, by their surfaces. Memory: 320 bytes for each
/// triangle of the dense surface of a tile at work. Throws out_of_resource if not even one tile fits.
void make_tiles(std::span<const TileTask> tasks, const PassContext& context,
                const std::function<void(double)>& left = {});

}  // namespace bp
