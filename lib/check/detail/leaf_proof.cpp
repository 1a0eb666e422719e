#include "lib/check/detail/leaf_proof.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lib/core/vec3.h"

// A leaf's triangle lies within the error of a convex part if its corners do. In the plane of the part it is grown by
// 3/2 errors, by lines along its edges and across its sharp corners, so that neighbours with rounded corners leave no
// gap. A point between these lines is nowhere farther than 1.5 * sqrt(2) errors from it, and 2.4 in space.

namespace bp {

namespace {

using Flat = std::array<double, 2>;
using Polygon = std::vector<Flat>;
using FlatTriangle = std::array<Flat, 3>;

constexpr std::size_t kMostPieces = 200;
constexpr int kMostDeep = 12;     // depth of halving
constexpr double kGrowth = 1.5;   // errors
constexpr double kThinReach = 3;  // errors

double dot(const Flat& a, const Flat& b) {
  return a[0] * b[0] + a[1] * b[1];
}
Flat minus(const Flat& a, const Flat& b) {
  return {a[0] - b[0], a[1] - b[1]};
}
Flat unit(const Flat& a) {
  const double l = std::hypot(a[0], a[1]);
  return {a[0] / l, a[1] / l};
}

/// A half-plane: the points p with normal · p <= most.
struct HalfPlane {
  Flat normal;
  double most;
  [[nodiscard]] double beyond(const Flat& p) const { return dot(normal, p) - most; }
};

/// Coordinates in the plane of a polygon.
class Plane {
 public:
  explicit Plane(const std::vector<Vec3d>& polygon) : from_(polygon[0]) {
    Vec3d n{}, longest{};
    for (std::size_t k = 1; k < polygon.size(); ++k) {
      const Vec3d side = polygon[k] - from_;
      if (bp::dot(side, side) > bp::dot(longest, longest)) longest = side;
      n = n + cross(side, polygon[(k + 1) % polygon.size()] - from_);
    }
    u_ = (1 / length(longest)) * longest;
    v_ = cross((1 / length(n)) * n, u_);
  }
  [[nodiscard]] Flat operator()(const Vec3d& p) const { return {bp::dot(p - from_, u_), bp::dot(p - from_, v_)}; }

 private:
  Vec3d from_, u_, v_;
};

constexpr double kLine = 1e-12;  // relative to a square: a smaller area counts as none

double doubled_area(const FlatTriangle& t) {
  const Flat a = minus(t[1], t[0]), b = minus(t[2], t[0]);
  return a[0] * b[1] - a[1] * b[0];
}

/// Returns whether the triangle is seen from behind, not only by the rounding of a thin triangle.
bool is_turned_over(const FlatTriangle& t, double error) {
  double around = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Flat side = minus(t[(k + 1) % 3], t[k]);
    around += std::hypot(side[0], side[1]);
  }
  return -doubled_area(t) / 2 > error * around;
}

/// Returns the half-planes whose common part a triangle covers; none if the triangle is a line there.
std::vector<HalfPlane> sides_of(FlatTriangle t, double growth) {
  const Flat a = minus(t[1], t[0]), b = minus(t[2], t[0]);
  const double area = doubled_area(t);
  if (!(std::abs(area) > kLine * std::max(dot(a, a), dot(b, b)))) return {};
  if (area < 0) std::swap(t[1], t[2]);
  std::vector<HalfPlane> sides;
  for (std::size_t k = 0; k < 3; ++k) {
    const Flat along = unit(minus(t[(k + 1) % 3], t[k])), outwards{along[1], -along[0]};
    sides.push_back({outwards, dot(outwards, t[k]) + growth});
    const Flat back = unit(minus(t[k], t[(k + 2) % 3]));
    if (dot(along, back) >= 0) continue;  // a blunt corner
    const Flat tip = unit(minus(back, along));
    sides.push_back({tip, dot(tip, t[k]) + growth});
  }
  return sides;
}

/// Returns the part of a convex polygon on one side of a line, or strictly on the other side.
Polygon cut(const Polygon& polygon, const HalfPlane& side, bool inside) {
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Flat &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double hp = side.beyond(p), hq = side.beyond(q);
    if ((hp <= 0) == inside) kept.push_back(p);
    if ((hp <= 0) == (hq <= 0)) continue;
    const double s = hp / (hp - hq);
    kept.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])});
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

/// Removes the area between the sides from a polygon; the rest goes to `rest`, in pieces.
void take_out(const std::vector<HalfPlane>& sides, const Polygon& polygon, std::vector<Polygon>& rest) {
  std::vector<Polygon> pieces;
  Polygon within = polygon;
  for (const HalfPlane& side : sides) {
    if (Polygon beyond = cut(within, side, false); !beyond.empty()) pieces.push_back(std::move(beyond));
    within = cut(within, side, true);
    if (within.empty()) return rest.push_back(polygon);
  }
  for (Polygon& piece : pieces) rest.push_back(std::move(piece));
}

using Cover = LeafProof::Cover;

Cover cover_at_once(const Polygon& polygon, const std::vector<FlatTriangle>& covers, double growth) {
  std::vector<Polygon> left{polygon}, rest;
  for (const FlatTriangle& t : covers) {
    const std::vector<HalfPlane> sides = sides_of(t, growth);
    if (sides.empty()) continue;
    rest.clear();
    for (const Polygon& piece : left) take_out(sides, piece, rest);
    left.swap(rest);
    if (left.empty()) return Cover::whole;
    if (left.size() > kMostPieces) return Cover::undecided;
  }
  return Cover::missing;
}

/// Covers a polygon; if that takes too many pieces, each half of it.
Cover cover(const Polygon& polygon, const std::vector<FlatTriangle>& covers, double growth, int depth) {
  const Cover at_once = cover_at_once(polygon, covers, growth);
  if (at_once != Cover::undecided || depth == kMostDeep) return at_once;
  const auto range = [](const auto& points, std::size_t axis) {
    std::array<double, 2> r{HUGE_VAL, -HUGE_VAL};
    for (const Flat& p : points) r = {std::min(r[0], p[axis]), std::max(r[1], p[axis])};
    return r;
  };
  const auto x = range(polygon, 0), y = range(polygon, 1);
  const std::size_t axis = x[1] - x[0] >= y[1] - y[0] ? 0 : 1;
  const double at = axis == 0 ? x[0] + (x[1] - x[0]) / 2 : y[0] + (y[1] - y[0]) / 2;
  for (const bool low : {true, false}) {
    const Polygon half = cut(polygon, {{double(axis == 0), double(axis == 1)}, at}, low);
    if (half.empty()) continue;
    std::vector<FlatTriangle> some;
    for (const FlatTriangle& t : covers) {
      const auto r = range(t, axis);
      if (low ? r[0] <= at + 2 * growth : r[1] >= at - 2 * growth) some.push_back(t);
    }
    if (const Cover found = cover(half, some, growth, depth + 1); found != Cover::whole) return found;
  }
  return Cover::whole;
}

struct Size {
  double area = 0, around = 0;
};
Size size_of(const std::vector<Vec3d>& part) {
  Size size;
  for (std::size_t k = 0; k < part.size(); ++k) {
    const Vec3d u = part[k] - part[0], v = part[(k + 1) % part.size()] - part[0];
    size.area += length(cross(u, v)) / 2;
    size.around += length(v - u);
  }
  return size;
}

Bounds3d bounds_around(const std::vector<Vec3d>& part, double by) {
  Bounds3d box;
  for (const Vec3d& p : part) box.add(p);
  for (std::size_t i = 0; i < 3; ++i) box.min[i] -= by, box.max[i] += by;
  return box;
}

/// Returns whether all of the part lies along one face of the cell: it may be the edge of a triangle that the neighbour
/// shows.
bool is_along_face(const std::vector<Vec3d>& part, const Bounds3d& cell, double within) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (const double at : {cell.min[i], cell.max[i]}) {
      if (std::all_of(part.begin(), part.end(), [&](const Vec3d& p) { return std::abs(p[i] - at) <= within; }))
        return true;
    }
  }
  return false;
}

/// Returns whether its corners may lie on a line once each moves by `error`. Then all are within two errors of the line
/// through the two that are farthest apart.
bool may_be_line(const std::vector<Vec3d>& part, double error) {
  Vec3d from = part[0], along{};
  for (const Vec3d& p : part) {
    for (const Vec3d& q : part) {
      if (bp::dot(q - p, q - p) > bp::dot(along, along)) from = p, along = q - p;
    }
  }
  const double most = 2 * error * length(along);
  return std::all_of(part.begin(), part.end(), [&](const Vec3d& p) { return length(cross(p - from, along)) <= most; });
}

}  // namespace

std::vector<Vec3d> part_within(const TriangleD& t, const Bounds3d& box) {
  std::vector<Vec3d> polygon(t.begin(), t.end());
  for (std::size_t face = 0; face < 6; ++face) {
    const std::size_t i = face / 2;
    const double at = face % 2 == 0 ? box.min[i] : box.max[i];
    const auto is_in = [&](const Vec3d& p) { return face % 2 == 0 ? p[i] >= at : p[i] <= at; };
    std::vector<Vec3d> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
      if (is_in(p)) kept.push_back(p);
      if (is_in(p) == is_in(q)) continue;
      kept.push_back(p + ((at - p[i]) / (q[i] - p[i])) * (q - p));
      kept.back()[i] = at;
    }
    polygon = std::move(kept);
  }
  if (polygon.size() < 3) polygon.clear();
  return polygon;
}

/// Returns the triangles near a part, the largest first: they leave the fewest pieces.
std::vector<const TriangleBvh::Item*> LeafProof::near(const std::vector<Vec3d>& part, double error) const {
  const Bounds3d box = bounds_around(part, error);
  const auto is_near = [&](const Vec3d& p) {
    for (std::size_t k = 1; k + 1 < part.size(); ++k)
      if (distance_squared(p, TriangleD{part[0], part[k], part[k + 1]}) <= error * error) return true;
    return false;
  };
  std::vector<const TriangleBvh::Item*> found;
  shown_.visit(box, [&](const TriangleBvh::Item& item) {
    const TriangleD& t = item.corners;
    const bool in_box = std::all_of(t.begin(), t.end(), [&](const Vec3d& p) { return overlap(box, Bounds3d{p, p}); });
    if (in_box && std::all_of(t.begin(), t.end(), is_near)) found.push_back(&item);
    return false;
  });
  std::sort(found.begin(), found.end(), [](const auto* a, const auto* b) {
    const double x = area_of(a->corners), y = area_of(b->corners);
    return x != y ? x > y : a->id < b->id;
  });
  return found;
}

LeafProof::Cover LeafProof::add_thin(const std::vector<Vec3d>& part, double error) {
  for (const TriangleBvh::Item* item : near(part, error)) on_scene_[item->id] = true;
  const double most = kThinReach * error;
  const bool by_one = shown_.visit(bounds_around(part, most), [&](const TriangleBvh::Item& item) {
    return std::all_of(part.begin(), part.end(),
                       [&](const Vec3d& p) { return distance_squared(p, item.corners) <= most * most; });
  });
  if (by_one) return Cover::whole;
  const auto is_shown = [&](const Vec3d& p) {
    return !shown_.empty() && shown_.near_enough(p, most * most, 0).distance_squared <= most * most;
  };
  if (is_along_face(part, cell_, most) || std::all_of(part.begin(), part.end(), is_shown)) return Cover::thin;
  return may_be_line(part, std::min(error, flat_)) ? Cover::flat : Cover::undecided;
}

LeafProof::Cover LeafProof::add(const std::vector<Vec3d>& part, double error) {
  const Size size = size_of(part);
  if (size.area <= error * size.around) {
    const Cover cover = add_thin(part, error);
    return size.area > kLine * size.around * size.around ? cover : Cover::whole;
  }
  const Plane plane(part);
  std::vector<FlatTriangle> covers;
  for (const TriangleBvh::Item* item : near(part, error)) {
    const TriangleD& t = item->corners;
    const FlatTriangle flat{plane(t[0]), plane(t[1]), plane(t[2])};
    if (is_turned_over(flat, error)) continue;
    on_scene_[item->id] = true;
    covers.push_back(flat);
  }
  Polygon polygon;
  for (const Vec3d& p : part) polygon.push_back(plane(p));
  return cover(polygon, covers, kGrowth * error, 0);
}

std::uint64_t LeafProof::strays() const {
  return std::uint64_t(std::count(on_scene_.begin(), on_scene_.end(), false));
}

}  // namespace bp
