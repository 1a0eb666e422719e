#pragma once
#include <string>

#include "lib/core/triangle_source.h"

/// Words about a scene whose files hold more than is checked. The verdicts on meshes and on tilesets share them.
namespace bp {

/// Returns "1 mesh part twice, plain and compressed, ...".
[[nodiscard]] std::string held_twice(std::uint64_t differing);
/// Returns "1 mesh in a pose of its joints, ..."; empty if there is none.
[[nodiscard]] std::string not_followed(const Unfollowed& unfollowed);
/// Returns a line for parts that were left out, and one for parts that the files hold twice; empty if there is neither.
[[nodiscard]] std::string left_out_lines(const SceneCounts& counts, const std::string& indent);
/// Returns why nothing is proven about the files of `whose` (scene, proxy); unfollowed.any() must be true.
[[nodiscard]] std::string drawn_elsewhere(const char* whose, const Unfollowed& unfollowed);
/// Returns why nothing is proven of a scene that is_partial().
[[nodiscard]] std::string partial_scene(const SceneCounts& counts);

}  // namespace bp
