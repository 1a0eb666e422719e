#pragma once
#include "lib/mesh/half_edge_mesh.h"
#include "lib/simplify/region_size.h"
#include "lib/surface/piece.h"

/// Parts of a closed surface that are changed at the same time, each in a cell of its own. A vertex of a region is free
/// if it lies strictly inside the cell with all of its faces. Every other face that reaches into the cell stays as it
/// is, and new faces are tested against it. New vertices lie strictly inside, so changes in one cell meet nothing of
/// the changes in others (docs/bounding.md, "Regions"). Faces along the sides of cells are changed in another turn,
/// whose cells lie elsewhere.
namespace bp {

struct Region {
  LatticeBox cell;  ///< closed; those of different regions have no inner point in common
  /// By their number in the whole, rising; their index here is their number in the region.
  std::vector<VertexId> vertices;
  std::vector<char> free;           ///< per vertex
  std::vector<FaceId> faces;        ///< by their number in the whole; those that stay as they are come first
  std::size_t fixed = 0;            ///< number of faces that stay
  std::vector<Triangle> triangles;  ///< the faces, by numbers of vertices in the region
};

/// Cuts a surface into cells by halving along the axis along which faces spread most, until at most `faces_per_region`
/// (3 or more) faces have their middles in a cell, or all have them in one point. Another `turn` puts the cells' sides
/// elsewhere. The cells depend on the surface alone. n log n.
[[nodiscard]] std::vector<Region> regions_of(const Piece& whole, std::uint64_t faces_per_region, int turn);

/// Returns the region as a mesh; vertices that are not free are locked.
[[nodiscard]] HalfEdgeMesh mesh_of(const Piece& whole, const Region& region);

/// Puts the free vertices and their faces back into the whole. Faces that are gone are marked, including faces that
/// stayed when their shell was erased. Thread-safe for different regions of one turn.
void put_back(const HalfEdgeMesh& mesh, const Region& region, Piece& whole);

/// Drops marked faces, and vertices without a face.
void drop_removed(Piece& whole);

}  // namespace bp
