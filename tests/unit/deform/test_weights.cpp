#include <random>

#include "lib/core/error.h"
#include "lib/core/vec3.h"
#include "lib/deform/pose.h"
#include "lib/deform/weight_block.h"
#include "tests/catch.h"
#include "tests/support/cages.h"

using namespace bp;
using namespace bp::test;

namespace {

std::vector<Vec3d> points_inside(std::size_t n) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  std::vector<Vec3d> points(n);
  for (Vec3d& p : points) p = {place(random), place(random), place(random)};
  return points;
}

std::vector<TriangleD> faces_of(const IndexedMesh& m) {
  std::vector<TriangleD> faces;
  for (const auto& t : m.triangles) faces.push_back({m.vertices[t[0]], m.vertices[t[1]], m.vertices[t[2]]});
  return faces;
}

Vec3d sheared(const Vec3d& p) {
  return {2 * p[0] - p[1] + 7, p[1] + 0.5 * p[2] - 3, 0.25 * p[0] - 3 * p[2] + 1000};
}

template <class Map>
std::vector<Vec3d> moves_by(const IndexedMesh& m, const Map& map) {
  std::vector<Vec3d> moves;
  for (const Vec3d& v : m.vertices) moves.push_back(map(v) - v);
  return moves;
}

}  // namespace

TEST_CASE("rounded weights add up to 1, and keep affine maps to 1e-6", "[deform][quick]") {
  const IndexedMesh mesh = sphere_cage(12, 14);
  const CageCoordinates coordinates(make_cage(mesh, "sphere"));
  const std::vector<Vec3d> points = points_inside(500);
  CoordinateRows rows;
  coordinates.evaluate(points, rows);
  WeightBlock block(points.size(), mesh.vertices.size());
  round_weights(rows, 0, block);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::int64_t sum = 0;
    for (std::size_t c = 0; c < block.columns; ++c) sum += block.units[c * points.size() + i];
    REQUIRE(sum == std::int64_t(1) << block.bits[i]);
  }
  std::vector<Vec3d> moved(points.size());
  add_moves(block, moves_by(mesh, sheared), moved);
  for (std::size_t i = 0; i < points.size(); ++i)
    CHECK(length(points[i] + moved[i] - sheared(points[i])) < 1e-6 * 2 * std::sqrt(3.0));
  const std::vector<Vec3d> still(mesh.vertices.size());
  add_moves(block, still, moved);
  for (const Vec3d& m : moved) REQUIRE(m == Vec3d{});
}

TEST_CASE("a point far outside keeps a rounded weight, and one too far is refused", "[deform][quick]") {
  const IndexedMesh mesh = sphere_cage(5, 6);
  const CageCoordinates coordinates(make_cage(mesh, "sphere"));
  const auto error_at = [&](double distance) {
    const std::vector<Vec3d> points{{distance, 0, 0}, {0.1, 0.1, 0}};
    CoordinateRows rows;
    WeightBlock block(2, mesh.vertices.size());
    coordinates.evaluate(points, rows);
    round_weights(rows, 0, block);
    CHECK(int(block.bits[1]) == WeightBlock::kBits);
    std::vector<Vec3d> moved(2);
    add_moves(block, moves_by(mesh, sheared), moved);
    return length(points[0] + moved[0] - sheared(points[0])) / distance;
  };
  CHECK(error_at(2) < 1e-6);
  CHECK(error_at(1e3) < 1e-6);
  CHECK(error_at(1e6) < 1e-6);
  CHECK_THROWS_AS(error_at(1e12), Error);
}

TEST_CASE("weights that are not finite are refused", "[deform][quick]") {
  CoordinateRows rows;
  rows.columns = 2;
  rows.places.resize(1);
  WeightBlock block(1, 2);
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    rows.weights = {bad, 1};
    CHECK_THROWS_AS(round_weights(rows, 0, block), Error);
  }
}

TEST_CASE("Green coordinates carry similarities to 1e-6 when they are rounded, and keep a scene at rest",
          "[deform][quick]") {
  const IndexedMesh mesh = sphere_cage(12, 14);
  const CageCoordinates coordinates(make_cage(mesh, "sphere"), CoordinateKind::green);
  const std::vector<Vec3d> points = points_inside(200);
  CoordinateRows rows;
  coordinates.evaluate(points, rows);
  WeightBlock block(points.size(), coordinates.columns());
  round_weights(rows, 0, block);
  const auto similar = [](const Vec3d& p) { return Vec3d{-2 * p[1] + 7, 2 * p[0] - 3, 2 * p[2] + 1000}; };
  std::vector<Vec3d> moved(points.size());
  add_moves(block, coordinates.moves_of_columns(moves_by(mesh, similar)), moved);
  for (std::size_t i = 0; i < points.size(); ++i)
    CHECK(length(points[i] + moved[i] - similar(points[i])) < 1e-6 * 2 * std::sqrt(3.0));
  add_moves(block, coordinates.moves_of_columns(std::vector<Vec3d>(mesh.vertices.size(), Vec3d{})), moved);
  for (const Vec3d& m : moved) REQUIRE(m == Vec3d{});
}

TEST_CASE("coordinates of a dense cage work in memory that is told", "[deform][quick]") {
  const CageCoordinates coordinates(make_cage(sphere_cage(250, 250), "dense"));
  const std::size_t columns = coordinates.columns();
  CHECK(coordinates.points_at_once() * columns * 8 < (std::size_t(1) << 22));
  CHECK(coordinates.bytes_at_once() > columns * 8);
  CHECK(coordinates.bytes_at_once() < (std::size_t(1) << 27));
}

TEST_CASE("normals and tangents turn as the cage does", "[deform][quick]") {
  const IndexedMesh mesh = sphere_cage(12, 14);
  const CageCoordinates coordinates(make_cage(mesh, "sphere"));
  const std::vector<Vec3d> points = points_inside(64);
  const Vec3d normal = (1 / std::sqrt(14.0)) * Vec3d{1, 2, 3}, tangent = (1 / std::sqrt(5.0)) * Vec3d{2, -1, 0};
  std::vector<Vec3d> normals(points.size(), normal), tangents(points.size(), tangent);
  turn_directions(coordinates, moves_by(mesh, sheared), points, normals, tangents);
  const Vec3d along = sheared(tangent) - sheared({}), other = sheared(cross(normal, tangent)) - sheared({});
  const Vec3d expected = cross(along, other);
  for (std::size_t i = 0; i < points.size(); ++i) {
    CHECK(length(normals[i] - (1 / length(expected)) * expected) < 1e-5);
    CHECK(length(tangents[i] - along) < 1e-5);
  }
  std::vector<Vec3d> kept(points.size(), normal);
  turn_directions(coordinates, std::vector<Vec3d>(mesh.vertices.size(), Vec3d{}), points, kept, {});
  for (const Vec3d& n : kept) REQUIRE(n == normal);
}

TEST_CASE("a moved cage has the same faces in the same order, or is refused", "[deform][quick]") {
  const IndexedMesh rest = sphere_cage(4, 5);
  IndexedMesh moved = rest;
  moved.vertices[3] = {9, 9, 9};
  moved.vertices[4] = moved.vertices[5];  // places may become one
  std::vector<TriangleD> faces = faces_of(moved);
  const std::vector<Vec3d> moves = moves_of_cage(rest, faces, "posed.obj");
  for (std::size_t v = 0; v < moves.size(); ++v) CHECK(moves[v] == moved.vertices[v] - rest.vertices[v]);
  const auto refused = [&](const char* why) {
    CHECK_THROWS_WITH(moves_of_cage(rest, faces, "posed.obj"), ContainsSubstring(why));
  };
  std::swap(faces[2], faces[7]);
  refused("does not meet its neighbours");
  faces = faces_of(moved);
  faces.pop_back();
  refused("has 29 triangles, and the cage 30");
  faces = faces_of(moved);
  faces[6][1][2] = std::nan("");
  refused("not finite");
}
