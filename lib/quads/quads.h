#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/mesh/lattice_mesh.h"

/// Quad-dominant meshes: triangles joined in pairs ([TPC*10]). A quad is not flat in general, so its surface depends on
/// the diagonal that a program draws. Here either diagonal is safe: see pair_triangles().
namespace bp {

/// Corners of a quad, counter-clockwise. The mesh has the diagonal from corner 0 to corner 2.
using Quad = std::array<std::uint32_t, 4>;

enum class QuadKeeps {
  enclosed,  ///< `enclosed` stays inside, whichever diagonals are drawn
  slack,     ///< as `enclosed`; in addition, pairs that need room are chosen less often, the more room they need
  nothing    ///< the surface stays embedded; nothing needs to stay inside (fits)
};

/// Quality of a quad, corners in order: 1 for a square, less for other angles, for a fold along either diagonal and for
/// an aspect above 4; 0 if it bends too much.
[[nodiscard]] double quad_quality(const std::array<LatticeCoord, 4>& corners);
constexpr double kLeastQuadQuality = 0.2;  ///< no quad has less: angles of 18 to 162 degrees, an aspect of at most 20
constexpr double kMostQuadBend = 0.2;      ///< quad_bend()

/// Returns how far a quad is from flat: the distance between its diagonals' lines, over the mean length of the two.
[[nodiscard]] double quad_bend(const std::array<LatticeCoord, 4>& corners);
/// Returns the longest side over the shortest.
[[nodiscard]] double quad_aspect(const std::array<LatticeCoord, 4>& corners);

/// Pairs of triangles of `mesh` (by number, lower first) to be joined, such that for *each* choice of the diagonals of
/// all quads the surface is embedded and keeps what `keeps` says:
///   the two other triangles of a quad meet no triangle of the mesh, and none of the other ones of another quad, but in
///   the corners and edges they share (exact);
///   where the other diagonal cuts into the solid, the tetrahedron between the two holds nothing of `enclosed`
///   (null: such pairs are not taken).
/// Among these, pairs are chosen for many and good quads: by quality, greedily, then improved along alternating paths
/// of three pairs. `mesh`: closed, 2-manifold, embedded. Deterministic. O(n log n).
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> pair_triangles(const LatticeMesh& mesh, QuadKeeps keeps,
                                                                       const Enclosed* enclosed);

/// Returns the pairs among `pairs` that pair_triangles() may return together. If two pairs exclude each other, the
/// better one stays.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> safe_pairs(
    const LatticeMesh& mesh, const std::vector<std::array<std::uint32_t, 2>>& pairs, QuadKeeps keeps,
    const Enclosed* enclosed);

/// Returns the quad of two triangles with a common edge.
[[nodiscard]] Quad quad_of(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b);

/// Returns the two triangles of a quad on both sides of its other diagonal.
[[nodiscard]] std::array<std::array<std::uint32_t, 3>, 2> across(const Quad& quad);

/// Returns the triangles of `mesh`, and the two other ones of each of its quads: every triangle that a program may
/// draw.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> drawable_triangles(const LatticeMesh& mesh);

/// Returns `mesh` with the diagonals that leave the smallest solid, as triangles. Every other choice of diagonals holds
/// this solid (docs/bounding.md, "Quads").
[[nodiscard]] LatticeMesh innermost_choice(const LatticeMesh& mesh);

/// The faces of `mesh` as a file should hold them: the quads of its pairs, and the triangles that are left.
struct PolygonFaces {
  std::vector<Quad> quads;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};
[[nodiscard]] PolygonFaces polygon_faces(const LatticeMesh& mesh);

}  // namespace bp
