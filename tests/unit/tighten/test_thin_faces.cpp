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
