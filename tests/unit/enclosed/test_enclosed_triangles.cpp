#include <algorithm>

#include "lib/enclosed/enclosed_triangles.h"
#include "lib/exact/triangle_intersection.h"
#include "tests/catch.h"
#include "tests/support/random_lattice.h"

using namespace bp;
using bp::test::RandomLattice;

namespace {

/// The definition: the new faces meet no triangle, and no closed tetrahedron of positive volume holds a first corner.
bool allowed(const std::vector<TriangleD>& triangles, const GridFrame& frame, const std::vector<NewFace>& star,
             const std::vector<Tetrahedron>& swept) {
  for (const TriangleD& t : triangles) {
    for (const NewFace& f : star) {
      const std::array<Vec3d, 3> face = {frame.world(f.corners[0]), frame.world(f.corners[1]),
                                         frame.world(f.corners[2])};
      if (triangles_intersect(t.data(), face.data())) return false;
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

}  // namespace

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
    if (!collinear(t[0], t[1], t[2])) triangles.push_back({frame.world(t[0]), frame.world(t[1]), frame.world(t[2])});
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
