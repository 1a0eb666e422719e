#include <set>

#include "lib/mesh/lattice_geometry.h"
#include "lib/mesh/space_order.h"
#include "lib/tighten/contact_forces.h"
#include "lib/tighten/face_blocks.h"
#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

namespace bp::test {

namespace {

/// Balls side by side, each a shell of its own.
LatticeMesh balls(int levels, int count) {
  LatticeMesh mesh;
  for (int k = 0; k < count; ++k) {
    const IndexedMesh ball = sphere(levels, 1000);
    const auto first = std::uint32_t(mesh.vertices.size());
    for (const Vec3d& p : ball.vertices) mesh.vertices.push_back(rounded(p) + LatticeCoord{3000 * k, 0, 0});
    for (const auto& [a, b, c] : ball.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
}

}  // namespace

TEST_CASE("blocks of a phase have no vertex in common, and few faces are in none", "[quick][meshing]") {
  const int levels = GENERATE(0, 2, 4), count = GENERATE(1, 40);
  CAPTURE(levels, count);
  HalfEdgeMesh mesh(balls(levels, count));
  FaceBlocks blocks(mesh);
  CHECK(blocks.count() == 1);
  CHECK(blocks.of(0) == 0);
  blocks.build(space_order(mesh.vertex_capacity(), [&](VertexId v) { return mesh.position(v); }));
  const std::size_t rest = blocks.count() - 1;
  std::vector<std::size_t> taken(blocks.count(), 0);
  blocks.for_each([&](std::size_t block) { ++taken[block]; });
  CHECK(std::set<std::size_t>(taken.begin(), taken.end()) == std::set<std::size_t>{1});
  const auto check = [&] {
    std::size_t left = 0;
    std::set<std::array<std::size_t, 3>> blocks_at;  // phase, vertex, block
    for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
      const std::size_t block = blocks.of(f);
      left += block == rest;
      for (HalfEdgeId h = 3 * f; h < 3 * f + 3 && block != rest; ++h)
        blocks_at.insert({block / (rest / 4), mesh.from(h), block});
    }
    std::set<std::array<std::size_t, 2>> places;
    for (const auto& [phase, v, block] : blocks_at) places.insert({phase, v});
    CHECK(places.size() == blocks_at.size());
    return left;
  };
  const std::size_t left = check();
  if (mesh.face_count() >= 1000) CHECK(10 * left <= mesh.face_count());
  for (HalfEdgeId h = 0; h < 3 * mesh.face_capacity(); h += 7) {
    if (mesh.can_flip(h)) mesh.flip(h);
  }
  static_cast<void>(check());
}

TEST_CASE("forces are found by face and point, the last ones only", "[quick][meshing]") {
  ContactForces forces;
  CHECK(forces.empty());
  CHECK(forces.of(3, 8) == 0);
  const std::vector<ContactForces::Force> some{{7, 1, 0.5F}, {2, 9, 2}, {7, 3, 4}}, others{{0, 1, 3}};
  forces.set(some, 8);
  CHECK(forces.of(7, 3) == 4);
  CHECK(forces.of(7, 1) == 0.5F);
  CHECK(forces.of(2, 9) == 2);
  CHECK(forces.of(2, 1) == 0);
  CHECK(forces.of(0, 1) == 0);
  forces.set(others, 8);
  CHECK(forces.of(7, 3) == 0);
  CHECK(forces.of(0, 1) == 3);
}

}  // namespace bp::test
