#include "lib/hulls/convex_budget.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/core/parallel.h"
#include "lib/hulls/detail/convex_shape.h"
#include "lib/hulls/detail/convex_simplify.h"
#include "lib/hulls/detail/convex_steps.h"
#include "lib/hulls/detail/convex_tighten.h"

namespace bp {

namespace {

constexpr std::size_t kFewestOfBulk = 8;  // corners
constexpr double kNextToNothing = 0.001;  // of the volume, for fewer corners
constexpr std::size_t kTried = 6;         // steps of a hull that are tried; the cheapest for a corner is taken

/// A hull with fewer corners around another one.
struct Next {
  std::optional<ConvexHull> hull;
  double price = HUGE_VAL;  // volume for a corner
};

/// Returns the next hull. `leaves`: it may leave the room if there is no other way.
Next next_of(const ConvexHull& hull, const LatticeBox& room, bool leaves) {
  Next next;
  if (hull.vertices.size() <= 4) return next;
  std::optional<ConvexHull> rough;  // the cheapest one with a sliver
  const double volume6 = volume6_of(hull), slivers = slivers_of(hull);
  const auto price_of = [&](const ConvexHull& made) {
    return (volume6_of(made) - volume6) / double(hull.vertices.size() - made.vertices.size());
  };
  std::size_t tried = 0;
  for (const HullStep& step : HullSteps(hull, room).all()) {
    if (next.hull && (tried++ >= kTried || step.cost6 / 2 > next.price)) break;
    ConvexHull made = with_point(hull, step.point);
    if (made.vertices.size() >= hull.vertices.size()) continue;
    draw_diagonals(made);
    if (slivers_of(made) > slivers) {
      if (!rough) rough = std::move(made);
      continue;
    }
    const double price = price_of(made);
    if (price < next.price) next = {std::move(made), price};
  }
  if (next.hull) return next;
  if (!rough) rough = simple_hull_around(hull, hull.vertices.size() - 1);
  if (!leaves && !room.holds(box_of(rough->vertices))) return next;
  ConvexHull made = without_slivers(*rough, room);
  if (made.vertices.size() >= hull.vertices.size()) made = std::move(*rough);
  return {made, price_of(made)};
}

}  // namespace

std::uint64_t face_count(const std::vector<ConvexHull>& hulls) {
  std::uint64_t sum = 0;
  for (const ConvexHull& hull : hulls) sum += hull.triangles.size();
  return sum;
}

void keep_to_faces(std::vector<ConvexHull>& hulls, std::uint64_t faces, double share) {
  std::uint64_t left = face_count(hulls);
  if (left <= faces) return;
  std::vector<LatticeBox> rooms;
  for (const ConvexHull& hull : hulls) rooms.push_back(room_around(hull, share));
  std::vector<Next> next(hulls.size());
  const auto find_next = [&](std::size_t i) { next[i] = next_of(hulls[i], rooms[i], share >= kFarOut); };
  parallel_for(std::int64_t(hulls.size()), [&](std::int64_t i) { find_next(std::size_t(i)); });
  while (left > faces) {
    const auto cheapest =
        std::min_element(next.begin(), next.end(), [](const Next& x, const Next& y) { return x.price < y.price; });
    if (cheapest == next.end() || !cheapest->hull) return;
    const auto i = std::size_t(cheapest - next.begin());
    ConvexHull& hull = hulls[i];
    left -= hull.triangles.size() - cheapest->hull->triangles.size();
    hull = std::move(*cheapest->hull);
    find_next(i);
  }
}

ConvexHull with_fewer_faces(const ConvexHull& hull, std::uint64_t faces) {
  const std::size_t most = std::size_t(faces) / 2 + 2;  // corners
  std::vector<ConvexHull> fewer{with_fewer_corners(hull, std::max(most, kFewestOfBulk), kNextToNothing)};
  fewer[0] = without_slivers(std::move(fewer[0]));
  keep_to_faces(fewer, faces, kNearBox);
  keep_to_faces(fewer, faces, kFarOut);
  return tightened(std::move(fewer[0]), hull.vertices);
}

}  // namespace bp
