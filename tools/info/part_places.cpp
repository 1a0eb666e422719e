#include "tools/info/part_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tools/run/part_boxes.h"

namespace bp {

namespace {

bool touch(const Bounds3d& a, const Bounds3d& b, double slack) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a.min[i] > b.max[i] + slack || b.min[i] > a.max[i] + slack) return false;
  }
  return true;
}

/// Joins boxes that are nearer than `slack`; returns the bounds of each group, in the order of their first boxes.
std::vector<Bounds3d> joined(const std::vector<Bounds3d>& boxes, double slack) {
  std::vector<std::size_t> root(boxes.size());
  std::iota(root.begin(), root.end(), 0);
  const auto root_of = [&](std::size_t i) {
    while (root[i] != i) i = root[i];
    return i;
  };
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!touch(boxes[i], boxes[j], slack)) continue;
      const std::size_t a = root_of(i), b = root_of(j);
      root[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<Bounds3d> bounds(boxes.size()), out;
  for (std::size_t i = 0; i < boxes.size(); ++i) bounds[root_of(i)].merge(boxes[i]);
  for (const Bounds3d& b : bounds) {
    if (!b.empty()) out.push_back(b);
  }
  return out;
}

}  // namespace

std::string part_places(const SceneFiles& scene, const Bounds3d& bounds, const std::string& pattern) {
  constexpr double kRounding = 1e-9;
  const std::string name = nlohmann::json(pattern).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  const auto point = [](const Vec3d& p) { return fmt::format("[{:.6g},{:.6g},{:.6g}]", p[0], p[1], p[2]); };
  std::string text;
  for (const Bounds3d& box : joined(part_boxes(scene, bounds, pattern, {}), kRounding * bounds.diagonal()))
    text += fmt::format("{{\"name\": {}, \"box\": [{},{}]}}\n", name, point(box.min), point(box.max));
  return text;
}

}  // namespace bp
