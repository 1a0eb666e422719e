#pragma once
#include "lib/mesh/half_edge_mesh.h"
#include "lib/surface/piece.h"

/// Parts of a closed surface that are changed at the same time, each in a cell of its own. In a region vertices are
/// free that lie strictly inside of its cell with all of their faces in it; every other face that reaches into the cell
/// stays as it is and is there to be tested against. New vertices lie strictly inside, so what happens in one cell
/// meets nothing of what happens in others (docs/bounding.md, "Regions"). What lies along cells' sides has its turn
/// with other cells.
namespace bp {

constexpr std::uint64_t kFacesPerRegion = 2048;  ///< if nobody says

struct Region {
  LatticeBox cell;                  ///< closed; those of different regions have no inner point in common
  std::vector<VertexId> vertices;   ///< of the whole, rising; their numbers here
  std::vector<char> free;           ///< of each of these
  std::vector<FaceId> faces;        ///< of the whole; first those that stay as they are
  std::size_t fixed = 0;            ///< how many of these
  std::vector<Triangle> triangles;  ///< these faces, by the numbers of their vertices here
};

/// Cells by halving along the axis along which faces spread most, until at most so many faces, 3 or more, have their
/// middles in one, or all in one point; with another `turn` their sides lie elsewhere. They depend on the surface
/// alone. n log n.
[[nodiscard]] std::vector<Region> regions_of(const Piece& whole, std::uint64_t faces_per_region, int turn);

/// What a region knows; vertices that are not free are locked.
[[nodiscard]] HalfEdgeMesh mesh_of(const Piece& whole, const Region& region);

/// Free vertices and their faces as they are now; faces that are gone are marked, with shells that went as a whole also
/// some that had stayed. Thread-safe for different regions of one turn.
void put_back(const HalfEdgeMesh& mesh, const Region& region, Piece& whole);

/// Drops faces that are marked, and vertices that no face is left of.
void drop_removed(Piece& whole);

}  // namespace bp
