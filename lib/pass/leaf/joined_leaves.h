#pragma once
#include <functional>
#include <span>

#include "lib/pass/leaf/scene_leaf.h"

namespace bp {

/// Joins leaves of one unit into one around `origin`. All origins are whole multiples of the unit, so no vertex moves.
/// Vertices that look alike at one place become one, also where leaves were cut from each other. `key_of`: as
/// SceneLooks::key_of(). The order of parts does not depend on the numbers of materials.
[[nodiscard]] SceneLeaf joined(std::span<const SceneLeaf> leaves, const Vec3d& origin,
                               const std::function<ResultKey(std::uint32_t material)>& key_of);

}  // namespace bp
