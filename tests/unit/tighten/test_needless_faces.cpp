#include "lib/enclosed/enclosed_triangles.h"
#include "lib/tighten/detail/spikes.h"
#include "lib/tighten/tight_proxy.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr int kRadius = 128;  // voxels
constexpr std::int64_t kTip = std::int64_t(kRadius) * kLatticePerVoxel + 1;

/// |x| + |y| + |z| <= kRadius, in voxels.
std::vector<TriangleD> octahedron() {
  std::vector<TriangleD> out;
  for (int i = 0; i < 8; ++i) {
    const double x = i & 1 ? kRadius : -kRadius, y = i & 2 ? kRadius : -kRadius, z = i & 4 ? kRadius : -kRadius;
    const bool even = x * y * z > 0;
    out.push_back({Vec3d{x, 0, 0}, even ? Vec3d{0, y, 0} : Vec3d{0, 0, z}, even ? Vec3d{0, 0, z} : Vec3d{0, y, 0}});
  }
  return out;
}

/// Returns whether a voxel touches the octahedron.
bool in_octahedron(VoxelCoord v) {
  const auto near = [](int c) { return c >= 0 ? c : -c - 1; };
  return near(v.x) + near(v.y) + near(v.z) <= kRadius;
}

/// How far it leaves the octahedron, in voxels.
double farthest(const LatticeMesh& mesh) {
  std::int64_t most = 0;
  for (const LatticeCoord& p : mesh.vertices) most = std::max(most, std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
  return (double(most) / kLatticePerVoxel - kRadius) / std::sqrt(3.0);
}

/// A proxy around the octahedron, with a vertex near the middle of an edge, one of whose three faces above is far out.
LatticeMesh octahedron_with_spike() {
  LatticeMesh mesh;
  mesh.vertices = {{-kTip, 0, 0}, {0, -kTip, 0},    {0, 0, -kTip},    {0, 0, kTip},
                   {0, kTip, 0},  {5009, 77, 3526}, {5096, -1, 3098}, {kTip, 0, 0}};
  mesh.triangles = {{4, 0, 3}, {1, 0, 2}, {1, 3, 0}, {2, 0, 4}, {7, 1, 2}, {1, 7, 6},
                    {6, 3, 1}, {5, 6, 7}, {5, 3, 6}, {3, 5, 7}, {2, 4, 7}, {3, 7, 4}};
  return mesh;
}

/// A proxy whose vertex lies in the plane of a side, so that it has next to no volume; the vertex below is a little
/// higher, so that a cut adds volume.
LatticeMesh octahedron_with_tongue() {
  LatticeMesh mesh = octahedron_with_spike();
  mesh.vertices[6] = {5096, -20, 3119};
  mesh.vertices[5] = {5200, -200, 3233};
  return mesh;
}

/// Around the octahedron; on one side a fin stands far out, of four faces over a thin rectangle.
LatticeMesh octahedron_with_fin() {
  LatticeMesh mesh;
  mesh.vertices = {{kTip, 0, 0},       {0, kTip, 0},       {0, 0, kTip},       {-kTip, 0, 0},
                   {0, -kTip, 0},      {0, 0, -kTip},      {2111, 3311, 2771}, {3311, 2111, 2771},
                   {3351, 2151, 2691}, {2151, 3351, 2691}, {3371, 3371, 3371}};
  mesh.triangles = {{0, 5, 1}, {0, 2, 4}, {0, 4, 5},  {3, 2, 1},  {3, 1, 5},  {3, 4, 2},
                    {3, 5, 4}, {0, 1, 9}, {0, 9, 8},  {0, 8, 7},  {1, 2, 6},  {1, 6, 9},
                    {2, 0, 7}, {2, 7, 6}, {6, 7, 10}, {7, 8, 10}, {8, 9, 10}, {9, 6, 10}};
  return mesh;
}

/// The proxy after `least` to `most` spikes were dropped: smaller than before, but for the share `most_added`, and
/// sound.
LatticeMesh without_spikes(const LatticeMesh& proxy, std::uint64_t least, std::uint64_t most, double most_added = 0) {
  const EnclosedTriangles enclosed(octahedron(), GridFrame{});
  HalfEdgeMesh mesh(proxy);
  ProxyEditor editor(mesh, enclosed, {});
  const int128 before = mesh.volume6();
  const std::uint64_t dropped = drop_spikes(editor);
  CHECK(dropped >= least);
  CHECK(dropped <= most);
  CHECK(double(mesh.volume6()) < (1 + most_added) * double(before));
  LatticeMesh after = mesh.compact(proxy.frame);
  CHECK(self_intersections(after) == 0);
  return after;
}

}  // namespace

TEST_CASE("a fin without volume falls onto its foot", "[quick][meshing]") {
  const LatticeMesh proxy = octahedron_with_fin();
  REQUIRE(farthest(proxy) > 15);
  CHECK(farthest(without_spikes(proxy, 1, proxy.vertices.size())) < 0.1);
}

TEST_CASE("a vertex of three faces far out beside an edge is cut off", "[quick][meshing]") {
  const LatticeMesh proxy = octahedron_with_spike();
  REQUIRE(farthest(proxy) > 3);
  const LatticeMesh after = without_spikes(proxy, 1, 1);
  CHECK(after.triangles.size() == 10);
  CHECK(farthest(after) < 0.1);
}

TEST_CASE("a tongue in the plane of a side is cut off, though that adds a little volume", "[quick][meshing]") {
  const LatticeMesh proxy = octahedron_with_tongue();
  REQUIRE(self_intersections(proxy) == 0);
  REQUIRE(farthest(proxy) > 3);
  const LatticeMesh after = without_spikes(proxy, 1, 1, 1e-4);
  CHECK(after.triangles.size() == 10);
  CHECK(farthest(after) < 0.5);
}

TEST_CASE("flat sides take few faces however many are wanted, and none sticks out", "[meshing]") {
  MemoryShelf shelf;
  fill_shelf(shelf, {{-132, -132, -132}, {132, 132, 132}}, in_octahedron);
  const EnclosedTriangles enclosed(octahedron(), GridFrame{});
  const double least = 4.0 / 3 * std::pow(kRadius, 3);
  for (const std::uint64_t faces : {100, 1000}) {
    CAPTURE(faces);
    SimplifyParams params;
    params.faces = faces;
    const auto [proxy, simplified, tightened] = tight_proxy(ShelfSurface(shelf, GridFrame{}), enclosed, params);
    CHECK(proxy.triangles.size() < 50);
    CHECK(simplified.stop == StopReason::least_volume);
    CHECK(simplified.faces_out == proxy.triangles.size());
    CHECK(double(volume6_of(proxy)) / 6 / std::pow(double(kLatticePerVoxel), 3) < 1.001 * least);
    CHECK(self_intersections(proxy) == 0);
    CHECK(farthest(proxy) < 1);
  }
}
