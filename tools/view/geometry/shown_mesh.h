#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lib/core/indexed_mesh.h"

/// A mesh as the page draws it, and its bytes (page/src/wire.ts reads them).
namespace bp {

struct ShownMesh {
  using Direction = std::array<std::int8_t, 4>;         ///< 127 is 1; the last is 0
  std::vector<std::array<float, 3>> positions;          ///< scene units, less the middle of the scene
  std::vector<Direction> normals;                       ///< one for each position, or none: the mesh is drawn flat
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< none: each three positions are one
  std::vector<std::array<std::uint32_t, 2>> edges;      ///< of faces: inner edges of quads and polygons are left out
  std::vector<float> distances;                         ///< one for each position, or none; scene units
  std::uint32_t faces = 0;                              ///< triangles of the file; SceneDistances may draw more

  /// Returns six counts (u32: positions, normals, triangles, edges, distances, faces), then the arrays in this order.
  /// Numbers are little-endian and aligned to four bytes.
  [[nodiscard]] std::string bytes() const;
};

/// Returns a direction of length 1 as bytes; 0 for a vector without length.
[[nodiscard]] ShownMesh::Direction packed_direction(const Vec3d& n);

/// Returns a mesh with its edges. `shift` is added to each position. Triangles with a corner that names no vertex are
/// left out.
[[nodiscard]] ShownMesh shown_mesh(const IndexedMesh& mesh, const Vec3d& shift);

/// Returns triangles, each with corners of its own, and the normals of smooth_normals().
[[nodiscard]] ShownMesh shown_smooth(const std::vector<TriangleD>& triangles, const Vec3d& shift);

}  // namespace bp
