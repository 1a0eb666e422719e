#include "tests/backend/random_triangles.h"

namespace bp::test {

std::int64_t pick(Rng& rng, std::int64_t low, std::int64_t high) {
  return low + std::int64_t(rng() % std::uint64_t(high - low + 1));
}

FixedTriangle random_triangle(Rng& rng, const VoxelBox& box, std::int64_t extent) {
  std::int64_t p[3][3];
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t centre = pick(rng, (box.min[axis] - 1) * kFixedOne, (box.max[axis] + 1) * kFixedOne);
    for (auto& q : p) q[axis] = centre + pick(rng, -extent / 2, extent / 2);
  }
  const int axis = int(pick(rng, 0, 2)), kind = int(pick(rng, 0, 7));
  if (kind == 0) p[1][axis] = p[2][axis] = p[0][axis];
  if (kind == 1) {
    for (auto& q : p) {
      for (auto& c : q) c = floor_div(c, kFixedOne) * kFixedOne + pick(rng, -2, 2);
    }
  }
  for (int i = 0; i < 3; ++i) {
    if (kind == 2) p[1][i] = p[0][i];
    if (kind == 3) p[2][i] = 2 * p[1][i] - p[0][i];
    if (kind == 4) p[2][i] = p[1][i] + pick(rng, -3, 3);
  }
  const auto point = [](const std::int64_t* q) { return FixedPoint{q[0], q[1], q[2]}; };
  return {point(p[0]), point(p[1]), point(p[2])};
}

}  // namespace bp::test
