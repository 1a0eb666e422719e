#include <algorithm>

#include "lib/core/vec3.h"
#include "lib/enclosed/enclosed_triangles.h"
#include "lib/exact/triangle_intersection.h"
#include "lib/geometry/triangle_bvh.h"
#include "tests/catch.h"
#include "tests/support/random_lattice.h"

using namespace bp;
using bp::test::RandomLattice;

namespace {

/// The definition: the new faces meet no triangle (segments and points included), and no closed tetrahedron of positive
/// volume holds a first corner.
bool allowed(const std::vector<TriangleD>& triangles, const GridFrame& frame, const std::vector<NewFace>& star,
             const std::vector<Tetrahedron>& swept) {
  for (const TriangleD& t : triangles) {
    for (const NewFace& f : star) {
      const std::array<Vec3d, 3> face = {frame.world(f.corners[0]), frame.world(f.corners[1]),
                                         frame.world(f.corners[2])};
      if (collinear(t[0], t[1], t[2]) ? degenerate_triangle_meets(t.data(), face.data())
                                      : triangles_intersect(t.data(), face.data()))
        return false;
    }
    for (const Tetrahedron& s : swept) {
      const Vec3d a = frame.world(s[0]), b = frame.world(s[1]), c = frame.world(s[2]), d = frame.world(s[3]);
      const int turn = orient3d(a, b, c, d);
      const auto inside = [&](int side) { return side == 0 || side == turn; };
      if (turn != 0 && inside(orient3d(a, b, c, t[0])) && inside(orient3d(a, d, b, t[0])) &&
          inside(orient3d(b, d, c, t[0])) && inside(orient3d(c, d, a, t[0])))
        return false;
    }
  }
  return true;
}

/// Where edges of one triangle pass through the other one, about.
std::vector<Vec3d> crossings(const TriangleD& a, const TriangleD& b) {
  std::vector<Vec3d> all;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &p = a[k], &q = a[(k + 1) % 3];
    if (!segment_meets_triangle(p, q, b.data())) continue;
    const Vec3d n = cross(b[1] - b[0], b[2] - b[0]);
    const double from = dot(n, p - b[0]), to = dot(n, q - b[0]);
    if (from != to) all.push_back(p + from / (from - to) * (q - p));
  }
  return all;
}

bool is_in(const Vec3d& p, double half_edge) {
  return std::all_of(p.begin(), p.end(), [&](double x) { return std::abs(x) < half_edge; });
}

}  // namespace

TEST_CASE("of triangles of which a part is enclosed, faces may cut the rest", "[quick][meshing]") {
  GridFrame frame;
  frame.voxel = 64;  // a lattice unit is a unit
  RandomLattice random(3);
  const Bounds3d box{{-20, -20, -20}, {20, 20, 20}};
  int inside = 0, outside = 0;
  for (int i = 0; i < 4000; ++i) {
    TriangleD t;
    NewFace face{{0, 1, 2}, {random.point(-60, 60), random.point(-60, 60), random.point(-60, 60)}};
    for (Vec3d& p : t) p = to_double(random.point(-60, 60));
    TriangleD world;
    for (std::size_t k = 0; k < 3; ++k) world[k] = to_double(face.corners[k]);
    std::vector<Vec3d> common = crossings(t, world);
    for (const Vec3d& p : crossings(world, t)) common.push_back(p);
    if (common.size() != 2) continue;
    const EnclosedTriangles part({t}, frame, box), whole({t}, frame);
    CHECK_FALSE(whole.allows(std::span(&face, 1), {}, nullptr));
    bool meets = false, near = false;  // the box, by points of the common segment
    for (int n = 0; n <= 64; ++n) {
      const Vec3d p = common[0] + n / 64.0 * (common[1] - common[0]);
      meets = meets || is_in(p, 20);
      near = near || is_in(p, 23);
    }
    if (meets) CHECK_FALSE(part.allows(std::span(&face, 1), {}, nullptr));
    if (!near) CHECK(part.allows(std::span(&face, 1), {}, nullptr));
    inside += meets;
    outside += !near;
  }
  CHECK(inside > 50);
  CHECK(outside > 50);
}

TEST_CASE("a part of a triangle stays out of what is swept, wherever the rest of it lies", "[quick][meshing]") {
  GridFrame frame;
  frame.voxel = 64;
  const EnclosedTriangles part({{Vec3d{-90, 1, 0}, {90, 1, 0}, {0, 90, 1}}}, frame, Bounds3d{{-5, -5, -5}, {5, 5, 5}});
  const auto swept_at = [](std::int64_t x, std::int64_t size) {  // (a, b, c, q): the face abc with q on its inner side
    return Tetrahedron{{{x - size, -size, -size}, {x + size, -size, -size}, {x, size, 0}, {x, 0, size}}};
  };
  const Tetrahedron around = swept_at(0, 40), beside = swept_at(60, 20);
  CHECK_FALSE(part.allows({}, std::span(&around, 1), nullptr));
  CHECK(part.allows({}, std::span(&beside, 1), nullptr));
  const LatticeBox all{{-1000, -1000, -1000}, {1000, 1000, 1000}};
  const std::vector<Vec3d> points = part.contact_points({}, all);
  CHECK(points.size() >= 3);
  for (const Vec3d& p : points) CHECK(is_in(p, 5.001));
}

TEST_CASE("no triangle with a part in the box leaves nothing to enclose", "[quick][meshing]") {
  GridFrame frame;
  frame.voxel = 64;
  const EnclosedTriangles none({{Vec3d{9, 9, 9}, {20, 9, 9}, {9, 20, 9}}}, frame, Bounds3d{{0, 0, 0}, {5, 5, 5}});
  const NewFace face{{0, 1, 2}, {{{-50, -50, 1}, {50, -50, 1}, {0, 80, 20}}}};
  CHECK(none.allows(std::span(&face, 1), {}, nullptr));
  CHECK(none.contact_points({}, LatticeBox{{-100, -100, -100}, {100, 100, 100}}).empty());
}

TEST_CASE("the contact points of a part of the scene are those of the whole that lie there", "[quick][meshing]") {
  RandomLattice random(11);
  GridFrame frame;
  frame.voxel = 0.375;
  frame.origin = {-3, 1000, 17};
  std::vector<TriangleD> triangles;
  for (int i = 0; i < 300; ++i) {
    const LatticeCoord p = random.point(0, 4000);
    triangles.push_back(
        {frame.world(p), frame.world(p + random.point(-50, 50)), frame.world(p + random.point(-50, 50))});
  }
  const EnclosedTriangles enclosed(triangles, frame);
  const LatticeBox all{{-100000, -100000, -100000}, {100000, 100000, 100000}},
      part{{0, -100000, -100000}, {2000, 100000, 100000}};
  std::vector<Vec3d> there = enclosed.contact_points({}, all), found = enclosed.contact_points({}, part);
  std::erase_if(there, [&](const Vec3d& v) { return !part.holds({rounded(v), rounded(v)}); });
  std::sort(there.begin(), there.end());
  std::sort(found.begin(), found.end());
  CHECK(there.size() > 50);
  CHECK(found == there);
}

TEST_CASE("a set of triangles allows what its definition allows, to the last bit", "[quick][meshing]") {
  const std::int64_t unit = GENERATE(1, 40000);  // corners close together, on few planes; over a large grid
  RandomLattice random(unsigned(unit) + 5);
  GridFrame frame;
  frame.voxel = 0.375;
  frame.origin = {-3, 1000, 17};
  std::vector<TriangleD> triangles;
  while (triangles.size() < 150) {
    const LatticeCoord at = random.point(-40, 40);
    std::array<LatticeCoord, 3> t;
    for (LatticeCoord& p : t) p = (at + random.point(-6, 6)) * unit;
    if (triangles.size() % 3 == 0) t[2] = t[1];  // a segment
    if (triangles.size() % 12 == 0) t[1] = t[2] = t[0];
    triangles.push_back({frame.world(t[0]), frame.world(t[1]), frame.world(t[2])});
  }
  const EnclosedTriangles enclosed(triangles, frame);
  int allowed_ones = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    const LatticeCoord at = random.point(-40, 40);
    std::array<LatticeCoord, 4> p;
    for (LatticeCoord& c : p) c = (at + random.point(-9, 9)) * unit;
    const std::int64_t step = random.between(0, 1);  // touching by a lattice unit, or not
    p[0].x += step;
    if (orient3d(p[0], p[1], p[2], p[3]) > 0) std::swap(p[1], p[2]);
    std::vector<NewFace> star;
    std::vector<Tetrahedron> swept;
    if (!collinear(p[3], p[1], p[2])) star.push_back({{0, 1, 2}, {p[3], p[1], p[2]}});
    if (random.between(0, 2) > 0) swept.push_back(p);
    if (random.between(0, 2) == 0) swept.push_back({p[1], p[0], p[2], p[3]});  // under no face of the star
    Blocker blocker;
    const bool free = enclosed.allows(star, swept, &blocker);
    CAPTURE(unit, i);
    REQUIRE(free == allowed(triangles, frame, star, swept));
    REQUIRE((blocker.count == 3) == !free);
    (free ? allowed_ones : refused) += 1;
  }
  CHECK(allowed_ones > 200);
  CHECK(refused > 200);
}

TEST_CASE("no face comes as near to a rounded triangle as it may be off by", "[quick][meshing][rounding]") {
  GridFrame frame;
  frame.voxel = 64;  // a lattice unit is a unit
  RandomLattice random(5);
  Rounding rounding;
  rounding.see(1.5, 60, 0);
  int near = 0, free = 0;
  for (int i = 0; i < 3000; ++i) {
    TriangleD t, world;
    NewFace face{{0, 1, 2}, {random.point(-40, 40), random.point(-40, 40), random.point(-40, 40)}};
    for (std::size_t k = 0; k < 3; ++k) world[k] = to_double(face.corners[k]);
    for (Vec3d& p : t) p = to_double(random.point(-40, 40));
    const EnclosedTriangles rounded({t}, frame, {}, rounding), exact({t}, frame);
    const bool allowed = rounded.allows(std::span(&face, 1), {}, nullptr);
    if (allowed) CHECK(exact.allows(std::span(&face, 1), {}, nullptr));
    double nearest = HUGE_VAL;  // of samples of the triangle
    for (int a = 0; a <= 8; ++a) {
      for (int b = 0; a + b <= 8; ++b) {
        const Vec3d p = t[0] + a / 8.0 * (t[1] - t[0]) + b / 8.0 * (t[2] - t[0]);
        nearest = std::min(nearest, std::sqrt(distance_squared(p, world)));
      }
    }
    const double off = rounding.of(t);
    if (nearest <= off) CHECK_FALSE(allowed);
    near += nearest <= off, free += allowed;
    if (nearest > 15 * off) CHECK(allowed);
  }
  CHECK(near > 50);
  CHECK(free > 50);
}
