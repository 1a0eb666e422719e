#pragma once
#include "lib/meshing/half_edge_mesh.h"

/// Shells: the connected parts of a closed surface. Where collapses grow one over another that it does not touch, the
/// other stays inside as a shell that bounds nothing.
namespace bp {

/// Of an embedded mesh that bounds a solid: true if the solid is what surrounds its outermost shells.
[[nodiscard]] inline bool faces_inwards(const HalfEdgeMesh& mesh) {
  return mesh.face_count() > 0 && mesh.volume6() < 0;
}

/// Erases the shells across which the winding number W does not change between 0 and 1: those left bound the same solid
/// W >= 1 (docs/bounding.md, "Simplification"). `inwards`: faces_inwards() of the mesh before it was changed; shells
/// that hold nothing may have passed through themselves since, and their sense tells no more. Exact. Needs an embedded
/// mesh that is closed. Returns the number of faces erased. Cost: linear in the faces, and for each further shell a
/// query of a tree.
std::uint64_t erase_inner_shells(HalfEdgeMesh& mesh, bool inwards = false);

}  // namespace bp
