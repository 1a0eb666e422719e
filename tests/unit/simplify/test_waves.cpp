#include <algorithm>
#include <set>

#include "lib/simplify/waves.h"
#include "lib/surface/surface.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

namespace {

HalfEdgeMesh surface_of_ball() {
  MemoryShelf shelf;
  fill_shelf(shelf, {{-9, -9, -9}, {9, 9, 9}}, [](VoxelCoord p) { return p.x * p.x + p.y * p.y + p.z * p.z < 70; });
  return HalfEdgeMesh(dense_surface(shelf, {}));
}

std::set<VertexId> star_of(const HalfEdgeMesh& mesh, VertexId v) {
  std::set<VertexId> star{v};
  mesh.for_each_outgoing(v, [&](HalfEdgeId h) { star.insert(mesh.to(h)); });
  return star;
}

EditBoxes boxes_at(std::int64_t x, std::int64_t y) {
  EditBoxes boxes;  // along the two legs of a corner
  boxes.add({{x, y, 0}, {x + 10, y + 1, 1}});
  boxes.add({{x, y, 0}, {x + 1, y + 10, 1}});
  return boxes;
}

}  // namespace

TEST_CASE("stars that a wave claims have no vertex in common, and the others touch one of them", "[quick][meshing]") {
  const HalfEdgeMesh mesh = surface_of_ball();
  WaveClaims claims(mesh);
  for (int wave = 0; wave < 2; ++wave) {
    claims.begin();
    std::set<VertexId> claimed;
    for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) {
      const std::set<VertexId> star = star_of(mesh, v);
      const bool free = std::none_of(star.begin(), star.end(), [&](VertexId w) { return claimed.count(w) > 0; });
      REQUIRE(claims.star_is_free(v) == free);
      if (!free) continue;
      claims.claim();
      claimed.insert(star.begin(), star.end());
    }
    CHECK(claimed.size() > mesh.vertex_capacity() / 3);
  }
}

TEST_CASE("an edit waits if a new face of it may meet one that the wave has made", "[quick][meshing]") {
  WaveBoxes made;
  made.begin();
  CHECK(made.add(boxes_at(0, 0)));
  CHECK(made.add(boxes_at(3, 3)));  // in the corner: the boxes around all meet, those of the faces do not
  CHECK_FALSE(made.add(boxes_at(5, -5)));
  made.begin();
  CHECK(made.add(boxes_at(5, -5)));
}

TEST_CASE("each item of a loop of workers has its turn once", "[quick]") {
  struct Worker {};
  WaveWorkers<Worker> workers([] { return std::make_unique<Worker>(); });
  std::vector<int> turns(1000, 0);
  workers.for_each(turns.size(), 3, [&](Worker&, std::size_t i) { ++turns[i]; });
  CHECK(std::count(turns.begin(), turns.end(), 1) == 1000);
}
