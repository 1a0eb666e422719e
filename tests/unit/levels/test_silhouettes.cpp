#include "lib/levels/detail/silhouettes.h"
#include "tests/catch.h"
#include "tests/support/lattice_boxes.h"

using namespace bp;
using namespace bp::test;

namespace {

LatticeMesh mesh_of(const LatticeBox& box) {
  LatticeMesh mesh;
  add_box(mesh, box);
  return mesh;
}

}  // namespace

TEST_CASE("a box covers all of its silhouettes, and two boxes that hide each other count once", "[quick][levels]") {
  constexpr double kPixels = 0.02;
  const LatticeBox all{{-1000, 200, 0}, {3000, 1200, 2500}};
  const UpAxis up = GENERATE(UpAxis::y, UpAxis::z, UpAxis::minus_x);
  const Silhouettes silhouettes(all, up);
  const double whole = silhouettes.share(mesh_of(all));
  CHECK(whole == Approx(1).margin(kPixels));
  LatticeMesh two = mesh_of(all);
  add_box(two, {{0, 400, 500}, {1000, 800, 1000}});
  CHECK(silhouettes.share(two) == whole);
  const double part = silhouettes.share(mesh_of({{-1000, 200, 0}, {1000, 1200, 2500}}));
  CHECK(part < 0.9 * whole);
  CHECK(part > 0.4 * whole);
  CHECK(silhouettes.share({}) == 0);
}
