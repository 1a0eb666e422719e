#pragma once
#include <optional>
#include <span>

#include "lib/core/triangle_source.h"
#include "lib/mesh/lattice_mesh.h"

/// Makes a bounding proxy without voxels: the scene's own surface, moved outwards by one or two steps of the lattice.
namespace bp {

/// Returns the surface of `scene` in `frame`, with its vertices moved outwards, to lattice points beyond the planes of
/// the faces around them. A vertex for which no such point exists stays. The result is a closed, embedded mesh that
/// strictly contains every triangle of the scene, even if its points are off by `rounding`; this is decided exactly. It
/// is connected as the scene is, with two exceptions: the few places where the scene folds over itself get a tent
/// (detail/mend_around.h), and shells within others are left out. It has at most as many faces as the scene.
///
/// Returns nothing if the scene is not such a surface: each edge must belong to two triangles, in opposite directions,
/// and hardly any triangles may touch or cross, as those of walls, overlapping parts and very thin gaps do. Parallel;
/// the result does not depend on the number of threads. Cost: a sort of the corners, and the cost of mend_around();
/// about 300 bytes for each triangle at the same time.
[[nodiscard]] std::optional<LatticeMesh> outward_scene(std::span<const TriangleD> scene, const Rounding& rounding,
                                                       const GridFrame& frame);

}  // namespace bp
