#include "lib/enclosed/enclosed_voxels.h"
#include "lib/enclosed/near_triangles.h"
#include "tests/catch.h"
#include "tests/support/random_lattice.h"
#include "tests/support/voxelized.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("a scene's triangles change no answer of its voxels to what is near outside", "[quick][meshing]") {
  RandomLattice random(11);
  const auto point = [&](double least, double most) {
    Vec3d p;
    for (double& x : p) x = random.real(least, most);
    return p;
  };
  int near = 0, large = 0, asked = 0;
  for (int i = 0; i < 12; ++i) {
    Triangles scene;
    for (int k = 0; k <= i % 4; ++k) scene.push_back({point(0, 40), point(0, 40), point(0, 40)});
    const Voxelized solid = voxelized(scene, 1);
    const EnclosedVoxels voxels(*solid.shelf);
    const NearTriangles triangles(scene, solid.header.frame);
    const auto in_lattice = [&](const Vec3d& p) {
      return rounded(double(kLatticePerVoxel) * solid.header.frame.to_voxels(p));
    };
    for (int k = 0; k < 300; ++k) {
      // About one of the triangles, and a few voxels off.
      const TriangleD& t = scene[std::size_t(random.between(0, std::int64_t(scene.size()) - 1))];
      const Vec3d off = point(-3, 3);
      std::array<LatticeCoord, 3> corners;
      for (std::size_t c = 0; c < 3; ++c) corners[c] = in_lattice(t[c] + (k % 2) * off + (k % 3) * point(-2, 2));
      const std::array<NewFace, 1> face{{{{}, corners}}};
      const double distance = double(random.between(1, 6)) * kLatticePerVoxel;
      const bool answer = voxels.is_near(face, distance);
      CHECK(voxels.is_near(face, distance, &triangles) == answer);
      std::uint32_t guess = 0;
      near += answer;
      large += answer && triangles.is_near(corners, distance, guess);
      ++asked;
    }
  }
  CHECK(near > asked / 4);  // both answers, and both ways to one of them
  CHECK(near < asked);
  CHECK(large > asked / 8);
  CHECK(large < near);
}
