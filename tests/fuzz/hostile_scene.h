#pragma once
#include <array>
#include <string>
#include <vector>

#include "tests/fuzz/choices.h"

/// Scene files of every format that our own readers read, with any numbers.
namespace fuzz {

struct SceneFile {
  std::string extension, bytes;
};

/// A few triangles: mostly a small sound shape, moved, scaled, with a few numbers at their limits.
struct Shape {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};
[[nodiscard]] Shape hostile_shape(Choices& choices);

[[nodiscard]] SceneFile hostile_scene(Choices& choices);

[[nodiscard]] std::string hostile_ply(Choices& choices);
[[nodiscard]] std::string hostile_stl(Choices& choices);
[[nodiscard]] std::string hostile_obj(Choices& choices);
[[nodiscard]] std::string hostile_off(Choices& choices);
[[nodiscard]] std::string hostile_gltf(Choices& choices);  ///< with its buffers inside
[[nodiscard]] std::string hostile_glb(Choices& choices);

}  // namespace fuzz
