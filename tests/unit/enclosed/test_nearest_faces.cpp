#include <random>

#include "lib/enclosed/detail/nearest_faces.h"
#include "lib/enclosed/face_target.h"
#include "lib/mesh/lattice_geometry.h"
#include "tests/catch.h"

using namespace bp;

namespace {

constexpr std::int64_t kCubeEdge = 640;

/// Cubes of several sizes in a row of places.
LatticeMesh cubes(int number) {
  constexpr int kFaces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  LatticeMesh mesh;
  mesh.frame.voxel = 1;
  for (int n = 0; n < number; ++n) {
    const auto first = VertexId(mesh.vertices.size());
    const std::int64_t edge = kCubeEdge / (1 + n % 4);
    const LatticeCoord low = LatticeCoord{n % 3, n / 3 % 3, n / 9} * (kCubeEdge + 100);
    for (int i = 0; i < 8; ++i)
      mesh.vertices.push_back(low + LatticeCoord{(i & 1) * edge, (i >> 1 & 1) * edge, (i >> 2) * edge});
    for (const auto& f : kFaces) {
      Triangle t;
      for (std::size_t k = 0; k < 3; ++k) t[k] = first + VertexId(f[k]);
      mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

FaceId nearest(const Vec3d& p, const LatticeCoord& origin, const HalfEdgeMesh& mesh, double reach) {
  FaceId best = kNoId;
  double least = reach * reach;
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
    const double d = squared_distance(p, {to_double(mesh.corner(f, 0) - origin), to_double(mesh.corner(f, 1) - origin),
                                          to_double(mesh.corner(f, 2) - origin)});
    if (d < least || (d == least && best == kNoId)) {
      least = d;
      best = f;
    }
  }
  return best;
}

}  // namespace

TEST_CASE("searches that points share find the face that each is nearest to", "[quick][meshing]") {
  const HalfEdgeMesh mesh(cubes(27));
  const LatticeCoord origin{300, -20, 7};
  std::mt19937 random(7);
  std::vector<Vec3d> points;
  for (int i = 0; i < 4000; ++i) {  // some at corners, on edges, between two cubes
    Vec3d p;
    for (double& x : p) x = double(int(random() % 2600) - 200) - (i % 3 == 0 ? 0.0 : 0.37);
    points.push_back(p);
    if (i % 5 == 0) points.push_back(to_double(mesh.position(VertexId(random() % 216)) - origin));
  }
  const FaceTree tree(mesh);
  for (const double reach : {30.0, 320.0, 2000.0}) {
    const std::vector<FaceId> found = nearest_faces(points, origin, mesh, tree, reach);
    std::size_t wrong = 0, none = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      wrong += found[i] != nearest(points[i], origin, mesh, reach);
      none += found[i] == kNoId;
    }
    CHECK(wrong == 0);
    CHECK((none > 0) == (reach < 2000));
  }
}
