#include <cmath>
#include <random>

#include "lib/check/check_proxy.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/mesh/step_limits.h"
#include "lib/simplify/detail/bulk_order.h"
#include "lib/simplify/flatten.h"
#include "lib/simplify/simplify.h"
#include "lib/simplify/surface_tree.h"
#include "lib/surface/repair.h"
#include "lib/surface/surface.h"
#include "tests/support/memory_store.h"
#include "tests/support/proxy_checks.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

const VoxelBox kBox{{-70, -40, -20}, {80, 70, 75}};  // 3 x 3 x 3 bricks, around the origin

const Solid kSolids[] = {
    [](VoxelCoord p) { return std::hypot(p.x * 0.5, p.y - 10.0, p.z - 25.0) < 30 + (p.x & 1); },
    [](VoxelCoord p) { return p.z < 0 || (p.z < 20 && p.x > -40 && p.x < 0 && p.y > 0); },  // faces in the cells' sides
    [](VoxelCoord p) { return std::abs(p.x + 2 * p.y - 3 * p.z) < 5; },                     // a slanted sheet
    [](VoxelCoord p) { return (p.x & 63) < 2 || (p.y & 63) == 63; },  // walls along the cells' sides
};

std::int64_t volume6(const std::vector<LatticeCoord>& v, const std::vector<Triangle>& triangles) {
  std::int64_t sum = 0;
  for (const Triangle& t : triangles) sum += std::int64_t(orient3d_value({0, 0, 0}, v[t[0]], v[t[1]], v[t[2]]));
  return sum;
}

/// Limits that refuse nothing. Limits are kept by the whole surface, so no cell collapses anything.
class NoLimits final : public StepLimits {
 public:
  void begin(int128) override {}
  void relax(bool) override {}
  bool take(std::span<const LatticeTriangle>, std::span<const LatticeTriangle>) override { return true; }
};

/// Share of the vertices that are within a voxel of a side of a brick.
double share_along_walls(const std::vector<LatticeCoord>& vertices) {
  const auto near = std::count_if(vertices.begin(), vertices.end(), [](const LatticeCoord& p) {
    bool any = false;
    for (int i = 0; i < 3; ++i) {
      const double bricks = double(p[i]) / (kLatticePerVoxel * kBrickEdge);
      any = any || std::abs(bricks - std::round(bricks)) * kBrickEdge < 1;
    }
    return any;
  });
  return double(near) / double(vertices.size());
}

/// Returns the vertices of bricks that were simplified far, each separately.
std::vector<LatticeCoord> with_seams(const SurfaceSource& surface) {
  std::vector<LatticeCoord> vertices;
  for (const BrickCoord& b : surface.bricks()) {
    const Piece piece = surface.piece(b);
    if (piece.triangles.empty()) continue;
    HalfEdgeMesh mesh(piece.vertices, piece.triangles, piece.cell);
    const SimplifyParams params;
    SimplifyCounts counts;
    Collapser collapser(mesh, {}, params, counts);
    collapse_bulk(collapser, {kFirstBound, 1e4 * kFirstBound}, 0);
    (void)mesh.live_faces([&](VertexId v, VertexId) { vertices.push_back(mesh.position(v)); });
  }
  return vertices;
}

}  // namespace

TEST_CASE("a surface simplified brick by brick shows no seams and is as tight as one done as a whole",
          "[quick][meshing]") {
  const std::uint64_t faces = GENERATE(1000, 3000);
  MemoryShelf shelf;
  const auto squared = [](double x) { return x * x; };
  fill_shelf(shelf, {{-75, -70, -65}, {85, 90, 75}}, [&](VoxelCoord p) {
    const double bumps = std::sin(p.x / 5.0) * std::sin(p.y / 5.0) * std::sin(p.z / 5.0);
    return squared((p.x - 5) / 75.0) + squared((p.y - 10) / 70.0) + squared((p.z - 3) / 60.0) < 0.8 + 0.1 * bumps;
  });
  repair_contacts(shelf);
  SimplifyParams params;
  params.faces = faces;
  SimplifyCounts counts;
  const LatticeMesh by_cells = simplify(ShelfSurface(shelf, {}), params, counts);
  NoLimits none;
  params.limits = &none;
  const LatticeMesh as_whole = simplify(ShelfSurface(shelf, {}), params, counts);
  REQUIRE(by_cells.triangles.size() == faces);
  REQUIRE(as_whole.triangles.size() == faces);
  const double ratio =
      double(volume6(by_cells.vertices, by_cells.triangles)) / double(volume6(as_whole.vertices, as_whole.triangles));
  CAPTURE(faces, ratio, counts.faces_in, counts.faces_flat);
  CHECK(ratio < 1.02);
  const double along = share_along_walls(as_whole.vertices);
  CHECK(share_along_walls(with_seams(ShelfSurface(shelf, {}))) > 3 * along);  // what it would be
  CHECK(share_along_walls(by_cells.vertices) < 1.3 * along);
}

TEST_CASE("a proxy simplified brick by brick encloses its voxels and does not meet itself", "[quick][meshing]") {
  const int shape = GENERATE(range(0, 4));
  MemoryShelf shelf;
  fill_shelf(shelf, kBox, kSolids[shape]);
  repair_contacts(shelf);
  SimplifyParams params;
  params.faces = 200;
  SimplifyCounts counts;
  const LatticeMesh proxy = simplify(dense_surface(shelf, {}), params, counts);
  CAPTURE(shape, counts.faces_in, counts.faces_flat, counts.faces_out);
  CHECK(proxy.triangles.size() <= 400);
  const Solid thinned = [&](VoxelCoord p) { return (p.x + 2 * p.y + 3 * p.z) % 7 == 0 && kSolids[shape](p); };
  check_proxy(proxy, kBox, thinned);
}

TEST_CASE("brick by brick, the result does not depend on the number of threads", "[quick][meshing]") {
  MemoryShelf shelf;
  fill_shelf(shelf, kBox, kSolids[0]);
  repair_contacts(shelf);
  SimplifyParams params;
  params.faces = 100;
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    SimplifyCounts counts;
    return simplify(dense_surface(shelf, {}), params, counts);
  };
  const LatticeMesh one = with_threads(1), two = with_threads(2), five = with_threads(5);
  CHECK(one.vertices == two.vertices);
  CHECK(one.triangles == two.triangles);
  CHECK(one.vertices == five.vertices);
  CHECK(one.triangles == five.triangles);
}

TEST_CASE("brick by brick, the result does not depend on memory, and nothing stays in the store", "[quick][meshing]") {
  MemoryShelf shelf;  // a ball in each of 64 bricks
  fill_shelf(shelf, {{-128, -128, -128}, {128, 128, 128}},
             [](VoxelCoord p) { return std::hypot((p.x & 63) - 31.5, (p.y & 63) - 31.5, (p.z & 63) - 31.5) < 12; });
  SimplifyParams params;
  params.faces = 300;
  SimplifyCounts counts;
  const LatticeMesh roomy = simplify(ShelfSurface(shelf, {}), params, counts);
  std::uint64_t put = 0, held = 0;
  const std::uint64_t waiting = GENERATE(0, 1000000);  // bytes
  CAPTURE(waiting);
  params.memory.waiting_bytes = waiting;
  params.memory.work_bytes = 40 << 20;  // the whole takes 33 MiB at the end
  params.memory.make_scratch = [&] { return std::make_unique<MemoryStore>(put, held); };
  const LatticeMesh tight = simplify(ShelfSurface(shelf, {}), params, counts);
  CHECK(put > 0);
  CHECK(held == 0);
  CHECK(tight.vertices == roomy.vertices);
  CHECK(tight.triangles == roomy.triangles);
}

TEST_CASE("a cell that is too large for the memory is refused", "[quick][meshing]") {
  MemoryShelf shelf;
  fill_shelf(shelf, kBox, kSolids[0]);
  repair_contacts(shelf);
  SimplifyParams params;
  params.faces = 20;
  params.memory.work_bytes = 100000;
  SimplifyCounts counts;
  CHECK_THROWS_AS(simplify(ShelfSurface(shelf, {}), params, counts), Error);
}

TEST_CASE("the surface of a shelf and that of the mesh of it have the same pieces", "[quick][meshing]") {
  const int shape = GENERATE(range(0, 4));
  MemoryShelf shelf;
  fill_shelf(shelf, kBox, kSolids[shape]);
  const ShelfSurface of_shelf(shelf, {});
  const LatticeMesh dense = dense_surface(shelf, {});
  const MeshSurface of_mesh(dense);
  std::size_t bricks = 0, faces = 0;
  for (const BrickCoord& b : of_shelf.bricks()) {
    const Piece one = of_shelf.piece(b), other = of_mesh.piece(b);
    CHECK(one.vertices == other.vertices);
    CHECK(one.triangles == other.triangles);
    bricks += one.triangles.empty() ? 0 : 1;
    faces += one.triangles.size();
  }
  CHECK(bricks == of_mesh.bricks().size());
  CHECK(faces == dense.triangles.size());
  CHECK(faces == count_faces(of_mesh));
}

TEST_CASE("merging flat regions brick by brick keeps the surface as a set", "[quick][meshing]") {
  const int shape = GENERATE(range(0, 4));
  MemoryShelf shelf;
  fill_shelf(shelf, kBox, kSolids[shape]);
  repair_contacts(shelf);
  const LatticeMesh dense = dense_surface(shelf, {});
  SimplifyCounts counts;
  Piece merged = simplified_surface(ShelfSurface(shelf, {}), {}, {}, counts);
  CHECK(merged.quadrics.empty());
  CHECK(merged.triangles.size() < dense.triangles.size());
  CHECK(volume6(merged.vertices, merged.triangles) == volume6(dense.vertices, dense.triangles));
  HalfEdgeMesh mesh(merged.vertices, merged.triangles, kEverywhere);
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) {  // still axis-aligned
    int zeros = 0;
    for (int axis = 0; axis < 3; ++axis)
      zeros += mesh.corner(f, 0)[axis] == mesh.corner(f, 1)[axis] && mesh.corner(f, 0)[axis] == mesh.corner(f, 2)[axis];
    REQUIRE(zeros == 1);
  }
  const std::size_t before = mesh.face_count();
  merge_flat_regions(mesh);  // only what the cells' sides kept apart is left
  CHECK(mesh.face_count() <= before);
  CHECK(bp::check_proxy(indexed(mesh.compact(GridFrame{})), nullptr).holds());  // too many pairs to try all
}

TEST_CASE("merging flat regions keeps the edge limit", "[quick][meshing]") {
  MemoryShelf shelf;
  fill_shelf(shelf, {{0, 0, 0}, {50, 40, 30}}, [](VoxelCoord) { return true; });
  HalfEdgeMesh mesh(dense_surface(shelf, {}));
  merge_flat_regions(mesh, edges_up_to(5.0 * kLatticePerVoxel));
  CHECK(mesh.face_count() < 18800 / 4);
  for (HalfEdgeId h = 0; h < 3 * mesh.face_capacity(); ++h) {
    if (!mesh.alive(HalfEdgeMesh::face(h))) continue;
    const LatticeCoord e = mesh.position(mesh.to(h)) - mesh.position(mesh.from(h));
    REQUIRE(e.x * e.x + e.y * e.y + e.z * e.z <= 25 * kLatticePerVoxel * kLatticePerVoxel);
  }
}
