#pragma once
#include "io/scene/instanced_scene.h"
#include "lib/core/box.h"

namespace bp {

/// Returns the bounds of all vertices, as they are placed: triangles seldom leave out those that are farthest out.
/// Reads the vertices in parallel; the bounds that a file states are not believed. Returns nothing if positions are not
/// floats as nearly all files have them, if there are arrays of instances, or if the vertices are more than the corners
/// of all triangles: many primitives may share one long accessor.
[[nodiscard]] std::optional<Bounds3d> bounds_ahead(const InstancedScene& scene);

}  // namespace bp
