#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "lib/mesh/lattice_mesh.h"

/// A mesh as viewers draw it: with one normal for each vertex.
namespace bp {

/// Faces that meet at a larger angle have a visible edge between them.
constexpr double kCreaseDegrees = 30;

/// Positions are those of the mesh: each vertex of it has a copy here for each of its normals and colours.
struct ShadedMesh {
  std::vector<std::uint32_t> vertex;  ///< of each copy: its number in the mesh
  std::vector<std::array<float, 3>>
      normals;                           ///< of each copy: a unit vector; (0, 0, 1) where the faces' normals cancel
  std::vector<std::array<float, 2>> uv;  ///< of each copy; empty if the mesh has no texture
  std::vector<LinearColor> colors;       ///< of each copy; empty if the mesh has none
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< those of the mesh, in its order, of copies
};

/// Splits each vertex where edges at it are creases: faces share a normal if edges at the vertex lead from one to the
/// other without a crease. The normal is the mean of theirs, weighted by their angle at the vertex. A
/// vertex has a copy for each of its colours and for each chart of the mesh's texture, too; that changes no normal.
/// Copies are in the order of their first use. O(n log n) time, about 150 bytes a triangle.
[[nodiscard]] ShadedMesh shaded(const LatticeMesh& mesh);

}  // namespace bp
