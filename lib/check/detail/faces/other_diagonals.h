#pragma once
#include <span>

#include "lib/core/indexed_mesh.h"

/// Faces of a proxy that are not flat: a program may draw them over other diagonals than the ones that were read, each
/// as it likes.
namespace bp {

/// Returns whether all triangles of a polygon lie in one plane; false if a coordinate is not finite.
[[nodiscard]] bool is_flat(std::span<const TriangleD> polygon);

struct OtherDiagonals {
  IndexedMesh mesh;                  ///< the proxy, with each quad that is not flat cut along its other diagonal
  std::vector<std::uint32_t> quads;  ///< the first of the two triangles of each such quad
  std::uint64_t larger = 0;          ///< other faces that are not flat, for which no other cut is tried

  [[nodiscard]] std::uint64_t faces() const { return quads.size() + larger; }
};

[[nodiscard]] OtherDiagonals other_diagonals(const IndexedMesh& proxy);

/// Returns whether quads that are cut the other way meet nothing of the proxy as read, so that each may be cut either
/// way if both meshes are embedded: two quads that are cut in different ways do not meet.
[[nodiscard]] bool may_be_mixed(const IndexedMesh& proxy, const OtherDiagonals& others);

}  // namespace bp
