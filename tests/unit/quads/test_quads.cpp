#include <cmath>
#include <random>
#include <set>

#include "lib/check/check_proxy.h"
#include "lib/pass/mesh/detail/proxy_limits.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/quads/quads.h"
#include "tests/catch.h"
#include "tests/support/memory_scene.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

const VoxelBox kPipeBox{{0, 0, 0}, {40, 40, 40}};

/// A bent pipe through a slab: curved, flat, concave.
bool bent_pipe(VoxelCoord p) {
  const double ring = std::hypot(p.x - 20.0, p.y - 20.0) - 13;
  return ring * ring + (p.z - 18.0) * (p.z - 18.0) < 20 || (p.z >= 8 && p.z < 12 && p.x > 4 && p.x < 30 && p.y > 9);
}

/// Draws the other diagonals where `turned` says so.
IndexedMesh with_diagonals(const LatticeMesh& mesh, const std::function<bool(std::size_t)>& turned) {
  const PolygonFaces faces = polygon_faces(mesh);
  IndexedMesh out = indexed(mesh);
  out.triangles = faces.triangles;
  for (std::size_t i = 0; i < faces.quads.size(); ++i) {
    const Quad& q = faces.quads[i];
    const std::size_t k = turned(i) ? 1 : 0;
    out.triangles.push_back({q[k], q[k + 1], q[(k + 2) % 4]});
    out.triangles.push_back({q[k], q[(k + 2) % 4], q[(k + 3) % 4]});
  }
  return out;
}

std::vector<TriangleD> scene_of_voxels() {
  std::vector<TriangleD> all;
  for (VoxelCoord p = kPipeBox.min; p.z < kPipeBox.max.z; ++p.z) {
    for (p.y = 0; p.y < 40; ++p.y) {
      for (p.x = 0; p.x < 40; ++p.x) {
        const double l = 1.0 / 128, h = 1 - l, x = p.x, y = p.y, z = p.z;
        if (bent_pipe(p)) add_box(all, {x + l, y + l, z + l}, {x + h, y + h, z + h});
      }
    }
  }
  return all;
}

std::vector<TriangleD> triangles_of(const IndexedMesh& mesh) {
  std::vector<TriangleD> all;
  for (const auto& t : mesh.triangles) all.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  return all;
}

bool holds(const IndexedMesh& mesh, const std::vector<TriangleD>& scene, bool inside = false) {
  MemorySource source(scene);
  CheckOptions options;
  options.inside = inside;
  options.distances = false;
  return check_proxy(mesh, &source, options).holds();
}

}  // namespace

TEST_CASE("however the quads are split, the proxy encloses and does not meet itself", "[quick][meshing]") {
  VoxelSource source(kPipeBox, bent_pipe);
  MeshParams params;
  params.faces = {GENERATE(1200u, 300u, 100u)};
  params.quads = true;
  params.tighten = GENERATE(true, false);
  MeshCounts counts;
  const LatticeMesh proxy = mesh_stream(source, memory_context(), params, counts)[0];
  const PolygonFaces faces = polygon_faces(proxy);
  CAPTURE(proxy.triangles.size(), faces.quads.size(), faces.triangles.size());
  CHECK(faces.triangles.size() + 2 * faces.quads.size() == proxy.triangles.size());
  if (params.tighten) CHECK(4 * faces.quads.size() >= proxy.triangles.size());  // half of the triangles
  for (const Quad& q : faces.quads) {
    std::array<LatticeCoord, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = proxy.vertices[q[i]];
    CHECK(quad_quality(corners) >= kLeastQuadQuality);
    CHECK(quad_bend(corners) <= kMostQuadBend);
    CHECK(quad_aspect(corners) <= 20);
  }
  const std::vector<TriangleD> scene = scene_of_voxels();
  CHECK(holds(with_diagonals(proxy, [](std::size_t) { return false; }), scene));
  CHECK(holds(with_diagonals(proxy, [](std::size_t) { return true; }), scene));
  std::mt19937 random{7};
  for (int i = 0; i < 3; ++i)
    CHECK(holds(with_diagonals(proxy, [&](std::size_t) { return random() % 2 == 0; }), scene));
}

TEST_CASE("levels of quads enclose each other, however each is split", "[quick][meshing]") {
  VoxelSource source(kPipeBox, bent_pipe);
  MeshParams params;
  params.faces = {400, 280, 100};
  params.quads = true;
  params.tighten = GENERATE(true, false);
  if (GENERATE(false, true)) {
    params.mode = MeshMode::inside;
    source.header().fill = FillMode::inside;
  }
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh_stream(source, memory_context(), params, counts);
  std::mt19937 random{11};
  const std::vector<std::function<bool(std::size_t)>> choices = {[](std::size_t) { return false; },
                                                                 [](std::size_t) { return true; },
                                                                 [&random](std::size_t) { return random() % 2 == 0; }};
  for (std::size_t i = 1; i < levels.size(); ++i) {
    REQUIRE(!levels[i - 1].quads.empty());
    for (std::size_t k = 0; k < 9; ++k) {
      CAPTURE(i, k);
      const std::vector<TriangleD> before = triangles_of(with_diagonals(levels[i - 1], choices[k % 3]));
      CHECK(holds(with_diagonals(levels[i], choices[k / 3]), before, params.mode == MeshMode::inside));
    }
  }
}

TEST_CASE("room for quads joins half of the triangles, for little volume", "[quick][meshing]") {
  VoxelSource source(kPipeBox, bent_pipe);
  MeshParams params;
  params.faces = {300};
  MeshCounts counts;
  const LatticeMesh tight = mesh_stream(source, memory_context(), params, counts)[0];
  VoxelSource again(kPipeBox, bent_pipe);
  params.quads = true;
  MeshCounts with_quads;
  const LatticeMesh proxy = mesh_stream(again, memory_context(), params, with_quads)[0];
  CHECK(proxy.triangles.size() == tight.triangles.size());
  const MeshMeasures& m = with_quads.levels[0].measures;
  REQUIRE(m.quads);
  CHECK(m.quads->count == proxy.quads.size());
  CHECK(m.quads->volume_least <= m.volume);
  CHECK(m.quads->volume_most >= m.volume);
  CHECK(volume_world(innermost_choice(proxy)) == Approx(m.quads->volume_least));
  CHECK(m.quads->volume_least < m.volume);
  CHECK(m.volume < 1.02 * counts.levels[0].measures.volume);
  CAPTURE(m.quads->share, m.volume / counts.levels[0].measures.volume);
  CHECK(m.quads->share > 0.5);
}

TEST_CASE("a box of twelve triangles becomes six squares", "[quick][meshing]") {
  VoxelSource source(kPipeBox, [](VoxelCoord p) { return p.x < 9 && p.y > 3 && p.y < 20 && p.z == 5; });
  MeshParams params;
  params.faces = {12};
  params.quads = true;
  MeshCounts counts;
  const LatticeMesh proxy = mesh_stream(source, memory_context(), params, counts)[0];
  const PolygonFaces faces = polygon_faces(proxy);
  REQUIRE(faces.quads.size() == 6);
  CHECK(faces.triangles.empty());
  for (const Quad& q : faces.quads) {
    CHECK(std::set<std::uint32_t>(q.begin(), q.end()).size() == 4);
    const LatticeCoord &a = proxy.vertices[q[0]], &b = proxy.vertices[q[1]], &c = proxy.vertices[q[2]],
                       &d = proxy.vertices[q[3]];
    CHECK(a + c == b + d);  // a parallelogram, in this order
  }
}
