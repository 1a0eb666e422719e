// One point of the surface proves a part of a triangle near if all corners of the part are near enough to it. One
// triangle does, too: the distance to a convex set is convex, so its largest value over the part is at a corner. Points
// suffice for parts smaller than the limit. Where the triangles of the surface are larger, the piece over one of them
// is cut out of the part, and the rest goes on. Halving alone would have to go down to the limit along all of their
// edges.
#include "lib/geometry/near_surface.h"

#include <cmath>

#include "lib/core/vec3.h"
#include "lib/geometry/triangle_parts.h"

namespace bp {

namespace {

constexpr double kSearchBelow = 0.25;     // of the limit: larger parts are halved before any search
constexpr double kLeastPart = 1.0 / 128;  // of the limit
constexpr int kMostParts = 4096;
constexpr double kMargin = 0.5;      // of the limit: a point so far beside a triangle still counts as over it
constexpr double kWorthwhile = 0.5;  // of the part's area: smaller pieces are not cut out

/// A limit may itself be the root of a squared distance, and its square need not be as large as that.
bool exceeds(double squared, double limit) {
  return squared > limit * limit && std::sqrt(squared) > limit;
}

bool is_beside(const TriangleD& part, const TriangleD& one, double limit) {
  for (const Vec3d& p : part) {
    if (exceeds(distance_squared(p, one), limit)) return false;
  }
  return true;
}

}  // namespace

NearSurface::NearSurface(const TriangleBvh& to, double place, std::size_t places)
    : to_(to), places_per_unit_(1 / place), places_(places) {}

double NearSurface::distance(const Vec3d& p, double enough) {
  const Place& place = place_at(p);
  if (!exceeds(length_squared(p, place.point), enough)) return enough;
  return std::sqrt(to_.near_enough(p, enough > 0 ? enough * enough : -1, place.item).distance_squared);
}

bool NearSurface::holds(const TriangleD& t, double limit) {
  for (const Vec3d& p : t) {
    if (distance(p, limit) > limit) return false;
  }
  open_.assign(1, t);
  for (int parts = 0; !open_.empty(); ++parts) {
    const TriangleD part = open_.back();
    open_.pop_back();
    const Answer answer = examine(part, limit);
    if (answer == Answer::no || (answer == Answer::open && parts >= kMostParts)) return false;
  }
  return true;
}

/// Tries to prove the part near. If it fails, it leaves pieces of the part in open_.
NearSurface::Answer NearSurface::examine(const TriangleD& part, double limit) {
  const Vec3d c = centre_of(part);
  const Place& place = place_at(c);
  if (!exceeds(radius_squared(part, place.point), limit)) return Answer::yes;
  const double radius = std::sqrt(radius_squared(part, c));
  std::uint32_t item = place.item;
  // The triangle of the surface is large.
  const bool large = area_of(to_.item(item).corners) >= kWorthwhile * area_of(part);
  if (radius < limit || large) {
    if (is_beside(part, to_.item(item).corners, limit)) return Answer::yes;
    const bool far = exceeds(distance_squared(c, to_.item(item).corners), limit);
    if (radius < kSearchBelow * limit || (large && far)) {
      const double enough = limit - radius;
      const TriangleBvh::Nearest found = to_.near_enough(c, enough > 0 ? enough * enough : -1, item);
      const double d = std::sqrt(found.distance_squared);
      if (d > limit) return Answer::no;
      if (d + radius <= limit) return Answer::yes;
      if (found.item != item && is_beside(part, to_.item(found.item).corners, limit)) return Answer::yes;
      if (radius < kLeastPart * limit) return is_beside_any(part, found.item, limit) ? Answer::yes : Answer::no;
      item = found.item;
    }
  }
  if (large && cut_out(part, to_.item(item).corners, limit)) return Answer::open;
  for (const TriangleD& half : halves(part)) open_.push_back(half);
  return Answer::open;
}

/// Makes the last try, by the triangles nearest to the corners: the limit may be the very distance of one.
bool NearSurface::is_beside_any(const TriangleD& part, std::uint32_t guess, double limit) const {
  for (const Vec3d& p : part) {
    if (is_beside(part, to_.item(to_.nearest(p, guess).item).corners, limit)) return true;
  }
  return false;
}

/// Cuts out the piece over `nearest`, or a little beside it, if the triangle proves it near and it is large enough. The
/// rest goes to open_. Returns whether it did.
bool NearSurface::cut_out(const TriangleD& part, const TriangleD& nearest, double limit) {
  const std::size_t before = open_.size();
  const Vec3d normal = cross(nearest[1] - nearest[0], nearest[2] - nearest[0]);
  Polygon inside(part);
  for (std::size_t k = 0; k < 3 && inside.count > 0; ++k) {
    const Vec3d inwards = cross(normal, nearest[(k + 1) % 3] - nearest[k]);
    const CutPolygon pieces = cut(inside, nearest[k], inwards, kMargin * limit * length(inwards));
    inside = pieces.inside;
    for (std::size_t i = 0; i < pieces.outside.triangles(); ++i) open_.push_back(pieces.outside.triangle(i));
  }
  bool settled = inside.area() >= kWorthwhile * area_of(part);
  for (std::size_t i = 0; i < inside.count && settled; ++i)
    settled = !exceeds(distance_squared(inside.corners[i], nearest), limit);
  if (!settled) open_.resize(before);
  return settled;
}

const NearSurface::Place& NearSurface::place_at(const Vec3d& p) {
  std::array<double, 3> at;
  std::uint64_t h = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    at[i] = std::floor(p[i] * places_per_unit_);
    h = (h ^ std::uint64_t(std::int64_t(at[i]))) * 0x9e3779b97f4a7c15u;
    h ^= h >> 32;
  }
  Place& place = places_[h % places_.size()];
  const std::uint32_t mark = std::uint32_t(h >> 32) | 1u;
  if (place.mark != mark) {
    Vec3d centre;
    for (std::size_t i = 0; i < 3; ++i) centre[i] = (at[i] + 0.5) / places_per_unit_;
    last_ = to_.nearest(centre, last_).item;
    place = {mark, last_, nearest_point(centre, to_.item(last_).corners)};
  }
  return place;
}

}  // namespace bp
