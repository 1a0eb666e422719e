#include "lib/pass/leaf/joined_leaves.h"

#include <cmath>
#include <map>

#include "lib/pass/leaf/detail/growing_part.h"

namespace bp {

SceneLeaf joined(std::span<const SceneLeaf> leaves, const Vec3d& origin,
                 const std::function<ResultKey(std::uint32_t material)>& key_of) {
  std::map<std::pair<ResultKey, LeafSides>, GrowingPart> parts;
  SceneLeaf all;
  all.origin = origin;
  for (const SceneLeaf& leaf : leaves) {
    all.unit = leaf.unit;
    all.bounds.merge(leaf.bounds);
    std::array<std::int32_t, 3> by{};
    for (std::size_t i = 0; i < 3; ++i)
      by[i] = std::int32_t(std::nearbyint(leaf.origin[i] / leaf.unit) - std::nearbyint(origin[i] / leaf.unit));
    for (const LeafPart& part : leaf.parts) {
      GrowingPart& growing = parts[{key_of(part.material), part.sides}];
      growing.part.material = part.material;
      growing.part.sides = part.sides;
      std::vector<std::uint32_t> numbers;
      for (LeafVertex v : part.vertices) {
        for (std::size_t i = 0; i < 3; ++i) v.at[i] += by[i];
        numbers.push_back(growing.number_of(v));
      }
      for (const auto& t : part.triangles)
        growing.part.triangles.push_back({numbers[t[0]], numbers[t[1]], numbers[t[2]]});
    }
  }
  for (auto& [key, growing] : parts) all.parts.push_back(std::move(growing.part));
  return all;
}

}  // namespace bp
