#pragma once
#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "lib/core/color.h"
#include "lib/core/texture.h"

namespace bp {

/// A vertex. Its position is a whole multiple of a short double, so float32 holds it, and neighbours agree.
struct LeafVertex {
  std::array<std::int32_t, 3> at{};  ///< from SceneLeaf::origin, in units
  std::array<float, 3> normal{};     ///< of length 1
  std::array<float, 2> uv{};
  LinearColor color;
  std::array<float, 2> second_uv{};
  friend auto operator<=>(const LeafVertex&, const LeafVertex&) = default;
};

/// The sides from which triangles are seen.
enum class LeafSides : std::uint8_t { as_material, both, one };

/// The triangles that look alike.
struct LeafPart {
  std::uint32_t material = TriangleTexture::kNoMaterial;
  LeafSides sides = LeafSides::as_material;
  std::vector<LeafVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace bp
