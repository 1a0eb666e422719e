#pragma once
#include "io/gltf/gltf_document.h"

/// The bounds that a glTF tells of its vertices (min and max of POSITION). Viewers cull by them.
namespace bp {

/// Returns the bounds that an accessor, which is `positions`, tells of itself, grown by what rounding to float32
/// explains; none if it tells none. `packed`: Draco has rounded the positions, to at least 10 bits.
[[nodiscard]] std::optional<Bounds3d> told_bounds(const GltfObject& accessor, const Accessor& positions, bool packed);
/// Returns whether all positions lie within the bounds.
[[nodiscard]] bool lies_in(const GltfDocument& doc, const Accessor& positions, const Bounds3d& bounds);

}  // namespace bp
