#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "lib/mesh/lattice_mesh.h"

/// A mesh for viewers, in which each vertex has one normal. A vertex at a crease is split into several.
namespace bp {

/// Two faces that meet at a larger angle have a visible edge between them.
constexpr double kCreaseDegrees = 30;

/// The mesh with copies of its vertices: a vertex has a copy for each of its normals and colours, at the same position.
struct ShadedMesh {
  std::vector<std::uint32_t> vertex;          ///< of each copy: the number of its vertex in the mesh
  std::vector<std::array<float, 3>> normals;  ///< of each copy: a unit vector; (0, 0, 1) if the faces' normals cancel
  std::vector<std::array<float, 2>> uv;       ///< of each copy; empty if the mesh has no texture
  std::vector<LinearColor> colors;            ///< of each copy; empty if the mesh has none
  /// The triangles of the mesh in its order, as numbers of copies.
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Splits each vertex at creases. Faces share a normal if edges at the vertex lead from one to the other without a
/// crease; it is the mean of their normals, weighted by their angle at the vertex. A vertex also has a copy for each of
/// its colours, and for each chart of the mesh's texture; that changes no normal. Copies are in the order of their
/// first use. O(n log n) time, about 150 bytes a triangle.
[[nodiscard]] ShadedMesh shaded(const LatticeMesh& mesh);

}  // namespace bp
