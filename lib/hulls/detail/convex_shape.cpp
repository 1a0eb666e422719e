#include "lib/hulls/detail/convex_shape.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "lib/hulls/detail/convex_steps.h"
#include "lib/mesh/box_tree.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

constexpr double kOfWidth = 0.9;          // of the width of a plate, whose own sides are as narrow as that
constexpr std::size_t kSliverSteps = 16;  // steps next to slivers that are tried; the best is taken
constexpr double kNegligible = 1e-9;      // rounding of shares

using Corners = std::array<LatticeCoord, 3>;

Corners corners_of(const ConvexHull& hull, std::size_t f) {
  const auto& t = hull.triangles[f];
  return {hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]]};
}

/// The least angle and the shortest edge.
struct Narrowness {
  double angle, edge;
};

Narrowness narrowness_of(const Corners& c) {
  std::array<double, 3> edges{};
  for (std::size_t k = 0; k < 3; ++k) edges[k] = length(to_double(c[(k + 1) % 3] - c[k]));
  std::sort(edges.begin(), edges.end());
  const double area2 = length(to_double(normal_of(c[0], c[1], c[2])));
  return {std::asin(std::min(1.0, area2 / (edges[1] * edges[2]))), edges[0]};
}

/// Returns the width: the least over its faces of how far the hull reaches below them.
double width_of(const ConvexHull& hull) {
  double least = HUGE_VAL;
  for (std::size_t f = 0; f < hull.triangles.size(); ++f) {
    const Corners c = corners_of(hull, f);
    const Vec3d n = to_double(normal_of(c[0], c[1], c[2]));
    double deep = 0;
    for (const LatticeCoord& v : hull.vertices) deep = std::max(deep, dot(n, to_double(c[0] - v)));
    least = std::min(least, deep / length(n));
  }
  return least;
}

/// The bounds for the faces of one hull.
class Bounds {
 public:
  explicit Bounds(const ConvexHull& hull) {
    const LatticeBox box = box_of(hull.vertices);
    const double diagonal = length(to_double(box.max - box.min));
    const double slim = kOfWidth * width_of(hull) / diagonal;
    angle_ = std::min(kSliverAngle, slim);
    edge_ = std::min(kSliverEdge, slim) * diagonal;
  }
  [[nodiscard]] double lack_of(const Corners& c) const {
    const Narrowness n = narrowness_of(c);
    return std::max(0.0, 1 - n.angle / angle_) + std::max(0.0, 1 - n.edge / edge_);
  }

 private:
  double angle_, edge_;
};

double slivers_of(const ConvexHull& hull, const Bounds& bounds) {
  double sum = 0;
  for (std::size_t f = 0; f < hull.triangles.size(); ++f) sum += bounds.lack_of(corners_of(hull, f));
  return sum;
}

/// Returns, for each corner, whether it has a face below the bounds.
std::vector<char> near_slivers(const ConvexHull& hull, const Bounds& bounds) {
  std::vector<char> bad(hull.vertices.size(), 0);
  for (std::size_t f = 0; f < hull.triangles.size(); ++f) {
    if (bounds.lack_of(corners_of(hull, f)) <= kNegligible) continue;
    for (const std::uint32_t v : hull.triangles[f]) bad[v] = 1;
  }
  return bad;
}

/// Returns the step next to a sliver with the best ratio of slivers removed to volume added. If none removes a sliver,
/// it is the first step that takes a corner.
std::optional<ConvexHull> best_step(const ConvexHull& hull, const LatticeBox& room, const Bounds& bounds,
                                    double slivers) {
  const std::vector<char> near = near_slivers(hull, bounds);
  std::optional<ConvexHull> best, any;
  double least = HUGE_VAL;
  std::size_t tried = 0;
  for (const HullStep& step : HullSteps(hull, room).all()) {
    if (near[step.a] == 0 && near[step.b] == 0) continue;
    ConvexHull next = with_point(hull, step.point);
    if (next.vertices.size() >= hull.vertices.size()) continue;
    draw_diagonals(next);
    const double left = slivers_of(next);
    const double price = (step.cost6 + 1) / std::max(slivers - left, kNegligible);
    if (left < slivers && price < least) least = price, best = next;
    if (!any) any = std::move(next);
    if (++tried >= kSliverSteps) break;
  }
  return best ? best : any;
}

/// The faces on both sides of each edge.
using Edges = std::map<std::array<std::uint32_t, 2>, std::size_t>;

void add_edges(const ConvexHull& hull, std::size_t f, Edges& edges) {
  const auto& t = hull.triangles[f];
  for (std::size_t k = 0; k < 3; ++k) edges[{t[k], t[(k + 1) % 3]}] = f;
}

/// Returns the corner of a face that is neither a nor b.
std::uint32_t apex_of(const std::array<std::uint32_t, 3>& t, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t v : t) {
    if (v != a && v != b) return v;
  }
  return t[0];
}

/// Turns the edge from a to b if its faces f and g lie in a plane and the other diagonal has the larger least angle.
bool turn(ConvexHull& hull, std::uint32_t a, std::uint32_t b, std::size_t f, std::size_t g) {
  const std::uint32_t c = apex_of(hull.triangles[f], a, b), d = apex_of(hull.triangles[g], a, b);
  const auto& v = hull.vertices;
  const LatticeCoord normal = normal_of(v[a], v[b], v[c]);
  if (side_along(normal, v[d] - v[a]) != 0) return false;
  const auto least = [&](const Corners& x, const Corners& y) {
    return std::min(narrowness_of(x).angle, narrowness_of(y).angle);
  };
  const auto outward = [&](const Corners& x) {  // else the other diagonal lies outside of the facet, or on its border
    const LatticeCoord n = normal_of(x[0], x[1], x[2]);
    return side_along(normal, n) > 0;
  };
  const Corners x{v[c], v[d], v[b]}, y{v[d], v[c], v[a]};
  if (!outward(x) || !outward(y)) return false;
  if (least(x, y) <= least({v[a], v[b], v[c]}, {v[b], v[a], v[d]}) * (1 + 1e-9)) return false;
  hull.triangles[f] = {c, d, b};
  hull.triangles[g] = {d, c, a};
  return true;
}

}  // namespace

ConvexHull simple_hull_around(const ConvexHull& hull, std::size_t corners) {
  const LatticeBox box = box_of(hull.vertices);
  const LatticeCoord size = box.max - box.min;
  std::vector<LatticeCoord> points;
  if (corners < 8) {  // its slanted side goes through box.max
    points = {box.min, box.min, box.min, box.min};
    for (int i = 0; i < 3; ++i) points[std::size_t(i) + 1][i] += 3 * size[i];
  } else {
    for (int i = 0; i < 8; ++i) {
      points.push_back(box.min);
      for (int k = 0; k < 3; ++k) points.back()[k] += (i >> k & 1) * size[k];
    }
  }
  ConvexHull made = *hull_of(points);
  draw_diagonals(made);
  return made;
}

double slivers_of(const ConvexHull& hull) {
  const double sum = slivers_of(hull, Bounds(hull));
  return sum > kNegligible ? sum : 0;
}

void draw_diagonals(ConvexHull& hull) {
  Edges edges;
  for (std::size_t f = 0; f < hull.triangles.size(); ++f) add_edges(hull, f, edges);
  std::vector<std::array<std::uint32_t, 2>> open;
  for (const auto& [edge, f] : edges) {
    if (edge[0] < edge[1]) open.push_back(edge);
  }
  for (std::size_t turns = 0; !open.empty() && turns < 4 * hull.triangles.size() * hull.triangles.size(); ++turns) {
    const auto [a, b] = open.back();
    open.pop_back();
    const auto one = edges.find({a, b}), two = edges.find({b, a});
    if (one == edges.end() || two == edges.end()) continue;
    const std::size_t f = one->second, g = two->second;
    if (!turn(hull, a, b, f, g)) continue;
    edges.erase(one);
    edges.erase(two);
    for (const std::size_t face : {f, g}) {
      add_edges(hull, face, edges);
      const auto& t = hull.triangles[face];
      for (std::size_t k = 0; k < 3; ++k) open.push_back({t[k], t[(k + 1) % 3]});
    }
  }
}

ConvexHull without_slivers(ConvexHull hull) {
  const LatticeBox room = room_around(hull, kNearBox);
  return without_slivers(std::move(hull), room);
}

ConvexHull without_slivers(ConvexHull hull, const LatticeBox& room) {
  constexpr double kMuchMore = 2;  // times the volume: beyond that, slivers are better
  draw_diagonals(hull);
  const ConvexHull before = hull;
  const auto unless_much_more = [&](ConvexHull made) {
    return volume6_of(made) <= kMuchMore * volume6_of(before) ? std::move(made) : before;
  };
  for (;;) {
    const Bounds bounds(hull);
    const double slivers = slivers_of(hull, bounds);
    if (slivers <= kNegligible) return unless_much_more(std::move(hull));
    std::optional<ConvexHull> next = best_step(hull, room, bounds, slivers);
    if (!next) break;
    hull = std::move(*next);
  }
  ConvexHull box = simple_hull_around(hull, 8);
  const bool is_box =
      box.vertices.size() <= before.vertices.size() && volume6_of(box) <= kMuchMore * volume6_of(before);
  return is_box ? box : unless_much_more(std::move(hull));
}

}  // namespace bp
