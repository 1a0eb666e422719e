#include "lib/enclosed/enclosed_triangles.h"
#include "lib/enclosed/enclosed_voxels.h"
#include "lib/hulls/convex_hull.h"
#include "lib/pass/mesh/detail/convex_proxy.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "lib/surface/surface.h"
#include "tests/catch.h"
#include "tests/support/proxy_checks.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

const VoxelBox kAroundSheet{{-70, -70, -10}, {70, 70, 60}};

/// 100 x 80 voxels; at 0.2 and 0.3 to the axes, or flat.
std::vector<TriangleD> sheet(bool flat) {
  const auto at = [flat](double x, double y) { return Vec3d{x, y, flat ? 20 : 20.4 + 0.2 * x + 0.3 * y}; };
  const Vec3d a = at(-50, -40), b = at(50, -40), c = at(50, 40), d = at(-50, 40);
  return {{a, b, c}, {a, c, d}};
}

/// Returns whether a voxel touches the sheet, or lies within `more` of it.
bool near_sheet(VoxelCoord v, bool flat, double more) {
  const double x = v.x + 0.5, y = v.y + 0.5;
  return std::abs(x) < 51 + more && std::abs(y) < 41 + more &&
         std::abs(v.z + 0.5 - (flat ? 20 : 20.4 + 0.2 * x + 0.3 * y)) < 1.3 + more;
}

std::vector<LatticeMesh> proxies(bool flat, std::vector<std::uint64_t> faces) {
  VoxelSource source(
      kAroundSheet, [&](VoxelCoord v) { return near_sheet(v, flat, 0); },
      [&](VoxelCoord v) { return near_sheet(v, flat, 3); });
  source.header().scale.base = 4;
  source.header().scene.triangles = 2;
  MeshParams params;
  params.faces = std::move(faces);
  params.enclose = Enclose::scene;
  params.scene = sheet(flat);
  MeshCounts counts;
  std::vector<LatticeMesh> levels = mesh_stream(source, memory_context(), params, counts);
  for (std::size_t i = 0; i < levels.size(); ++i)
    CHECK(counts.levels[i].simplify.faces_out == levels[i].triangles.size());
  return levels;
}

/// Strictly inside of a convex proxy.
bool holds(const LatticeMesh& proxy, const Vec3d& p) {
  return std::all_of(proxy.triangles.begin(), proxy.triangles.end(), [&](const auto& t) {
    const auto corner = [&](std::size_t k) { return proxy.frame.world(proxy.vertices[t[k]]); };
    return orient3d(corner(0), corner(1), corner(2), p) < 0;
  });
}

LatticeMesh mesh_of(const VoxelBox& box, const Solid& solid) {
  MemoryShelf shelf;
  fill_shelf(shelf, box, solid);
  return dense_surface(shelf, GridFrame{});
}

LatticeMesh box_mesh(const LatticeCoord& low, const LatticeCoord& high) {
  std::vector<LatticeCoord> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  const ConvexHull hull = hull_of(corners).value();
  LatticeMesh mesh;
  mesh.vertices = hull.vertices;
  mesh.triangles = hull.triangles;
  return mesh;
}

const auto kCube = [](VoxelCoord v) { return std::max({v.x, v.y, v.z}) < 20 && std::min({v.x, v.y, v.z}) >= 0; };
const VoxelBox kCubeBox{{-1, -1, -1}, {40, 40, 40}};

}  // namespace

TEST_CASE("a proxy of a sheet stays near its box, and more faces do not make it larger", "[meshing]") {
  const auto [flat, faces] = GENERATE(table<bool, std::uint64_t>(
      {{false, 12}, {false, 20}, {false, 64}, {true, 12}, {true, 20}, {true, 64}, {true, 200}}));
  CAPTURE(flat, faces);
  const LatticeMesh proxy = proxies(flat, {faces}).front();
  CHECK(proxy.triangles.size() <= faces);
  REQUIRE_NOTHROW(HalfEdgeMesh(proxy));
  CHECK(self_intersections(proxy) == 0);
  for (const TriangleD& t : sheet(flat)) {
    for (const Vec3d& p : t) CHECK(holds(proxy, p));
  }
  const LatticeBox box = box_of(proxy.vertices);
  CHECK(double(box.max.x - box.min.x) / kLatticePerVoxel < 102);
  CHECK(double(box.max.y - box.min.y) / kLatticePerVoxel < 82);
  CHECK(double(volume6_of(proxy)) / kVolume6OfVoxel < 100 * 80 * 0.06);
}

TEST_CASE("each level around a sheet holds the one before strictly", "[meshing]") {
  const std::vector<LatticeMesh> levels = proxies(false, {64, 20, 12});
  for (std::size_t i = 1; i < levels.size(); ++i) {
    CHECK(levels[i].triangles.size() <= 12 + 8 * (2 - i));
    for (const LatticeCoord& p : levels[i - 1].vertices) CHECK(holds(levels[i], levels[i - 1].frame.world(p)));
  }
}

TEST_CASE("a hull takes the place of what holds more", "[quick][meshing]") {
  MemoryShelf shelf;
  fill_shelf(shelf, kCubeBox, kCube);
  const EnclosedVoxels cube(shelf);
  const LatticeMesh hull = convex_proxy(cube, box_mesh({-100, 0, 0}, {1280, 1280, 1280}), 12);
  CHECK(hull.triangles.size() == 12);
  CHECK(volume6_of(hull) == int128(8000) * kVolume6OfVoxel);
  check_proxy(hull, kCubeBox, kCube);
  LatticeMesh pyramid;  // as a proxy of few faces may be
  pyramid.vertices = {{-1, -1, -1}, {19999, -1, -1}, {-1, 19999, -1}, {-1, -1, 19999}};
  pyramid.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const LatticeMesh fewer = convex_proxy(cube, pyramid, 8);
  CHECK(fewer.triangles.size() <= 8);
  CHECK(volume6_of(fewer) > volume6_of(hull));
  check_proxy(fewer, kCubeBox, kCube);
  CHECK(convex_proxy(cube, box_mesh({-10, 0, 0}, {1280, 1280, 1280}), 12).triangles.empty());  // hardly more
}

TEST_CASE("no hull takes the place of a proxy whose handles take more faces than are wanted", "[quick][meshing]") {
  const auto pierced = [](VoxelCoord v) { return kCube(v) && !(v.x % 5 == 2 && v.y % 5 == 2); };
  MemoryShelf shelf;
  fill_shelf(shelf, kCubeBox, pierced);
  CHECK(convex_proxy(EnclosedVoxels(shelf), mesh_of(kCubeBox, pierced), 12).triangles.empty());
}

TEST_CASE("no hull takes the place of a proxy in a corner, or of a round one", "[quick][meshing]") {
  const auto corner = [](VoxelCoord v) { return kCube(v) && std::min({v.x, v.y, v.z}) < 2; };
  const auto ball = [](VoxelCoord v) {
    return (v.x - 20) * (v.x - 20) + (v.y - 20) * (v.y - 20) + (v.z - 20) * (v.z - 20) < 380;
  };
  for (const Solid& solid : {Solid(corner), Solid(ball)}) {
    MemoryShelf shelf;
    fill_shelf(shelf, kCubeBox, solid);
    CHECK(convex_proxy(EnclosedVoxels(shelf), mesh_of(kCubeBox, solid), 100000).triangles.empty());
  }
}
