#include <algorithm>
#include <array>

#include "lib/enclosed/enclosed_voxels.h"
#include "lib/enclosed/near_triangles.h"
#include "lib/mesh/lattice_geometry.h"
#include "tests/catch.h"
#include "tests/support/random_lattice.h"
#include "tests/support/voxelized.h"

using namespace bp;

namespace {

constexpr int kSteps = 24;  // of the net

/// The largest distance of a fine net of points of a face from the nearest triangle, lattice units.
double farthest(const std::array<LatticeCoord, 3>& face, const std::vector<TriangleD>& scene) {
  double most = 0;
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; i + k <= kSteps; ++k) {
      const double a = double(i) / kSteps, b = double(k) / kSteps;
      const Vec3d p = a * to_double(face[0]) + b * to_double(face[1]) + (1 - a - b) * to_double(face[2]);
      double nearest = HUGE_VAL;
      for (const TriangleD& t : scene) nearest = std::min(nearest, distance_squared(p, t));
      most = std::max(most, std::sqrt(nearest));
    }
  }
  return most;
}

double longest_edge(const std::array<LatticeCoord, 3>& face) {
  const auto edge = [&](std::size_t k) { return length(to_double(face[(k + 1) % 3] - face[k])); };
  return std::max({edge(0), edge(1), edge(2)});
}

}  // namespace

TEST_CASE("triangles tell what is near them, as a net of points on a face does", "[quick][meshing]") {
  constexpr double kDiagonal = 1.74 * kLatticePerVoxel;  // of a voxel
  bp::test::RandomLattice random(11);
  const auto point = [&](double least, double most) {
    Vec3d p;
    for (double& x : p) x = random.real(least, most);
    return p;
  };
  int near = 0, far = 0, several = 0, voxels_near = 0, asked = 0;
  for (int i = 0; i < 12; ++i) {
    std::vector<TriangleD> scene;
    for (int k = 0; k <= i % 4; ++k) scene.push_back({point(0, 40), point(0, 40), point(0, 40)});
    // The other half of a square, so that a face may lie across both.
    const TriangleD& first = scene[0];
    scene.push_back({first[1], first[0], first[0] + first[1] - first[2]});
    const bp::test::Voxelized solid = bp::test::voxelized(scene, 1);
    const EnclosedVoxels voxels(*solid.shelf);
    const GridFrame& frame = solid.header.frame;
    const NearTriangles triangles(scene, frame);
    std::vector<TriangleD> in_lattice = scene;
    for (TriangleD& t : in_lattice) {
      for (Vec3d& p : t) p = frame.to_lattice(p);
    }
    for (int k = 0; k < 100; ++k) {
      // About one of the triangles or across the square, and a few voxels off.
      const TriangleD& t = scene[std::size_t(random.between(0, std::int64_t(scene.size()) - 1))];
      const bool across = k % 4 == 0;
      const TriangleD about = across ? TriangleD{first[2], first[0], first[0] + first[1] - first[2]} : t;
      const Vec3d off = point(-3, 3);
      std::array<LatticeCoord, 3> corners;
      for (std::size_t c = 0; c < 3; ++c)
        corners[c] = rounded(frame.to_lattice(about[c] + (k % 2) * off + (k % 3) * point(-2, 2)));
      const std::array<NewFace, 1> face{{{{}, corners}}};
      const double distance = double(random.between(1, 6)) * kLatticePerVoxel, counted = distance + kDiagonal / 2;
      const double at = farthest(corners, in_lattice), missed = longest_edge(corners) / kSteps;
      const bool answer = triangles.is_near(face, distance);
      if (at + missed <= counted) CHECK(answer);
      if (at > NearTriangles::kUpTo * counted) CHECK_FALSE(answer);
      // Voxels hold the triangles, and each holds a point of one.
      const bool by_voxels = voxels.is_near(face, distance);
      if (answer) CHECK(voxels.is_near(face, NearTriangles::kUpTo * counted + 2 * kDiagonal));
      if (by_voxels) CHECK(triangles.is_near(face, distance + 2 * kDiagonal));
      voxels_near += by_voxels;
      ++asked;
      near += at + missed <= counted;
      far += at > NearTriangles::kUpTo * counted;
      several += across && at + missed <= counted;
    }
  }
  CHECK(near > 100);
  CHECK(far > 100);
  CHECK(several > 20);
  CHECK(voxels_near > asked / 4);  // both answers
  CHECK(voxels_near < asked);
}
