#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "lib/grid/bit_box.h"
#include "lib/grid/scale_field.h"
#include "lib/grid/stream.h"

/// Surfaces of voxels to look at: smooth, without stairs. They are for pictures only; no vertex of a proxy comes from
/// here.
///
/// Each corner of the voxels' surface moves to the level of one half of the blurred occupancy, by at most kMostMoved
/// along each axis, and by less where the solid is thin, so that a wire of one voxel stays visible. The gradient there
/// is its normal. [CB17] §5.1 keeps the corners and filters normals of voxels;
/// moved corners have smooth outlines, too.
namespace bp {

/// The faces of the occupied voxels of one brick, laid out for a GPU.
struct SurfacePiece {
  static constexpr float kMostMoved = 0.5F;  ///< voxels
  static constexpr int kPerVoxel = 256;      ///< steps of a position in a voxel
  static constexpr int kOrigin = 8;          ///< voxels that are added to a position, so that it is never negative

  struct Vertex {
    std::array<std::uint16_t, 3> position;  ///< from the brick's first voxel, less kOrigin; 1/256 voxel
    Scale scale;                            ///< of the closing at the vertex
    std::array<std::int8_t, 4> normal;      ///< outwards, 127 is 1; the last is 0
  };
  static_assert(sizeof(Vertex) == 12);
  BrickCoord brick;
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 4>> faces;  ///< of voxels, counter-clockwise seen from outside
  std::vector<VoxelCoord> corners;  ///< corners of voxels that the vertices come from; they are not drawn
};

/// Returns the two triangles that a face is drawn as.
[[nodiscard]] inline std::array<std::array<std::uint32_t, 3>, 2> triangles_of(
    const std::array<std::uint32_t, 4>& face) {
  return {{{face[0], face[1], face[2]}, {face[0], face[2], face[3]}}};
}

/// Returns how many voxels around a brick its piece depends on.
[[nodiscard]] std::int32_t piece_apron();

/// Returns the piece of a brick of `shelf`; empty if the brick has no face. `scale` has samples for the brick, grown by
/// one voxel. Neighbours agree on the vertices that they share. Memory while it is made: 4 MiB.
[[nodiscard]] SurfacePiece piece_of(const BrickShelf& shelf, BrickCoord brick, const ScaleLattice& scale);
/// Returns the piece of a brick of `cells`, which lie within their box, without scales.
[[nodiscard]] SurfacePiece piece_of(const BitBox& cells, BrickCoord brick);

}  // namespace bp
