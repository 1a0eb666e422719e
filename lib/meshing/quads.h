#pragma once
#include "lib/meshing/enclosed.h"
#include "lib/meshing/lattice_mesh.h"

/// Quad-dominant meshes: triangles joined in pairs ([TPC*10]). A quad is not flat in general, so what it means depends
/// on the diagonal that a reader draws. Here any choice is safe: see pair_triangles().
namespace bp {

/// Corners of a quad, counter-clockwise; 0 and 2 end the diagonal that the mesh has.
using Quad = std::array<std::uint32_t, 4>;

enum class QuadKeeps {
  enclosed,  ///< what is in `enclosed` stays inside, whichever diagonals are drawn
  nothing    ///< the surface stays embedded; nothing needs to stay inside (fits)
};

/// Pairs of triangles of `mesh` (by number, lower first) to be joined, such that for *each* choice of the diagonals of
/// all quads the surface is embedded and keeps what `keeps` says:
///   the two other triangles of a quad meet no triangle of the mesh, and none of the other ones of another quad, but in
///   the corners and edges they share (exact);
///   where the other diagonal cuts into the solid, the tetrahedron between the two holds nothing of `enclosed`
///   (null: such pairs are not taken).
/// Among these, pairs are chosen for many and good quads: by quality, greedily, then improved along alternating paths
/// of three pairs. Quality is 1 for a square, less for angles other than 90 degrees and for a fold along either
/// diagonal. `mesh`: closed, 2-manifold, embedded. Deterministic. O(n log n).
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> pair_triangles(const LatticeMesh& mesh, QuadKeeps keeps,
                                                                       const Enclosed* enclosed);

/// The quad of two triangles with a common edge.
[[nodiscard]] Quad quad_of(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b);

/// The faces of `mesh` as a file should hold them: the quads of its pairs, and the triangles that are left.
struct PolygonFaces {
  std::vector<Quad> quads;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};
[[nodiscard]] PolygonFaces polygon_faces(const LatticeMesh& mesh);

}  // namespace bp
