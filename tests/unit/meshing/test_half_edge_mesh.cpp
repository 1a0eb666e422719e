#include "lib/core/error.h"
#include "lib/meshing/shells.h"
#include "lib/meshing/surface.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

namespace {

/// An axis-aligned box as 12 triangles, outward, or inward.
void add_box(LatticeMesh& mesh, const LatticeBox& box, bool outward = true) {
  const auto first = std::uint32_t(mesh.vertices.size());
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back(
        {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z});
  }
  const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    for (int i = 1; i < 3; ++i) {
      Triangle t{first + q[0], first + q[i], first + q[i + 1]};
      if (!outward) std::swap(t[1], t[2]);
      mesh.triangles.push_back(t);
    }
  }
}

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
