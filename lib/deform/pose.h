#pragma once
#include <span>
#include <string>
#include <vector>

#include "lib/core/indexed_mesh.h"
#include "lib/deform/coordinates.h"

/// Cages in another pose, and their effect on directions.
namespace bp {

/// Returns the move of each vertex of a cage. `posed`: the faces of the posed cage, the same in the same order. Throws
/// bad_input, with a message that begins with `name`, if the number of faces differs, if corners that share a vertex of
/// the cage do not share their place, or if one is not finite.
[[nodiscard]] std::vector<Vec3d> moves_of_cage(const IndexedMesh& cage, const std::vector<TriangleD>& posed,
                                               const std::string& name);

/// Turns normals and tangents of points as the cage turns their surroundings, right to about 1e-6; they need not keep
/// their length. `tangents`: as many as normals, or none; tangents without normals stay. Directions that the cage does
/// not turn keep their bits. `moves`: moves_of_columns(). It works on the caller's thread, in
/// coordinates.bytes_at_once(). Cost: three evaluations for each point.
void turn_directions(const CageCoordinates& coordinates, std::span<const Vec3d> moves, std::span<const Vec3d> positions,
                     std::span<Vec3d> normals, std::span<Vec3d> tangents);

}  // namespace bp
