#include <algorithm>

#include "lib/enclosed/enclosed_triangles.h"
#include "lib/enclosed/enclosed_voxels.h"
#include "lib/exact/predicates.h"
#include "lib/hulls/convex_hull.h"
#include "tests/catch.h"
#include "tests/support/memory_shelf.h"
#include "tests/support/random_lattice.h"

using namespace bp;
using namespace bp::test;

namespace {

void add_corners(const LatticeBox& box, std::vector<LatticeCoord>& points) {
  for (int i = 0; i < 8; ++i) {
    const LatticeBox& b = box;
    points.push_back({i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z});
  }
}

/// Without the first boxes, which are among the others.
ConvexHull hull_of_boxes(const Enclosed& enclosed) {
  std::vector<LatticeCoord> points, first;
  enclosed.outer_boxes([&](std::span<const LatticeBox> boxes) {
    for (const LatticeBox& box : boxes) add_corners(box, first.empty() ? first : points);
    if (first.empty()) add_corners(boxes.front(), first);
    return true;
  });
  return hull_of(points).value();
}

std::vector<LatticeCoord> corners_of(ConvexHull hull) {
  std::sort(hull.vertices.begin(), hull.vertices.end());
  return hull.vertices;
}

}  // namespace

TEST_CASE("the hull of voxels is that of all their corners", "[quick][meshing]") {
  const unsigned seed = GENERATE(range(0u, 8u));
  CAPTURE(seed);
  RandomLattice random(seed);
  MemoryShelf shelf;
  BitBox bits({{-64, -64, -64}, {64, 128, 192}});
  std::vector<LatticeCoord> points;
  for (int i = 0; i < 40; ++i) {
    const VoxelCoord v{std::int32_t(random.between(-30, 9)), std::int32_t(random.between(-40, 99)),
                       std::int32_t(random.between(-20, 150))};
    bits.set(v);
    const LatticeCoord low = LatticeCoord{v.x, v.y, v.z} * kLatticePerVoxel;
    add_corners({low, low + LatticeCoord{1, 1, 1} * kLatticePerVoxel}, points);
  }
  store_voxels(bits, shelf);
  CHECK(corners_of(hull_of_boxes(EnclosedVoxels(shelf))) == corners_of(hull_of(points).value()));
}

TEST_CASE("the hull of triangles has them strictly inside, and is a lattice unit away at most", "[quick][meshing]") {
  RandomLattice random(3);
  std::vector<TriangleD> triangles;
  for (int i = 0; i < 3000; ++i) {
    TriangleD& t = triangles.emplace_back();
    for (Vec3d& p : t) {  // a slanted sheet; some corners are lattice points
      const LatticeCoord at = random.point(-1000, 1000);
      p = {double(at.x) / 64, double(at.y) / 64, double(at.x + at.y) / 192};
    }
  }
  const ConvexHull hull = hull_of_boxes(EnclosedTriangles(triangles, GridFrame{}));
  const GridFrame frame;
  for (const auto& [a, b, c] : hull.triangles) {
    const Vec3d p = frame.world(hull.vertices[a]), q = frame.world(hull.vertices[b]), r = frame.world(hull.vertices[c]);
    int touched = 0;
    for (const TriangleD& t : triangles) {
      for (const Vec3d& v : t) touched += orient3d(p, q, r, v) >= 0;
    }
    CHECK(touched == 0);
  }
  for (const LatticeCoord& p : hull.vertices) CHECK(std::abs(double(p.x + p.y) / 3 - double(p.z)) < 3);
}

TEST_CASE("of a part of a scene no hull is known", "[quick][meshing]") {
  const std::vector<TriangleD> triangles{{Vec3d{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  const EnclosedTriangles part(triangles, GridFrame{}, Bounds3d{{0, 0, 0}, {1, 1, 1}});
  bool known = false;
  part.outer_boxes([&](std::span<const LatticeBox>) { return known = true; });
  CHECK(!known);
}
