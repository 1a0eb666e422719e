#pragma once
#include <optional>
#include <span>

#include "lib/core/triangle_source.h"
#include "lib/mesh/lattice_mesh.h"

/// A bounding proxy that needs no voxels: the scene's own surface, moved outwards by a step or two of the lattice.
namespace bp {

/// Returns the surface of `scene` in `frame`, each vertex moved to a lattice point beyond the planes of the faces
/// around it: an embedded closed mesh with the scene's triangles strictly inside, decided exactly, wherever they lie
/// within `rounding` of their places. It has the scene's connectivity, but for a few places where the scene folds over
/// itself, which get a tent (detail/mend_around.h), and for shells within others, which are left out. At most as many
/// faces as the scene.
///
/// Returns nothing if the scene is no such surface: each edge has to belong to two triangles, in opposite directions,
/// and hardly anything may touch or cross, as walls, overlapping parts, and gaps thinner than a few lattice units do.
/// Parallel; the result does not depend on the number of threads. Cost: a sort of the corners, and what
/// detail/mend_around.h says; about 300 bytes a triangle meanwhile.
[[nodiscard]] std::optional<LatticeMesh> outward_scene(std::span<const TriangleD> scene, const Rounding& rounding,
                                                       const GridFrame& frame);

}  // namespace bp
