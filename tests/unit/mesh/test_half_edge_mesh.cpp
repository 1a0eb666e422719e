#include <algorithm>
#include <chrono>
#include <random>

#include "lib/core/error.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/mesh/shells.h"
#include "lib/surface/surface.h"
#include "tests/support/lattice_boxes.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

namespace {

LatticeBox cube(std::int64_t half, LatticeCoord centre = {}) {
  return {centre - LatticeCoord{half, half, half}, centre + LatticeCoord{half, half, half}};
}

std::uint64_t erased(const LatticeMesh& m, LatticeMesh* left = nullptr) {
  HalfEdgeMesh mesh(m);
  const std::uint64_t n = erase_inner_shells(mesh, faces_inwards(mesh));
  if (left != nullptr) *left = mesh.compact(m.frame);
  return n;
}

}  // namespace

TEST_CASE("a shell inside a solid is erased", "[quick][meshing]") {
  LatticeMesh mesh, left;
  add_box(mesh, cube(10));
  add_box(mesh, cube(100));
  add_box(mesh, cube(10, {500, 0, 0}));  // beside it
  CHECK(erased(mesh, &left) == 12);
  CHECK(left.triangles.size() == 24);
  CHECK(inside(left, {1, 2, 3}));
  CHECK(erased(left) == 0);
}

TEST_CASE("the volume of a mesh without faces is zero", "[quick][meshing]") {
  LatticeMesh box;
  add_box(box, cube(10));
  HalfEdgeMesh mesh(box);
  CHECK(mesh.volume6() == 6 * 20 * 20 * 20);
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) mesh.erase(f);
  CHECK(mesh.volume6() == 0);
  CHECK(HalfEdgeMesh(LatticeMesh{}).volume6() == 0);
}

TEST_CASE("a part that came out inside out is erased, and nothing else", "[quick][meshing]") {
  LatticeMesh mesh, left;
  add_box(mesh, cube(10));
  add_box(mesh, cube(100, {500, 0, 0}), false);
  HalfEdgeMesh edited(mesh);
  CHECK(erase_inner_shells(edited, false) == 12);  // a small solid, though the volume of all is negative
  left = edited.compact(mesh.frame);
  CHECK(left.triangles.size() == 12);
  CHECK(inside(left, {1, 2, 3}));
}

TEST_CASE("cavities and what is in them stay", "[quick][meshing]") {
  LatticeMesh mesh;
  add_box(mesh, cube(100));
  add_box(mesh, cube(80), false);
  add_box(mesh, cube(60));
  add_box(mesh, cube(40), false);
  CHECK(erased(mesh) == 0);
}

TEST_CASE("a hollow solid inside another is erased with its cavity", "[quick][meshing]") {
  LatticeMesh mesh, left;
  add_box(mesh, cube(40), false);
  add_box(mesh, cube(60));
  add_box(mesh, cube(100));
  add_box(mesh, cube(20));  // in the cavity
  CHECK(erased(mesh, &left) == 36);
  CHECK(left.vertices.front().x == -100);
}

TEST_CASE("a ray through corners and edges of other shells still counts them once", "[quick][meshing]") {
  LatticeMesh mesh;
  add_box(mesh, {{0, 0, 0}, {4, 4, 4}});
  add_box(mesh, {{0, 0, 10}, {4, 4, 14}});   // its corner is straight above the first box's
  add_box(mesh, {{-4, 0, 20}, {4, 4, 24}});  // its edge
  add_box(mesh, {{-4, -4, -4}, {8, 8, 8}});  // around the first box only
  CHECK(erased(mesh) == 12);
}

TEST_CASE("a surface too wide for exact products is refused", "[quick][meshing]") {
  LatticeMesh narrow, wide;
  add_box(narrow, {{0, 0, 0}, {HalfEdgeMesh::kMaxSpan - 1, 1, 1}});
  add_box(wide, {{0, 0, 0}, {1, HalfEdgeMesh::kMaxSpan, 1}});
  CHECK_NOTHROW(HalfEdgeMesh(narrow));
  CHECK_THROWS_AS(HalfEdgeMesh(wide), Error);
}

TEST_CASE("an open surface is refused, unless it is open along the side of its cell", "[quick][meshing]") {
  LatticeMesh mesh;
  add_box(mesh, {{0, 0, 0}, {4, 4, 4}});
  CHECK_NOTHROW(HalfEdgeMesh(mesh.vertices, mesh.triangles, {{-9, -9, -9}, {4, 9, 9}}));
  mesh.triangles.resize(10);  // without the side x = 4
  CHECK_THROWS_AS(HalfEdgeMesh(mesh), Error);
  CHECK_THROWS_AS(HalfEdgeMesh(mesh.vertices, mesh.triangles, LatticeBox{{-9, -9, -9}, {9, 9, 9}}), Error);
  const HalfEdgeMesh open(mesh.vertices, mesh.triangles, {{-9, -9, -9}, {4, 9, 9}});
  for (VertexId v = 0; v < 8; ++v) CHECK(open.locked(v) == (open.position(v).x == 4));
}

TEST_CASE("a shell has turned where its volume changes sign, and one with a rim never does", "[quick][meshing]") {
  LatticeMesh mesh;
  add_box(mesh, {{0, 0, 0}, {4, 4, 4}});
  add_box(mesh, {{10, 0, 0}, {14, 4, 4}}, false);
  constexpr int kVolume6 = 6 * 64;
  ShellSense sense{HalfEdgeMesh(mesh)};
  CHECK_FALSE(sense.turns(0, 1 - kVolume6));
  CHECK(sense.turns(0, -1 - kVolume6));
  CHECK(sense.turns(12, kVolume6 + 1));
  sense.add(0, -1 - kVolume6);
  sense.add(0, 2 * kVolume6);  // back
  CHECK(sense.has_turned(11));
  CHECK_FALSE(sense.has_turned(12));
  mesh.triangles.resize(10);  // of the first box, without the side x = 4
  ShellSense of_cell{HalfEdgeMesh(mesh.vertices, mesh.triangles, {{-9, -9, -9}, {4, 9, 9}})};
  CHECK_FALSE(of_cell.turns(0, -1000));
}

TEST_CASE("the gain of a fan is the change of the volume", "[quick][meshing]") {
  LatticeMesh box;
  add_box(box, cube(10));
  HalfEdgeMesh mesh(box);
  std::vector<FaceId> star;
  mesh.for_each_outgoing(0, [&](HalfEdgeId h) { star.push_back(HalfEdgeMesh::face(h)); });
  const LatticeCoord to{-14, -11, 3};
  const int128 before = mesh.volume6(), gain = fan_gain6(mesh, star, to);
  mesh.move(0, to);
  CHECK(gain != 0);
  CHECK(mesh.volume6() == before + gain);
}

TEST_CASE("sides are exact for points at three times the longest distance", "[quick][meshing]") {
  constexpr std::int64_t far = std::int64_t(3) << 31, n = (std::int64_t(1) << 62) - 1;
  CHECK(side_along({n, n, n}, {far, 1 - far, 0}) == 1);
  CHECK(side_along({n, n, n}, {far, -far, 0}) == 0);
  CHECK(side_along({n, n, n}, {far, -far - 1, 0}) == -1);
}

TEST_CASE("a vertex of a hundred thousand faces is connected in no time", "[quick][meshing]") {
  constexpr std::uint32_t kRim = 300000;
  constexpr double kSeconds = 10;  // half a second does; looked for in pairs, its edges take more than a minute
  std::vector<LatticeCoord> vertices = {{0, 0, 64}, {0, 0, -64}};
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < kRim; ++i) {
    vertices.push_back({std::int64_t(i), std::int64_t(i) * i % 1000, 0});
    const std::uint32_t a = 2 + i, b = 2 + (i + 1) % kRim;
    triangles.push_back({0, a, b});
    triangles.push_back({1, b, a});
  }
  std::shuffle(triangles.begin(), triangles.end(), std::mt19937(3));  // or twins would lie side by side
  const auto begin = std::chrono::steady_clock::now();
  const HalfEdgeMesh mesh(std::move(vertices), triangles, kEverywhere);
  CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < kSeconds);
  CHECK(mesh.valence(0) == int(kRim));
}
