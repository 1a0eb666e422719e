#include <random>

#include "lib/core/box.h"
#include "lib/core/error.h"
#include "lib/core/vec3.h"
#include "lib/deform/coordinates.h"
#include "lib/deform/detail/green.h"
#include "lib/deform/detail/likelihood.h"
#include "lib/deform/detail/mean_value.h"
#include "lib/geometry/crossing.h"
#include "tests/catch.h"
#include "tests/reference/green.h"
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

Probe probe(const CageCoordinates& coordinates, const Vec3d& p) {
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
  const std::size_t step = 1 + m.triangles.size() / 25;  // some faces of a large cage
  for (std::size_t f = 0; f < m.triangles.size(); f += step) {
    const auto& t = m.triangles[f];
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

constexpr CoordinateKind kKinds[] = {CoordinateKind::mean_value, CoordinateKind::green,
                                     CoordinateKind::maximum_likelihood};

/// A similarity, and a map that is none.
Vec3d similar(const Vec3d& p) {
  return {-3 * p[1] + 2, 3 * p[0] - 1, 3 * p[2] + 0.5};
}
Vec3d affine(const Vec3d& p) {
  return {2 * p[0] - p[1] + 3, p[1] + 0.5 * p[2], 0.25 * p[0] - 3 * p[2]};
}

/// Returns coordinates before they are made to sum to 1 and to reproduce the point; empty next to a face. `slow`: how
/// many needed extended precision.
std::vector<double> raw_row(const CageCoordinates& coordinates, const Vec3d& p, std::size_t& slow) {
  static detail::CoordinateScratch scratch;
  const Cage& cage = coordinates.cage();
  const detail::CageView view = coordinates.view();
  detail::WideVec four{};
  alignas(sizeof(detail::Wide)) detail::Wide total{};
  for (int k = 0; k < detail::kWide; ++k) four.x[k] = p[0], four.y[k] = p[1], four.z[k] = p[2];
  std::vector<double> row(coordinates.columns());
  scratch.resize(cage, coordinates.kind() == CoordinateKind::green);
  if (coordinates.kind() == CoordinateKind::green) {
    if (detail::green_weights(view, four, scratch, total) != 0) {
      ++slow;
      detail::green_weights_slowly(cage, view, p, row);
      return row;
    }
    for (std::size_t v = 0; v < cage.vertices.size(); ++v) row[v] = scratch.green.sums[v][0];
    for (std::size_t f = 0; f < cage.faces.size(); ++f)
      row[cage.vertices.size() + f] = scratch.green.face_weights[f][0];
    return row;
  }
  const unsigned doubtful = detail::mean_value_weights(view, four, scratch, total);
  if (coordinates.kind() == CoordinateKind::mean_value && doubtful != 0) {
    ++slow;
    detail::mean_value_weights_slowly(cage, p, row);
    return row;
  }
  if (coordinates.kind() == CoordinateKind::maximum_likelihood)
    detail::likelihood_weights(cage, four, doubtful, total, scratch);
  for (std::size_t v = 0; v < row.size(); ++v) row[v] = scratch.sums[v][0];
  return row;
}

bool is_near_a_face(const Cage& cage, const Vec3d& p) {
  for (const auto& f : cage.faces) {
    const TriangleD t{cage.vertices[f.corner[0]], cage.vertices[f.corner[1]], cage.vertices[f.corner[2]]};
    if (distance_squared(p, t) < 4e-18) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("coordinates sum to 1 and carry similarities and affine maps to the points, anywhere", "[deform][quick]") {
  for (const CoordinateKind kind : kKinds) {
    const auto map = kind == CoordinateKind::green ? similar : affine;
    for (const NamedCage& cage : hostile_cages()) {
      INFO(cage.name << " " << int(kind));
      const CageCoordinates coordinates(make_cage(cage.mesh, cage.name), kind);
      std::vector<Vec3d> points = points_near_faces(cage.mesh), vertex_moves;
      for (const Vec3d& p : random_points(cage.mesh, 100, 3)) points.push_back(p);
      points.insert(points.end(), cage.mesh.vertices.begin(), cage.mesh.vertices.end());
      for (const Vec3d& v : cage.mesh.vertices) vertex_moves.push_back(map(v) - v);
      const std::vector<Vec3d> moves = coordinates.moves_of_columns(vertex_moves);
      REQUIRE(moves.size() == columns_of(kind, cage.mesh));
      for (const Vec3d& p : points) {
        INFO(p[0] << " " << p[1] << " " << p[2]);
        const std::vector<double> w = probe(coordinates, p).weights;
        double sum = 0;
        Vec3d found = p;
        for (std::size_t v = 0; v < cage.mesh.vertices.size(); ++v) sum += w[v];
        for (std::size_t c = 0; c < w.size(); ++c) found = found + w[c] * moves[c];
        REQUIRE(std::abs(sum - 1) < 1e-9);
        REQUIRE(length(found - map(p)) < 1e-8 * diagonal(cage.mesh));
      }
    }
  }
}

TEST_CASE("the weights reproduce a point to 1e-6 before that is enforced", "[deform][quick]") {
  for (const CoordinateKind kind : kKinds) {
    for (const NamedCage& named : hostile_cages()) {
      INFO(named.name << " " << int(kind));
      const CageCoordinates coordinates(make_cage(named.mesh, named.name), kind);
      const Cage& cage = coordinates.cage();
      std::vector<Vec3d> points = points_near_faces(named.mesh);
      for (const Vec3d& p : random_points(named.mesh, 500)) points.push_back(p);
      std::size_t slow = 0, checked = 0;
      double worst = 0;
      for (const Vec3d& scene_point : points) {
        const Vec3d p = cage.to_cage(scene_point);
        if (winding(named.mesh, scene_point) != 1 || is_near_a_face(cage, p)) continue;
        const std::vector<double> weights = raw_row(coordinates, p, slow);
        double sum = 0;
        Vec3d moment{};
        for (std::size_t v = 0; v < cage.vertices.size(); ++v)
          sum += weights[v], moment = moment + weights[v] * cage.vertices[v];
        for (std::size_t f = cage.vertices.size(); f < weights.size(); ++f)
          moment = moment + weights[f] * coordinates.view().green[f - cage.vertices.size()].normal;
        INFO(scene_point[0] << " " << scene_point[1] << " " << scene_point[2]);
        if (kind == CoordinateKind::green) CHECK(std::abs(sum - 1) < 1e-6);
        worst = std::max(worst, length((1 / sum) * moment - p));
        CHECK(length((1 / sum) * moment - p) < 1e-6);
        ++checked;
      }
      CHECK(checked > 100);
      CHECK(slow < checked / 2);
    }
  }
}

TEST_CASE("Green coordinates are those of the paper", "[deform][quick]") {
  for (const NamedCage& cage : hostile_cages()) {
    INFO(cage.name);
    const CageCoordinates coordinates(make_cage(cage.mesh, cage.name), CoordinateKind::green);
    std::vector<double> expected;
    for (const Vec3d& p : random_points(cage.mesh, 300)) {
      if (winding(cage.mesh, p) != 1) continue;
      reference::green(cage.mesh, p, expected);
      const Probe found = probe(coordinates, p);
      for (std::size_t c = 0; c < expected.size(); ++c) {
        const double unit = c < cage.mesh.vertices.size() ? 1 : coordinates.cage().diagonal;
        REQUIRE(std::abs(unit * found.weights[c] - expected[c]) < 1e-6);
      }
    }
  }
}

TEST_CASE("maximum likelihood coordinates are not negative inside, and those of a corner in a tetrahedron",
          "[deform][quick]") {
  for (const NamedCage& cage : hostile_cages()) {
    INFO(cage.name);
    const CageCoordinates coordinates(make_cage(cage.mesh, cage.name), CoordinateKind::maximum_likelihood);
    for (const Vec3d& p : random_points(cage.mesh, 1000)) {
      const Probe found = probe(coordinates, p);
      if (found.place != Place::inside) continue;
      for (const double w : found.weights) REQUIRE(w > -1e-9);
    }
  }
  IndexedMesh corner;
  corner.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  corner.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (const CoordinateKind kind : {CoordinateKind::mean_value, CoordinateKind::maximum_likelihood}) {
    const Probe found = probe(CageCoordinates(make_cage(corner, "corner"), kind), {0.1, 0.2, 0.3});
    for (std::size_t v = 0; v < 4; ++v) CHECK(std::abs(found.weights[v] - std::array{0.4, 0.1, 0.2, 0.3}[v]) < 1e-9);
  }
}

TEST_CASE("Green coordinates on the cage are those just within, also on edges and corners", "[deform][quick]") {
  for (const NamedCage& cage : hostile_cages()) {
    INFO(cage.name);
    const CageCoordinates coordinates(make_cage(cage.mesh, cage.name), CoordinateKind::green);
    const double step = 1e-8 * diagonal(cage.mesh);
    const std::size_t every = 1 + cage.mesh.triangles.size() / 25;
    for (std::size_t f = 0; f < cage.mesh.triangles.size(); f += every) {
      const auto& t = cage.mesh.triangles[f];
      const Vec3d &a = cage.mesh.vertices[t[0]], &b = cage.mesh.vertices[t[1]], &c = cage.mesh.vertices[t[2]];
      for (const auto& s : {std::array{1.0, 0.0, 0.0}, {0.5, 0.5, 0.0}, {0.2, 0.5, 0.3}}) {
        const Vec3d on = s[0] * a + s[1] * b + s[2] * c;
        for (int i = 0; i < 8; ++i) {
          const Vec3d p = on + step * Vec3d{i & 1 ? 1.0 : -0.7, i & 2 ? 0.8 : -1.1, i & 4 ? 0.9 : -1.2};
          const Probe near = probe(coordinates, p), here = probe(coordinates, on);
          REQUIRE((here.place == Place::inside));
          if (near.place != Place::inside) continue;
          for (std::size_t k = 0; k < near.weights.size(); ++k)
            REQUIRE(std::abs(near.weights[k] - here.weights[k]) < 1e-3);
        }
      }
    }
  }
}

TEST_CASE("coordinates are those of the paper", "[deform][quick]") {
  for (const char* name : {"cube", "L", "concave", "spikes", "sphere"}) {
    for (const NamedCage& cage : hostile_cages()) {
      if (cage.name != name) continue;
      INFO(name);
      const CageCoordinates coordinates(make_cage(cage.mesh, name));
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
  const auto check = [](const NamedCage& cage, CoordinateKind kind) {
    INFO(cage.name << " " << int(kind));
    const CageCoordinates coordinates(make_cage(cage.mesh, cage.name), kind);
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
  };
  for (const NamedCage& cage : hostile_cages()) {
    if (cage.name == "needle" || cage.name == "plate") continue;  // other faces are as near
    check(cage, CoordinateKind::mean_value);
    check(cage, CoordinateKind::maximum_likelihood);
  }
}

TEST_CASE("inside and outside are told as by exact crossings", "[deform][quick]") {
  for (const CoordinateKind kind : kKinds) {
    for (const NamedCage& cage : hostile_cages()) {
      INFO(cage.name << " " << int(kind));
      const CageCoordinates coordinates(make_cage(cage.mesh, cage.name), kind);
      for (const Vec3d& p : random_points(cage.mesh, 1000, 4)) {
        const Place expected = winding(cage.mesh, p) == 1 ? Place::inside : Place::outside;
        REQUIRE((probe(coordinates, p).place == expected));
      }
    }
  }
}

TEST_CASE("a cage that faces inwards is turned, and coordinates do not depend on their neighbours", "[deform][quick]") {
  for (const CoordinateKind kind : kKinds) {
    IndexedMesh inwards = sphere_cage(6, 7, 0.2);
    const CageCoordinates right(make_cage(inwards, "right"), kind);
    for (auto& t : inwards.triangles) std::swap(t[0], t[1]);
    const CageCoordinates turned(make_cage(inwards, "turned"), kind);
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
}

TEST_CASE("what is no cage is refused", "[deform][quick]") {
  const auto refused = [](const IndexedMesh& m, const char* why) {
    CHECK_THROWS_WITH(make_cage(m, "c.obj"), ContainsSubstring(why));
  };
  IndexedMesh open = sphere_cage(4, 5);
  open.triangles.pop_back();
  refused(open, "whose faces face both ways: 3");
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
