#pragma once
#include <vector>

#include "lib/mesh/quadric.h"
#include "lib/pass/leaf/detail/leaf_mesh.h"

namespace bp {

/// Returns the quadric of each point, relative to it: the planes of its faces, and planes that hold the course of
/// borders and seams there; with `holds_folds` also that of sharp folds.
[[nodiscard]] std::vector<Quadric> quadrics_of(const LeafMesh& mesh, bool holds_folds);

}  // namespace bp
