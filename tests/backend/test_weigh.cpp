#include <cmath>
#include <limits>
#include <random>

#include "lib/core/box.h"
#include "tests/backend/available_backends.h"
#include "tests/catch.h"
#include "tests/support/cages.h"

using namespace bp;
using namespace bp::test;

namespace {

using Place = CoordinateRows::Place;

/// Points inside and outside, on vertices, edges and faces and next to them, far away, and not finite.
std::vector<Vec3d> hard_points(const IndexedMesh& cage, std::size_t random_ones) {
  Bounds3d bounds;
  for (const Vec3d& v : cage.vertices) bounds.add(v);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> share(-0.2, 1.2);
  std::vector<Vec3d> points(cage.vertices.begin(), cage.vertices.begin() + 4);
  for (std::size_t f = 0; f < 6; ++f) {
    const auto& t = cage.triangles[f];
    const Vec3d &a = cage.vertices[t[0]], &b = cage.vertices[t[1]], &c = cage.vertices[t[2]];
    for (const double away : {0.0, 1e-10, 1e-7}) {
      Vec3d face{}, edge{};
      for (std::size_t i = 0; i < 3; ++i) {
        face[i] = 0.25 * a[i] + 0.25 * b[i] + 0.5 * c[i] + away;
        edge[i] = 0.5 * (a[i] + b[i]) - away;
      }
      points.push_back(face), points.push_back(edge);
    }
  }
  const double huge = std::numeric_limits<double>::infinity();
  for (const Vec3d& p : {Vec3d{std::nan(""), 0, 0}, {0, huge, 0}, {100, 0, 0}, {1e5, 1, 1}}) points.push_back(p);
  for (std::size_t n = 0; n < random_ones; ++n) {
    Vec3d p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = bounds.min[i] + share(random) * (bounds.max[i] - bounds.min[i]);
    points.push_back(p);
  }
  return points;
}

struct Weighed {
  WeightBlock block;
  std::vector<Place> places;
};

Weighed weigh(Backend& backend, const CageCoordinates& coordinates, const std::vector<Vec3d>& points) {
  Weighed out{WeightBlock(points.size(), coordinates.columns()), std::vector<Place>(points.size())};
  backend.weigh(coordinates, points, true, out.block, out.places);
  return out;
}

}  // namespace

TEST_CASE("coordinates of cages have the same bits on each backend, also where points are hard", "[quick][backend]") {
  const auto backends = available_backends();
  for (const CoordinateKind kind :
       {CoordinateKind::mean_value, CoordinateKind::green, CoordinateKind::maximum_likelihood}) {
    for (const NamedCage& cage : hostile_cages()) {
      CAPTURE(cage.name, int(kind));
      const CageCoordinates coordinates(make_cage(cage.mesh, cage.name), kind);
      const std::vector<Vec3d> points = hard_points(cage.mesh, 150);
      const Weighed want = weigh(*backends.front(), coordinates, points);
      for (const auto& backend : backends) {
        CAPTURE(backend->name());
        const Weighed got = weigh(*backend, coordinates, points);
        CHECK((got.places == want.places));
        CHECK(got.block.bits == want.block.bits);
        REQUIRE(got.block.units == want.block.units);
      }
    }
  }
}

TEST_CASE("points outside a cage get no weights if they are to be refused", "[quick][backend]") {
  const CageCoordinates coordinates(make_cage(sphere_cage(5, 6), "sphere"));
  const std::vector<Vec3d> points{{0.1, 0, 0.2}, {3, 0, 0}, {1e300, 0, 0}};  // the last one is too far to follow
  for (const auto& backend : available_backends()) {
    CAPTURE(backend->name());
    WeightBlock block(points.size(), coordinates.columns());
    std::vector<Place> places(points.size());
    backend->weigh(coordinates, points, false, block, places);
    CHECK((places == std::vector{Place::inside, Place::outside, Place::outside}));
  }
}
