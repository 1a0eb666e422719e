#include <algorithm>
#include <cmath>

#include "lib/core/parallel.h"
#include "lib/geometry/surface_distance.h"
#include "lib/levels/detail/shown_scene.h"
#include "lib/levels/detail/voxel_distance.h"
#include "tests/catch.h"
#include "tests/support/voxelized.h"

namespace bp::test {

namespace {

constexpr double kVoxel = 0.5;

/// A house with a box inside, which nobody sees.
struct House {
  Triangles outside, all;
  House() {
    add_box(outside, {0.1, 0.2, 0.3}, {20.3, 15.1, 9.4});
    all = outside;
    add_box(all, {4, 4, 4}, {9, 9, 8});
  }
};

}  // namespace

TEST_CASE("points that are shown lie on the outside of a scene, about a voxel apart", "[quick][pass][lod]") {
  const House house;
  const Voxelized solid = voxelized(house.all, kVoxel);
  const std::vector<FaceRect> faces = boundary_rects(*solid.shelf);
  const TriangleBvh all(house.all), outside(house.outside);
  const auto shown = [&] { return shown_points(faces, all, solid.header.frame); };
  const std::vector<TriangleD> points = shown();
  REQUIRE(points.size() > 4000);
  for (const TriangleD& p : points) {
    CHECK(p[0] == p[1]);
    CHECK(outside.nearest(p[0]).distance_squared < 1e-12);
  }
  CHECK(largest_distance(house.outside, TriangleBvh(points), 0.01).at_most < 1.1 * kVoxel);
  const ThreadLimit one(1);
  CHECK(shown() == points);
}

TEST_CASE("triangles of another scene show nothing", "[quick][pass][lod]") {
  const House house;
  const Voxelized solid = voxelized(house.all, kVoxel);
  Triangles other;
  add_box(other, {0.1, 0.2, 0.3}, {20.3, 15.1, 5});
  CHECK(shown_points(boundary_rects(*solid.shelf), TriangleBvh(other), solid.header.frame).empty());
}

TEST_CASE("what lies beyond a mesh is measured to the triangles, not to their voxels", "[quick][pass][lod]") {
  const House house;
  const Voxelized solid = voxelized(house.all, kVoxel);
  const std::vector<VoxelRun> runs = boundary_of(*solid.shelf).runs;
  const std::vector<TriangleD> segments = segments_of(runs, solid.header.frame);
  const TriangleBvh scene(house.all);
  Triangles mesh;
  const auto beyond = [&](double at_least) {
    return distance_beyond_mesh(runs, segments, scene, solid.header.frame, TriangleBvh(mesh), at_least);
  };
  add_box(mesh, {0, 0, 0}, {20.4, 15.2, 9.5});
  CHECK(beyond(kVoxel) == kVoxel);  // around it
  mesh.clear();
  add_box(mesh, {0, 0, 0}, {17, 15.2, 9.5});
  CHECK(beyond(kVoxel) >= 3.3);
  CHECK(beyond(kVoxel) < 3.31);
  CHECK(beyond(4) == 4);
}

}  // namespace bp::test
