#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lib/core/coords.h"
#include "lib/core/indexed_mesh.h"

/// Cages are closed meshes of triangles that carry the points inside.
namespace bp {

/// A cage in its own unit: the centre of its vertices is the origin, and its diagonal is 1.
struct Cage {
  struct Edge {
    std::uint32_t a, b;
  };
  /// A face, which faces outwards. Edge i lies opposite to corner i. Its sign is 1 if it runs as the face does, else
  /// -1.
  struct Face {
    std::array<std::uint32_t, 3> corner, edge;
    std::array<double, 3> sign;
  };
  std::vector<Vec3d> vertices;
  std::vector<Edge> edges;
  std::vector<Face> faces;  ///< faces that name a vertex twice are left out
  Vec3d origin{};           ///< in scene units
  double diagonal = 1;      ///< in scene units
  /// The inverse of the sum of v v^T over the vertices, for least-squares fits of a linear map.
  std::array<Vec3d, 3> spread{};

  [[nodiscard]] Vec3d to_cage(const Vec3d& p) const {
    return {(p[0] - origin[0]) / diagonal, (p[1] - origin[1]) / diagonal, (p[2] - origin[2]) / diagonal};
  }
};

constexpr std::size_t kMostCageVertices = std::size_t(1) << 16, kMostCageTriangles = std::size_t(1) << 18;

/// Makes a cage. Throws bad_input, with a message that begins with `name`, if the mesh is no cage: it is empty, has a
/// vertex that is not finite, more than kMostCageVertices vertices or kMostCageTriangles triangles, an open edge, faces
/// that face both ways, or no volume. A cage that faces inwards is turned.
[[nodiscard]] Cage make_cage(const IndexedMesh& mesh, const std::string& name);

}  // namespace bp
