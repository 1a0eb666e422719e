#include <random>

#include "lib/enclosed/enclosed_voxels.h"
#include "lib/quads/cell_quads.h"
#include "lib/quads/detail/enclosed_by_pairs.h"
#include "lib/tighten/proxy_editor.h"
#include "tests/support/lattice_boxes.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr std::int64_t kVoxel = kLatticePerVoxel;

/// 40 voxels to the side.
const EnclosedVoxels& block() {
  static MemoryShelf shelf;
  static const EnclosedVoxels enclosed = [] {
    fill_shelf(shelf, {{0, 0, 0}, {64, 64, 64}}, [](VoxelCoord p) {
      return std::min({p.x, p.y, p.z}) >= 10 && std::max({p.x, p.y, p.z}) < 50;
    });
    return EnclosedVoxels(shelf);
  }();
  return enclosed;
}

LatticeMesh box_around_block() {
  LatticeMesh mesh;
  add_box(mesh, {{9 * kVoxel, 9 * kVoxel, 9 * kVoxel}, {51 * kVoxel, 51 * kVoxel, 51 * kVoxel}});
  return mesh;
}

}  // namespace

TEST_CASE("a part that passes through itself in what must stay inside leaves no hole there", "[quick][meshing]") {
  LatticeMesh proxy = box_around_block();
  const LatticeCoord centre{30 * kVoxel, 30 * kVoxel, 30 * kVoxel};
  const VertexId apex = add_tetrahedron(proxy, centre + LatticeCoord{0, 0, 40}, centre.z, 300);
  HalfEdgeMesh mesh(proxy);
  ProxyEditor editor(mesh, block(), {});
  for (const std::int64_t below : {40, 90, 140}) REQUIRE(editor.move(apex, centre - LatticeCoord{0, 0, below}));
  CHECK(editor.sense().has_turned(FaceId(mesh.face_capacity() - 1)));
  SECTION("while it faces inwards") {}
  SECTION("nor when it has turned back") {
    REQUIRE(editor.move(apex, centre + LatticeCoord{0, 0, 40}));
  }
  editor.erase_inner_shells();
  CHECK(mesh.face_count() == 12);
  CHECK(mesh.volume6() == int128(6) * (42 * kVoxel) * (42 * kVoxel) * (42 * kVoxel));
}

TEST_CASE("a cavity that passes through itself is filled, and one that does not stays", "[quick][meshing]") {
  LatticeMesh proxy = box_around_block();
  const LatticeCoord place{30 * kVoxel, 30 * kVoxel, 50 * kVoxel + 32};  // between the block and the box
  const VertexId apex = add_tetrahedron(proxy, place - LatticeCoord{0, 0, 20}, place.z, 60);  // below: a cavity
  HalfEdgeMesh mesh(proxy);
  REQUIRE(mesh.volume6() < int128(6) * (42 * kVoxel) * (42 * kVoxel) * (42 * kVoxel));
  ProxyEditor editor(mesh, block(), {});
  const bool through = GENERATE(true, false);
  REQUIRE(editor.move(apex, place + LatticeCoord{0, 0, through ? 5 : -15}));
  editor.erase_inner_shells();
  CHECK(mesh.face_count() == (through ? 12 : 16));
}

TEST_CASE("no fin grows at the end of a beam: how far is far is told by its width", "[quick][meshing]") {
  LatticeMesh proxy = box_around_block();
  const LatticeCoord corner{40 * kVoxel, 8 * kVoxel, 108 * kVoxel};
  add_box(proxy, {{0, 0, 100 * kVoxel}, corner});
  HalfEdgeMesh mesh(proxy);
  ProxyEditor editor(mesh, block(), {});
  VertexId v = 0;
  while (mesh.position(v) != corner) ++v;
  CHECK_FALSE(editor.move(v, corner + LatticeCoord{0, 0, 3 * kVoxel}));
  CHECK(editor.counts().refused[Refusal::shape] == 1);
  CHECK(editor.move(v, corner + LatticeCoord{0, 0, kVoxel / 2}));
}

TEST_CASE("no step goes beyond its reach until that is loosened, and any goes inwards", "[quick][meshing]") {
  LatticeMesh proxy = box_around_block();  // a voxel away from it
  HalfEdgeMesh mesh(proxy);
  ShapeLimits limits;
  limits.reach = 2 * kVoxel;
  ProxyEditor editor(mesh, block(), limits);
  CHECK_FALSE(editor.loosen());  // nothing was in the way
  VertexId v = 0;
  const LatticeCoord corner{51 * kVoxel, 51 * kVoxel, 51 * kVoxel};
  while (mesh.position(v) != corner) ++v;
  const LatticeCoord out = corner + LatticeCoord{2 * kVoxel, 2 * kVoxel, 2 * kVoxel};
  CHECK_FALSE(editor.move(v, out));
  CHECK(editor.counts().beyond_reach == 1);
  int times = 0;
  while (!editor.move(v, out)) {
    REQUIRE(editor.loosen());
    ++times;
  }
  CHECK(times == 5);  // 3 sqrt(3) voxels, less what is_near() lets pass
  CHECK(editor.move(v, corner));
}

TEST_CASE("a reach is loosened to some times its length, and then there is none", "[quick][meshing]") {
  double reach = 10;
  for (int n = 0; n < 100 && reach > 0; ++n) {
    const double next = loosened(reach, 10);
    CHECK((next == 0 || next == ShapeLimits::kLoosened * reach));
    CHECK(next <= ShapeLimits::kLoosened * ShapeLimits::kMostLoosened * 10);
    reach = next;
  }
  CHECK(reach == 0);
}

TEST_CASE("undoing changes puts the mesh back, and later changes are tested as on a fresh one", "[quick][meshing]") {
  MemoryShelf cells;
  fill_shelf(cells, {{0, 0, 0}, {64, 64, 64}}, [](VoxelCoord p) {
    return std::min({p.x, p.y, p.z}) >= 4 && std::max({p.x, p.y, p.z}) < 56;
  });
  const LatticeMesh proxy = cube_quads(cells, {}, 16, std::nullopt).mesh;
  HalfEdgeMesh mesh(proxy), other(proxy);
  EnclosedByPairs enclosed(mesh, block()), of_other(other, block());
  for (EnclosedByPairs* one : {&enclosed, &of_other}) one->give_contacts(false), one->allow_flips(true);
  ProxyEditor editor(mesh, enclosed, {}), fresh(other, of_other, {});
  std::mt19937 random(3);
  const auto change = [&](ProxyEditor& e, std::uint32_t seed) {  // returns which of some changes were made
    std::mt19937 own(seed);
    std::vector<bool> made;
    for (int i = 0; i < 60; ++i) {
      const HalfEdgeId h = HalfEdgeId(own() % (3 * e.mesh().face_capacity()));
      const std::int64_t by = std::int64_t(own() % 40) - 20;
      const std::uint32_t kind = own() % 3;
      if (!e.mesh().alive(HalfEdgeMesh::face(h))) continue;
      const VertexId v = e.mesh().from(h);
      const LatticeCoord to = e.mesh().position(v) + LatticeCoord{by, -by, by};
      made.push_back(kind == 0 ? e.move(v, to) : kind == 1 ? e.collapse(h, to) : e.flip(h));
    }
    return made;
  };
  for (int round = 0; round < 20; ++round) {
    editor.begin_undo();
    const std::vector<bool> undone = change(editor, std::uint32_t(random()));
    REQUIRE(std::count(undone.begin(), undone.end(), true) > 5);
    editor.undo();
    editor.end_undo();
    const auto seed = std::uint32_t(random());
    CHECK(change(editor, seed) == change(fresh, seed));
    CHECK(mesh.face_count() == other.face_count());
    CHECK(mesh.compact({}).vertices == other.compact({}).vertices);
    CHECK(mesh.compact({}).triangles == other.compact({}).triangles);
    if (mesh.face_count() < 60) break;
  }
}
