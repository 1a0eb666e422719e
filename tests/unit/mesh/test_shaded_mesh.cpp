#include <cmath>
#include <set>

#include "lib/mesh/shaded_mesh.h"
#include "tests/catch.h"

using namespace bp;

namespace {

LatticeMesh box(std::int64_t x, std::int64_t y, std::int64_t z) {
  LatticeMesh mesh;
  for (std::uint32_t i = 0; i < 8; ++i) mesh.vertices.push_back({i % 2 * x, i / 2 % 2 * y, i / 4 * z});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// A column around z with so many sides, open at its ends.
LatticeMesh column(std::uint32_t sides) {
  LatticeMesh mesh;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / sides;
    const auto x = std::int64_t(std::lround(1e6 * std::cos(angle))),
               y = std::int64_t(std::lround(1e6 * std::sin(angle)));
    mesh.vertices.push_back({x, y, 0});
    mesh.vertices.push_back({x, y, 1000000});
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
  }
  return mesh;
}

/// The same triangles, by positions.
bool same_triangles(const LatticeMesh& mesh, const ShadedMesh& drawn) {
  if (drawn.triangles.size() != mesh.triangles.size()) return false;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (drawn.vertex[drawn.triangles[t][k]] != mesh.triangles[t][k]) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("a box is drawn with sharp edges: each side has corners and a normal of its own", "[quick][io][lod]") {
  const LatticeMesh mesh = box(100, 200, 300);
  const ShadedMesh drawn = shaded(mesh);
  CHECK(same_triangles(mesh, drawn));
  CHECK(drawn.vertex.size() == 24);
  CHECK(std::set(drawn.normals.begin(), drawn.normals.end()).size() == 6);
  const std::array<float, 3> down{0, 0, -1};
  for (std::size_t k = 0; k < 3; ++k) CHECK(drawn.normals[drawn.triangles[0][k]] == down);
}

TEST_CASE("a round column is drawn smooth, one of few sides with edges", "[quick][io][lod]") {
  const LatticeMesh round = column(36), edged = column(8);
  CHECK(shaded(round).vertex.size() == round.vertices.size());
  CHECK(shaded(edged).vertex.size() == 2 * edged.vertices.size());
  const ShadedMesh drawn = shaded(round);
  CHECK(same_triangles(round, drawn));
  for (std::size_t i = 0; i < drawn.vertex.size(); ++i) {
    const LatticeCoord p = round.vertices[drawn.vertex[i]];
    CHECK(std::abs(drawn.normals[i][0] - float(double(p.x) / 1e6)) < 1e-5f);
    CHECK(std::abs(drawn.normals[i][2]) < 1e-5f);
  }
}

TEST_CASE("flat triangles and triangles without area do not disturb normals", "[quick][io][lod]") {
  LatticeMesh mesh = box(100, 200, 300);
  mesh.triangles.push_back({0, 0, 1});  // none
  const ShadedMesh drawn = shaded(mesh);
  CHECK(same_triangles(mesh, drawn));
  for (const auto& n : drawn.normals) CHECK(std::abs(std::hypot(n[0], n[1], n[2]) - 1) < 1e-6f);
}

TEST_CASE("charts of a texture split vertices, and normals stay", "[quick]") {
  LatticeMesh mesh;
  mesh.vertices = {{0, 0, 0}, {100, 0, 5}, {100, 100, 0}, {0, 100, 7}, {200, 50, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
  const ShadedMesh plain = shaded(mesh);
  auto texture = std::make_shared<MeshTexture>();
  texture->chart = {0, 0, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    MeshTexture::Corners& uv = texture->uv.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) uv[k] = {float(mesh.triangles[i][k]), float(texture->chart[i])};
  }
  mesh.texture = texture;
  const ShadedMesh split = shaded(mesh);
  REQUIRE(plain.vertex.size() == 5);
  CHECK(plain.uv.empty());
  REQUIRE(split.vertex.size() == 7);  // vertices 1 and 2 are in both charts
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t copy = split.triangles[i][k];
      CHECK(split.vertex[copy] == mesh.triangles[i][k]);
      CHECK(split.uv[copy] == texture->uv[i][k]);
      CHECK(split.normals[copy] == plain.normals[plain.triangles[i][k]]);
    }
  }
}

TEST_CASE("a vertex is split where its faces have colours of their own, and normals stay", "[quick]") {
  LatticeMesh mesh = box(100, 200, 300);
  const LinearColor red{65535, 0, 0}, blue{0, 0, 65535};
  mesh.colors.assign(12, {red, red, red});
  CHECK(shaded(mesh).vertex.size() == 24);
  mesh.colors[0] = {blue, blue, blue};  // half of a side
  const ShadedMesh drawn = shaded(mesh);
  CHECK(same_triangles(mesh, drawn));
  CHECK(drawn.vertex.size() == 26);
  for (std::size_t t = 0; t < 12; ++t)
    for (std::size_t k = 0; k < 3; ++k) CHECK(drawn.colors[drawn.triangles[t][k]] == (t == 0 ? blue : red));
  CHECK(drawn.normals[drawn.triangles[0][0]] == drawn.normals[drawn.triangles[1][0]]);
}
