#pragma once
#include <string>

#include "lib/core/triangle_source.h"

/// What is told of a scene whose files hold more than is checked. Shared by the verdicts on meshes and on tilesets.
namespace bp {

/// "1 mesh part twice, plain and compressed, ..."
[[nodiscard]] std::string held_twice(std::uint64_t differing);
/// "1 mesh in a pose of its joints, ..."; empty if there is none.
[[nodiscard]] std::string not_followed(const Unfollowed& unfollowed);
/// A line for what was left out, and one for what the files hold twice; empty if there is neither.
[[nodiscard]] std::string left_out_lines(const SceneCounts& counts, const std::string& indent);
/// Why nothing is proven of what the files of `whose` (scene, proxy) hold; unfollowed.any() is true.
[[nodiscard]] std::string drawn_elsewhere(const char* whose, const Unfollowed& unfollowed);
/// Why nothing is proven of a scene that is_partial().
[[nodiscard]] std::string partial_scene(const SceneCounts& counts);

}  // namespace bp
