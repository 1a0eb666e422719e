#pragma once
#include "lib/hulls/convex_parts.h"
#include "tools/lod/scene/complete_levels.h"

namespace bp {

/// Returns the hulls of a collision body with the least volume for a budget. There are two candidates: the hulls of the
/// body, or the scene's convex parts unchanged with the hulls of a body around the rest (lib/hulls/convex_scene.h). The
/// second is tried only if bodies enclose the scene's triangles, and if the convex parts hold at least 5 % of the body.
[[nodiscard]] ConvexParts nearer_hulls(Build& build, const MadeChain& chain);

}  // namespace bp
