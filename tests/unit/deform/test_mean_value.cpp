#include <random>

#include "lib/core/box.h"
#include "lib/core/error.h"
#include "lib/core/vec3.h"
#include "lib/deform/detail/raw_weights.h"
#include "lib/deform/mean_value.h"
#include "lib/geometry/crossing.h"
#include "tests/catch.h"
#include "tests/reference/mean_value.h"
#include "tests/support/cages.h"

using namespace bp;
using namespace bp::test;
using Place = CoordinateRows::Place;

namespace {

struct Probe {
  std::vector<double> weights;
  Place place;
};

Probe probe(const MeanValueCoordinates& coordinates, const Vec3d& p) {
  CoordinateRows rows;
  coordinates.evaluate(std::span(&p, 1), rows);
  return {rows.weights, rows.places[0]};
}

double diagonal(const IndexedMesh& m) {
  Bounds3d bounds;
  for (const Vec3d& v : m.vertices) bounds.add(v);
  return bounds.diagonal();
}

int winding(const IndexedMesh& m, const Vec3d& p) {
  int sum = 0;
  for (const auto& t : m.triangles) sum += crossing_above({m.vertices[t[0]], m.vertices[t[1]], m.vertices[t[2]]}, p);
  return sum;
}

std::vector<Vec3d> random_points(const IndexedMesh& m, std::size_t n, double grown = 1) {
  Bounds3d bounds;
  for (const Vec3d& v : m.vertices) bounds.add(v);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(0.5 - grown / 2, 0.5 + grown / 2);
  std::vector<Vec3d> points(n);
  for (Vec3d& p : points) {
    for (std::size_t i = 0; i < 3; ++i) p[i] = bounds.min[i] + share(random) * (bounds.max[i] - bounds.min[i]);
  }
  return points;
}

/// On each face, its edges and corners, and from 0.1 to 1e-16 diagonals to either side.
std::vector<Vec3d> points_near_faces(const IndexedMesh& m) {
  std::vector<Vec3d> points;
  const double size = diagonal(m);
  for (const auto& t : m.triangles) {
    const Vec3d &a = m.vertices[t[0]], &b = m.vertices[t[1]], &c = m.vertices[t[2]];
    const Vec3d normal = cross(b - a, c - a), unit = (1 / length(normal)) * normal;
    for (const auto& s :
         {std::array{1.0, 0.0, 0.0}, {0.5, 0.5, 0.0}, {0.4, 0.3, 0.3}, {0.98, 0.01, 0.01}, {0.5, 0.499999, 1e-6}}) {
      const Vec3d on = s[0] * a + s[1] * b + s[2] * c;
      points.push_back(on);
      for (double away = 0.1; away > 1e-17; away *= 0.1) {
        points.push_back(on - (away * size) * unit);
        points.push_back(on + (away * size) * unit);
      }
    }
  }
  return points;
}

void check_reproduction(const IndexedMesh& m, const Vec3d& p, const std::vector<double>& w) {
  double sum = 0;
  Vec3d missing = p;
  for (std::size_t v = 0; v < w.size(); ++v) sum += w[v], missing = missing - w[v] * m.vertices[v];
  REQUIRE(std::abs(sum - 1) < 1e-9);
  REQUIRE(length(missing) < 1e-9 * diagonal(m));
}

}  // namespace

TEST_CASE("coordinates sum to 1 and reproduce the point, anywhere", "[deform][quick]") {
  for (const NamedCage& cage : hostile_cages()) {
    INFO(cage.name);
    const MeanValueCoordinates coordinates(make_cage(cage.mesh, cage.name));
    std::vector<Vec3d> points = points_near_faces(cage.mesh);
    for (const Vec3d& p : random_points(cage.mesh, 500, 3)) points.push_back(p);
    points.insert(points.end(), cage.mesh.vertices.begin(), cage.mesh.vertices.end());
    for (const Vec3d& p : points) {
      INFO(p[0] << " " << p[1] << " " << p[2]);
      check_reproduction(cage.mesh, p, probe(coordinates, p).weights);
    }
  }
}

TEST_CASE("the weights reproduce a point to 1e-6 before that is enforced", "[deform][quick]") {
  for (const NamedCage& named : hostile_cages()) {
    INFO(named.name);
    const Cage cage = make_cage(named.mesh, named.name);
    std::vector<Vec3d> points = points_near_faces(named.mesh);
    for (const Vec3d& p : random_points(named.mesh, 500)) points.push_back(p);
    detail::RawScratch scratch;
    std::size_t slow = 0, checked = 0;
    for (const Vec3d& scene_point : points) {
      const Vec3d p = cage.to_cage(scene_point);
      if (winding(named.mesh, scene_point) != 1) continue;
      bool near = false;
      for (const auto& f : cage.faces)
        near = near || distance_squared(p, TriangleD{cage.vertices[f.corner[0]], cage.vertices[f.corner[1]],
                                                     cage.vertices[f.corner[2]]}) < 4e-18;
      if (near) continue;
      detail::WideVec four{};
      for (int k = 0; k < detail::kWide; ++k) four.x[k] = p[0], four.y[k] = p[1], four.z[k] = p[2];
      std::vector<double> weights(cage.vertices.size());
      if (detail::raw_weights(cage, four, scratch) != 0) {
        ++slow;
        detail::raw_weights_slowly(cage, p, weights);
      } else {
        for (std::size_t v = 0; v < weights.size(); ++v) weights[v] = scratch.vertices[v].sum[0];
      }
      double sum = 0;
      Vec3d moment{};
      for (std::size_t v = 0; v < weights.size(); ++v)
        sum += weights[v], moment = moment + weights[v] * cage.vertices[v];
      INFO(scene_point[0] << " " << scene_point[1] << " " << scene_point[2]);
      CHECK(length((1 / sum) * moment - p) < 1e-6);
      ++checked;
    }
    CHECK(checked > 100);
    CHECK(slow < checked / 2);
  }
}

TEST_CASE("coordinates are those of the paper", "[deform][quick]") {
  for (const char* name : {"cube", "L", "concave", "spikes", "sphere"}) {
    for (const NamedCage& cage : hostile_cages()) {
      if (cage.name != name) continue;
      INFO(name);
      const MeanValueCoordinates coordinates(make_cage(cage.mesh, name));
      std::vector<double> expected;
      for (const Vec3d& p : random_points(cage.mesh, 300)) {
        if (winding(cage.mesh, p) != 1) continue;
        reference::mean_value(cage.mesh, p, expected);
        const Probe found = probe(coordinates, p);
        for (std::size_t v = 0; v < expected.size(); ++v) REQUIRE(std::abs(found.weights[v] - expected[v]) < 1e-6);
      }
    }
  }
}

TEST_CASE("on a face the coordinates are those of the face, and near it nearly so", "[deform][quick]") {
  for (const NamedCage& cage : hostile_cages()) {
    if (cage.name == "needle" || cage.name == "plate") continue;  // other faces are as near
    INFO(cage.name);
    const MeanValueCoordinates coordinates(make_cage(cage.mesh, cage.name));
    for (const auto& t : cage.mesh.triangles) {
      const Vec3d &a = cage.mesh.vertices[t[0]], &b = cage.mesh.vertices[t[1]], &c = cage.mesh.vertices[t[2]];
      const Vec3d normal = cross(b - a, c - a), inwards = (-1 / length(normal)) * normal;
      for (const double away : {0.0, 1e-15, 1e-12, 1e-10, 1e-8, 1e-6}) {
        const Vec3d p = 0.2 * a + 0.5 * b + 0.3 * c + away * inwards;
        const Probe found = probe(coordinates, p);
        if (away > 1e-11) CHECK(found.place == Place::inside);
        const double room = 1e-8 + 500 * away;
        CHECK(std::abs(found.weights[t[0]] - 0.2) < room);
        CHECK(std::abs(found.weights[t[1]] - 0.5) < room);
        CHECK(std::abs(found.weights[t[2]] - 0.3) < room);
      }
    }
  }
}

TEST_CASE("the sign of the sum tells the inside from the outside, as exact crossings do", "[deform][quick]") {
  for (const NamedCage& cage : hostile_cages()) {
    INFO(cage.name);
    const MeanValueCoordinates coordinates(make_cage(cage.mesh, cage.name));
    for (const Vec3d& p : random_points(cage.mesh, 2000, 4)) {
      const Place expected = winding(cage.mesh, p) == 1 ? Place::inside : Place::outside;
      REQUIRE((probe(coordinates, p).place == expected));
    }
  }
}

TEST_CASE("a cage that faces inwards is turned, and coordinates do not depend on their neighbours", "[deform][quick]") {
  IndexedMesh inwards = sphere_cage(6, 7, 0.2);
  const MeanValueCoordinates right(make_cage(inwards, "right"));
  for (auto& t : inwards.triangles) std::swap(t[0], t[1]);
  const MeanValueCoordinates turned(make_cage(inwards, "turned"));
  std::vector<Vec3d> points = random_points(inwards, 101, 1.2);
  points[50] = {std::nan(""), 0, 0};
  points[51] = inwards.vertices[3];
  CoordinateRows all;
  right.evaluate(points, all);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Probe alone = probe(right, points[i]), other = probe(turned, points[i]);
    CHECK((alone.place == all.places[i]));
    CHECK((alone.place == other.place));
    for (std::size_t v = 0; v < alone.weights.size(); ++v) {
      CHECK(alone.weights[v] == all.row(i)[v]);
      CHECK(std::abs(alone.weights[v] - other.weights[v]) < 1e-12);
    }
  }
  CHECK((all.places[50] == Place::nowhere));
  CHECK((all.places[51] == Place::inside));
}

TEST_CASE("what is no cage is refused", "[deform][quick]") {
  const auto refused = [](const IndexedMesh& m, const char* why) {
    CHECK_THROWS_WITH(make_cage(m, "c.obj"), ContainsSubstring(why));
  };
  IndexedMesh open = sphere_cage(4, 5);
  open.triangles.pop_back();
  refused(open, "3 edges are open");
  IndexedMesh torn = sphere_cage(4, 5);
  std::swap(torn.triangles[3][0], torn.triangles[3][1]);
  refused(torn, "face both ways");
  refused({}, "has no faces");
  refused(sphere_cage(260, 260), "65536 vertices and 262144 triangles at most, and this one 67342 and 134680");
  IndexedMesh flat = prism({{0, 0}, {1, 0}, {1, 1}}, 0);
  refused(flat, "without volume");
  IndexedMesh broken = sphere_cage(4, 5);
  broken.vertices[2][1] = std::nan("");
  refused(broken, "not finite");
}
