#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/levels/detail/convex_levels.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

using Flat = std::array<double, 2>;

constexpr std::size_t kMostOfOutline = 4096;   // corners
constexpr std::uint64_t kFacesOfTriangle = 8;  // a prism over a triangle has 8 faces
// The least height of a corner of the outline above the line of its neighbours, lattice units: a flatter one would be
// tilted by rounding.
constexpr double kFlat = 8;

/// Two parallel planes that hold a flat scene between them; lattice units.
struct Slab {
  Vec3d origin{}, a{}, b{}, up{};  // a, b, up: of length 1, at right angles
  double low = 0, high = 0;        // heights of the two planes along `up`
  [[nodiscard]] Flat flat(const Vec3d& p) const { return {dot(p - origin, a), dot(p - origin, b)}; }
  [[nodiscard]] Vec3d point(const Flat& p, double height) const { return origin + p[0] * a + p[1] * b + height * up; }
};

/// Returns the point for which f is largest.
template <class F>
Vec3d farthest(std::span<const Vec3d> points, const F& f) {
  return *std::max_element(points.begin(), points.end(), [&](const Vec3d& p, const Vec3d& q) { return f(p) < f(q); });
}

/// Finds the slab of all points from three that lie far apart. Returns nothing if it is thicker than a voxel, or if the
/// points lie on a line.
std::optional<Slab> slab_of(std::span<const Vec3d> points) {
  Slab slab;
  slab.origin = farthest(points, [&](const Vec3d& p) { return length(p - points.front()); });
  const Vec3d along = farthest(points, [&](const Vec3d& p) { return length(p - slab.origin); }) - slab.origin;
  const auto off = [&](const Vec3d& p) { return length(cross(along, p - slab.origin)); };
  const Vec3d normal = cross(along, farthest(points, off) - slab.origin);
  if (!(length(normal) > length(along))) return {};  // all in a line
  slab.a = (1 / length(along)) * along;
  slab.up = (1 / length(normal)) * normal;
  slab.b = cross(slab.up, slab.a);
  for (const Vec3d& p : points) {
    const double height = dot(p - slab.origin, slab.up);
    slab.low = std::min(slab.low, height);
    slab.high = std::max(slab.high, height);
  }
  if (slab.high - slab.low > kLatticePerVoxel) return {};
  return slab;
}

/// Returns twice the signed area of a triangle; above 0: its corners run counterclockwise.
double turn(const Flat& p, const Flat& q, const Flat& r) {
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/// Returns the corners of the convex hull, counterclockwise.
std::vector<Flat> hull_of_flat(std::vector<Flat> points) {
  std::sort(points.begin(), points.end());
  std::vector<Flat> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Flat& p : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// Returns the least height of a corner above the line through its neighbours.
double flattest(const std::vector<Flat>& outline) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Flat &p = outline[i], &r = outline[(i + 2) % outline.size()];
    least = std::min(least, turn(p, outline[(i + 1) % outline.size()], r) / std::hypot(r[0] - p[0], r[1] - p[1]));
  }
  return least;
}

/// Returns the point where the line from p through q meets the line from r to s; nothing if the lines do not meet
/// beyond q and before r.
std::optional<Flat> corner_of(const Flat& p, const Flat& q, const Flat& r, const Flat& s) {
  const Flat d{q[0] - p[0], q[1] - p[1]}, e{s[0] - r[0], s[1] - r[1]};
  const double sine = d[0] * e[1] - d[1] * e[0];
  const double along = ((r[0] - p[0]) * e[1] - (r[1] - p[1]) * e[0]) / sine;
  if (!(sine > 0) || !std::isfinite(along)) return {};
  return Flat{p[0] + along * d[0], p[1] + along * d[1]};
}

/// Reduces the convex outline to at most `most` corners, none of them nearly straight, so that it still encloses the
/// first one. Each step removes an edge and extends its neighbours until they meet; the edge that adds the least area
/// goes first. Returns nothing if no edge can go. Takes O(corners^2).
std::vector<Flat> with_fewer(std::vector<Flat> outline, std::size_t most) {
  while (outline.size() > most || flattest(outline) < 2 * kFlat) {
    const std::size_t n = outline.size();
    std::size_t edge = n;
    Flat corner{};
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < n; ++i) {
      const Flat &q = outline[i], &r = outline[(i + 1) % n];
      const auto found = corner_of(outline[(i + n - 1) % n], q, r, outline[(i + 2) % n]);
      if (!found) continue;
      const double added = turn(q, *found, r);
      if (std::abs(added) < least) least = std::abs(added), edge = i, corner = *found;
    }
    if (edge == n) return {};
    outline[edge] = corner;
    outline.erase(outline.begin() + std::ptrdiff_t((edge + 1) % n));
  }
  return outline;
}

/// Moves every edge outwards by `room`. Returns nothing if a corner is as sharp as a needle, since it would move far.
std::vector<Flat> grown(const std::vector<Flat>& outline, double room) {
  constexpr double kNeedle = 1e-3;  // a corner of 2.6 degrees moves 45 times as far
  const std::size_t n = outline.size();
  const auto outward = [&](std::size_t i) {
    const Flat &p = outline[i % n], &q = outline[(i + 1) % n];
    const double l = std::hypot(q[0] - p[0], q[1] - p[1]);
    return Flat{(q[1] - p[1]) / l, (p[0] - q[0]) / l};
  };
  std::vector<Flat> out(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Flat before = outward(i + n - 1), after = outward(i);
    const double along = 1 + before[0] * after[0] + before[1] * after[1];
    if (!(along > kNeedle)) return {};
    for (std::size_t k = 0; k < 2; ++k) out[i][k] = outline[i][k] + room / along * (before[k] + after[k]);
  }
  return out;
}

LatticeMesh prism(const Slab& slab, const std::vector<Flat>& outline, double room) {
  LatticeMesh mesh;
  const auto n = std::uint32_t(outline.size());
  for (const double height : {slab.low - room, slab.high + room}) {
    for (const Flat& p : outline) mesh.vertices.push_back(rounded(slab.point(p, height)));
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.triangles.push_back({i, j, j + n});
    mesh.triangles.push_back({i, j + n, i + n});
    if (i == 0 || j == 0) continue;
    mesh.triangles.push_back({0, j, i});
    mesh.triangles.push_back({n, i + n, j + n});
  }
  return mesh;
}

/// Returns whether the prism still encloses the slab and the outline after its corners were rounded: both ends lie
/// beyond the slab and are hardly tilted, and the outline lies inside each side's plane.
bool holds(const LatticeMesh& mesh, const Slab& slab, const std::vector<Flat>& outline, double off) {
  const double least = 0.5 + off;  // far more than the rounding of the doubles here
  const std::size_t n = mesh.vertices.size() / 2;
  std::vector<Vec3d> at;
  for (const LatticeCoord& p : mesh.vertices) at.push_back(to_double(p) - slab.origin);
  const auto corner = [&](std::size_t v) { return Flat{dot(at[v], slab.a), dot(at[v], slab.b)}; };
  for (std::size_t v = 0; v < n; ++v) {
    if (dot(at[v], slab.up) > slab.low - least || dot(at[v + n], slab.up) < slab.high + least) return false;
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    for (const std::size_t end : {std::size_t(0), n}) {
      if (flattest({corner(end), corner(end + i), corner(end + i + 1)}) < kFlat) return false;
    }
  }
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    const auto above = std::count_if(t.begin(), t.end(), [&](std::uint32_t v) { return v >= n; });
    if (above == 0 || above == 3) return true;
    const Vec3d p = at[t[0]], normal = cross(at[t[1]] - p, at[t[2]] - p);
    return std::all_of(outline.begin(), outline.end(), [&](const Flat& c) {
      return std::max(dot(slab.point(c, slab.low) - slab.origin - p, normal),
                      dot(slab.point(c, slab.high) - slab.origin - p, normal)) <= -least * length(normal);
    });
  });
}

}  // namespace

std::optional<LodLevel> prism_level(const LodLevel& level, std::span<const Vec3d> corners, double off,
                                    std::uint64_t faces) {
  if (corners.empty()) return {};
  const std::optional<Slab> slab = slab_of(corners);
  if (!slab) return {};
  std::vector<Flat> flat(corners.size());
  std::transform(corners.begin(), corners.end(), flat.begin(), [&](const Vec3d& p) { return slab->flat(p); });
  const std::vector<Flat> hull = hull_of_flat(std::move(flat));
  if (hull.size() < 3 || hull.size() > kMostOfOutline || faces < kFacesOfTriangle) return {};
  const std::vector<Flat> outline = with_fewer(hull, std::size_t((faces + 4) / 4));
  if (outline.empty()) return {};
  for (double step = 2; step <= 8; step *= 2) {
    const double room = step + off;
    const std::vector<Flat> around = grown(outline, room);
    if (around.empty()) return {};
    const LatticeMesh mesh = prism(*slab, around, room);
    if (holds(mesh, *slab, hull, off)) return convex_level(level, mesh);
  }
  return {};
}

}  // namespace bp
