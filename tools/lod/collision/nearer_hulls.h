#pragma once
#include "lib/hulls/convex_parts.h"
#include "tools/lod/scene/complete_levels.h"

namespace bp {

/// The hulls of a collision body that hold least, with the same budget: those of the body, or the scene's convex parts
/// as they are and the hulls of a body around the rest (lib/hulls/convex_scene.h). The second way is tried where bodies
/// enclose the scene's triangles, and the convex parts hold a share of the body that counts.
[[nodiscard]] ConvexParts nearer_hulls(Build& build, const MadeChain& chain);

}  // namespace bp
