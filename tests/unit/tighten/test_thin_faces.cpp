#include <random>

#include "lib/enclosed/enclosed_triangles.h"
#include "lib/tighten/detail/thin_faces.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr std::int64_t kSide = 10000, kNear = 20;  // lattice units

/// A box whose top has a vertex kNear beside its diagonal, `lift` above the top. The face between both is thin, with an
/// angle of nearly 180 degrees.
LatticeMesh box_with_thin_face(std::int64_t lift) {
  LatticeMesh mesh;
  for (const std::int64_t z : {std::int64_t(0), kSide}) {
    for (const auto& [x, y] : {std::pair{std::int64_t(0), std::int64_t(0)},
                               {kSide, std::int64_t(0)},
                               {kSide, kSide},
                               {std::int64_t(0), kSide}})
      mesh.vertices.push_back({x, y, z});
  }
  mesh.vertices.push_back({kSide / 2, kSide / 2 - kNear, kSide + lift});
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7},
                    {2, 7, 6}, {3, 0, 4}, {3, 4, 7}, {4, 5, 8}, {5, 6, 8}, {6, 4, 8}, {4, 6, 7}};
  return mesh;
}

/// A triangle in the middle of the box.
std::vector<TriangleD> inner_triangle(const GridFrame& frame) {
  const auto at = [&](std::int64_t x, std::int64_t y) { return frame.world({x, y, kSide / 2}); };
  return {{at(2000, 2000), at(8000, 2000), at(2000, 8000)}};
}

double area_of(const HalfEdgeMesh& mesh) {
  double area = 0;
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
    if (mesh.alive(f)) area += bp::area_of(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2));
  }
  return area;
}

/// A box whose sides are divided at random: each new vertex lies in a face, and up to two lattice units above it.
LatticeMesh box_of_thin_faces(unsigned seed) {
  std::mt19937 random(seed);
  LatticeMesh mesh = box_with_thin_face(0);
  for (int k = 0; k < 60; ++k) {
    const std::size_t f = random() % mesh.triangles.size();
    const auto [a, b, c] = mesh.triangles[f];
    const std::int64_t s = 1 + random() % 98, t = 1 + random() % (99 - s);
    const LatticeCoord &pa = mesh.vertices[a], &pb = mesh.vertices[b], &pc = mesh.vertices[c];
    LatticeCoord p = pa * (100 - s - t) + pb * s + pc * t;
    for (int i = 0; i < 3; ++i) p[i] = p[i] / 100 + std::int64_t(random() % 3) * (p[i] > 50 * kSide ? 1 : -1);
    const auto v = VertexId(mesh.vertices.size());
    mesh.vertices.push_back(p);
    mesh.triangles[f] = {a, b, v};
    mesh.triangles.push_back({b, c, v});
    mesh.triangles.push_back({c, a, v});
  }
  return mesh;
}

double worst_quality(const HalfEdgeMesh& mesh) {
  double worst = 1;
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
    if (mesh.alive(f))
      worst = std::min(worst, triangle_quality(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)));
  }
  return worst;
}

}  // namespace

TEST_CASE("the long edge of a thin face is flipped, if that adds little", "[quick][meshing]") {
  const GridFrame frame;
  const EnclosedTriangles enclosed(inner_triangle(frame), frame);
  const std::int64_t lift = GENERATE(-3, 0, 3);  // the long edge is convex, flat or reflex
  CAPTURE(lift);
  const LatticeMesh proxy = box_with_thin_face(lift);
  REQUIRE(self_intersections(proxy) == 0);
  HalfEdgeMesh mesh(proxy);
  ProxyEditor editor(mesh, enclosed, {});
  REQUIRE(worst_quality(mesh) < 0.02);
  const int128 before = mesh.volume6();
  const double most = 1e-4 * double(before) / 6;
  CHECK(flip_thin_faces(editor, most) == 1);
  CHECK(worst_quality(mesh) > 0.5);
  CHECK(double(mesh.volume6() - before) / 6 < most);
  CHECK(self_intersections(mesh.compact(frame)) == 0);
  CHECK(flip_thin_faces(editor, most) == 0);
}

TEST_CASE("a thin face stays where a flip would add more than it may", "[quick][meshing]") {
  const GridFrame frame;
  const EnclosedTriangles enclosed(inner_triangle(frame), frame);
  HalfEdgeMesh mesh(box_with_thin_face(3));
  ProxyEditor editor(mesh, enclosed, {});
  CHECK(flip_thin_faces(editor, 1) == 0);
  CHECK(worst_quality(mesh) < 0.02);
}

TEST_CASE("flips of thin faces make no fins", "[quick][meshing]") {
  const GridFrame frame;
  const EnclosedTriangles enclosed(inner_triangle(frame), frame);
  std::uint64_t flips = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    const LatticeMesh proxy = box_of_thin_faces(seed);
    if (self_intersections(proxy) != 0) continue;
    HalfEdgeMesh mesh(proxy);
    ProxyEditor editor(mesh, enclosed, {});
    const double before = area_of(mesh);
    flips += flip_thin_faces(editor, 1e-4 * double(mesh.volume6()) / 6);
    CHECK(area_of(mesh) < 1.001 * before);
    CHECK(self_intersections(mesh.compact(frame)) == 0);
  }
  CHECK(flips > 200);
}
