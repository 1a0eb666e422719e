#include "lib/hulls/convex_hull.h"
#include "lib/hulls/detail/solid_cell.h"
#include "lib/mesh/lattice_geometry.h"
#include "tests/catch.h"
#include "tests/support/lattice_boxes.h"
#include "tests/support/random_lattice.h"
#include "tests/unit/check/meshes.h"

namespace bp::test {

namespace {

LatticeMesh ball(double reach) {
  const IndexedMesh round = sphere(2, reach, {3, 5, 7});
  LatticeMesh mesh;
  for (const Vec3d& p : round.vertices) mesh.vertices.push_back(rounded(p));
  mesh.triangles = round.triangles;
  return mesh;
}

LatticeMesh hollow_box() {
  LatticeMesh mesh;
  add_box(mesh, {{0, 0, 0}, {100, 100, 100}});
  add_box(mesh, {{20, 20, 20}, {80, 80, 80}}, false);
  return mesh;
}

double hull_volume6(const SolidCell& cell, SolidCell::Rounding rounding) {
  const auto hull = hull_of(cell.points(rounding));
  return hull ? volume6_of(*hull) : 0;
}

}  // namespace

TEST_CASE("volumes of cells add up, and hulls of a convex solid's cells have just theirs", "[quick][meshing][lod]") {
  const auto seed = GENERATE(range(0u, 8u));
  RandomLattice random(seed);
  const SolidCell whole(ball(5000));
  CHECK(whole.volume6() == Approx(hull_volume6(whole, SolidCell::Rounding::nearest)));
  std::vector<SolidCell> cells{whole};
  for (int i = 0; i < 30; ++i) {
    const std::size_t k = std::size_t(random.between(0, std::int64_t(cells.size()) - 1));
    const int axis = int(random.between(0, 2));
    LatticeBox low = cells[k].cell(), high = low;
    if (low.max[axis] - low.min[axis] < 2) continue;
    low.max[axis] = random.between(low.min[axis], low.max[axis] - 1);
    high.min[axis] = low.max[axis] + 1;
    cells.push_back(cells[k].within(high));
    cells[k] = cells[k].within(low);
  }
  double sum = 0;
  for (const SolidCell& cell : cells) {
    sum += cell.volume6();
    const double outward = hull_volume6(cell, SolidCell::Rounding::outward), own = cell.volume6();
    const LatticeCoord side = cell.cell().max - cell.cell().min;
    const double strip =
        6 * 2.0 * 2 * double((side.x + 4) * (side.y + 4) + (side.y + 4) * (side.z + 4) + (side.z + 4) * (side.x + 4));
    CHECK(outward >= own * (1 - 1e-9) - 1);  // nothing is lost,
    CHECK(outward <= own + strip);           // and no more added than rounding may
  }
  CHECK(sum == Approx(whole.volume6()));
}

TEST_CASE("a cell within a solid is the cell, one outside is nothing", "[quick][meshing][lod]") {
  const SolidCell whole(hollow_box());
  CHECK(whole.volume6() == Approx(6 * (100.0 * 100 * 100 - 60.0 * 60 * 60)));
  const SolidCell wall = whole.within({{5, 5, 5}, {15, 90, 90}});
  CHECK(wall.volume6() == Approx(6 * 11.0 * 86 * 86));
  const auto hull = hull_of(wall.points(SolidCell::Rounding::outward));
  REQUIRE(hull);
  const LatticeBox box = box_of(hull->vertices);
  CHECK(box.min == LatticeCoord{4, 4, 4});  // around half a unit beyond
  CHECK(box.max == LatticeCoord{16, 91, 91});
  const SolidCell inside = whole.within({{25, 25, 25}, {75, 75, 75}});
  CHECK(inside.points(SolidCell::Rounding::outward).empty());
  CHECK(inside.volume6() == Approx(0).margin(1e-6));
  CHECK(whole.holds({10, 10, 10}));
  CHECK_FALSE(whole.holds({50, 50, 50}));
  CHECK_FALSE(whole.holds({50, 50, 120}));
}

TEST_CASE("cuts are offered beside level faces, with what is level on one side as a whole", "[quick][meshing][lod]") {
  std::vector<std::int64_t> places;
  for (const SolidCell::Step& step : SolidCell(hollow_box()).steps(0)) places.push_back(step.at);
  CHECK(places == std::vector<std::int64_t>{20, 79});
}

}  // namespace bp::test
