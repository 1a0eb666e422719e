#include <limits>

#include "lib/simplify/detail/collapse.h"
#include "lib/simplify/detail/collapse_planner.h"
#include "tests/support/lattice_boxes.h"
#include "tests/support/proxy_checks.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();

LatticeMesh planned_ball() {
  LatticeMesh mesh;
  const IndexedMesh ball = sphere(2, 1000);
  for (const Vec3d& p : ball.vertices) mesh.vertices.push_back(rounded(p));
  for (const auto& [a, b, c] : ball.triangles) mesh.triangles.push_back({a, b, c});
  return mesh;
}

/// An enclosed set that gives the same answer to all changes.
class OneAnswer final : public Enclosed {
 public:
  explicit OneAnswer(bool answer) : answer_(answer) {}
  bool allows(std::span<const NewFace>, std::span<const Tetrahedron>, Blocker*) const override { return answer_; }
  [[nodiscard]] std::vector<Vec3d> contact_points(const LatticeCoord&, const LatticeBox&) const override { return {}; }
  [[nodiscard]] std::uint64_t bytes() const override { return 0; }

 private:
  bool answer_;
};

/// Plans each edge of the mesh: see(edge, plan).
template <class See>
void plan_all(HalfEdgeMesh& mesh, const SimplifyParams& params, const See& see) {
  SimplifyCounts counts;
  const Collapser collapser(mesh, {}, params, counts);
  CollapsePlanner planner(collapser.ground());
  for (HalfEdgeId h = 0; h < 3 * mesh.face_capacity(); ++h) {
    if (mesh.edge(h) != h) continue;
    CollapsePlan plan;
    planner.plan(h, kAny, plan);
    if (plan.outcome == CollapsePlan::Outcome::allowed) {
      CAPTURE(h);
      CHECK(plan.cost >= planner.lower_bound(h) * (1 - 1e-9) - 1e-6);
    }
    see(h, plan);
  }
}

LatticeMesh collapsed(HalfEdgeMesh mesh, HalfEdgeId h, const LatticeCoord& to) {
  mesh.collapse(h, to);
  return mesh.compact(GridFrame{});
}

bool is_outside_all(const HalfEdgeMesh& mesh, HalfEdgeId h, const LatticeCoord& p) {
  bool outside = true;
  for (const VertexId v : {mesh.from(h), mesh.to(h)}) {
    mesh.for_each_outgoing(v, [&](HalfEdgeId g) {
      const FaceId f = HalfEdgeMesh::face(g);
      outside = outside && orient3d(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2), p) >= 0;
    });
  }
  return outside;
}

}  // namespace

TEST_CASE("every edge of a ball may collapse outwards", "[quick][meshing]") {
  HalfEdgeMesh mesh(planned_ball());
  int edges = 0;
  plan_all(mesh, {}, [&](HalfEdgeId h, const CollapsePlan& plan) {
    CAPTURE(h, int(plan.refusal));
    REQUIRE(plan.outcome == CollapsePlan::Outcome::allowed);
    CHECK(plan.swallowed.empty());
    CHECK(is_outside_all(mesh, h, plan.position));
    if (++edges % 8 == 0) CHECK(self_intersections(collapsed(mesh, h, plan.position)) == 0);
  });
  CHECK(edges == 192);
}

TEST_CASE("a collapse is refused for what lies in its way, and only then", "[quick][meshing]") {
  std::map<HalfEdgeId, LatticeCoord> places;
  HalfEdgeMesh alone(planned_ball());
  plan_all(alone, {}, [&](HalfEdgeId h, const CollapsePlan& plan) { places[h] = plan.position; });
  LatticeMesh both = planned_ball();
  const std::int64_t out = GENERATE(940, 1010, 1060);  // a wall beside the ball, and small boxes next to it
  add_box(both, {{out + 70, -900, -900}, {out + 100, 900, 900}});
  for (int i = 0; i < 6; ++i) add_box(both, {{-600 + 200 * i, 1005, -20}, {-560 + 200 * i, 1025, 20}});
  HalfEdgeMesh mesh(both);
  int met = 0, swallowing = 0;
  plan_all(mesh, {}, [&](HalfEdgeId h, const CollapsePlan& plan) {
    const auto place = places.find(h);
    if (place == places.end() || HalfEdgeMesh::face(h) >= alone.face_capacity()) return;
    const bool free = self_intersections(collapsed(mesh, h, place->second)) == 0;
    const bool allowed = plan.outcome == CollapsePlan::Outcome::allowed;
    CAPTURE(h, free, int(plan.refusal));
    REQUIRE(allowed == free);
    met += !free;
    swallowing += allowed && !plan.swallowed.empty();
    if (!allowed) CHECK(plan.refusal == Refusal::guard);
    if (allowed) CHECK(plan.position == place->second);
  });
  CHECK(met + swallowing > 0);
}

TEST_CASE("a set that refuses all changes leaves collapses that grow the solid", "[quick][meshing]") {
  const OneAnswer nothing(false), anything(true);
  HalfEdgeMesh mesh(planned_ball());
  SimplifyParams params;
  params.enclosed = &nothing;
  plan_all(mesh, params, [&](HalfEdgeId h, const CollapsePlan& plan) {
    CAPTURE(h, int(plan.refusal));
    REQUIRE(plan.outcome == CollapsePlan::Outcome::allowed);
    CHECK(is_outside_all(mesh, h, plan.position));
  });
  params.enclosed = &anything;
  int inwards = 0;
  plan_all(mesh, params, [&](HalfEdgeId h, const CollapsePlan& plan) {
    REQUIRE(plan.outcome == CollapsePlan::Outcome::allowed);
    inwards += !is_outside_all(mesh, h, plan.position);
  });
  CHECK(inwards > 150);  // the free minimum lies within the ball
}
