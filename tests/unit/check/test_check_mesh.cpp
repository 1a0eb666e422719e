// The proxy alone: each finding has a mesh that has this fault only (or faults that follow from it).
#include <random>

#include "lib/check/verdict_text.h"
#include "lib/exact/predicates.h"
#include "tests/catch.h"
#include "tests/reference/triangle_clip.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("a sphere, a box and two boxes apart hold", "[quick][check]") {
  CHECK(check(sphere(3, 2)).holds());
  CHECK(check(cube(1)).holds());
  CHECK(check(join(cube(1), cube(1, {5, 0, 0}))).holds());
  const CheckReport r = check(sphere(3, 2));
  CHECK(r.triangles == 512);
  CHECK(r.vertices == 258);
  CHECK(r.components == 1);
  CHECK(r.euler == 2);
  CHECK(r.genus == 0);
  CHECK(r.merged_vertices == 0);
}

TEST_CASE("the measures of a box are those of a box", "[quick][check]") {
  const CheckReport r = check(box({6e6, 6e6, 0}, {6e6 + 2, 6e6 + 3, 5}));
  CHECK(r.holds());
  CHECK(std::abs(*r.volume - 30) < 1e-9);
  CHECK(r.edge_min == 2);
  CHECK(std::abs(r.edge_max - std::sqrt(34.0)) < 1e-12);
  CHECK(std::abs(r.angle_min_degrees - std::atan2(2, 5) * 180 / M_PI) < 1e-9);
}

TEST_CASE("an empty proxy does not hold", "[quick][check]") {
  const CheckReport r = check(IndexedMesh{});
  CHECK(r.empty());
  CHECK_FALSE(r.holds());
  CHECK_FALSE(check(IndexedMesh{}, triangles_of(cube(1))).encloses());
}

TEST_CASE("a missing triangle leaves three boundary edges", "[quick][check]") {
  IndexedMesh m = sphere(1, 1);
  m.triangles.erase(m.triangles.begin() + 5);
  const CheckReport r = check(m);
  CHECK(r.boundary_edges.count == 3);
  CHECK_FALSE(r.closed());
  CHECK(r.oriented());
  CHECK(r.manifold());
  CHECK(r.embedded());
  CHECK_FALSE(r.genus.has_value());
  CHECK_FALSE(r.holds());
}

TEST_CASE("a flipped triangle leaves three misoriented edges", "[quick][check]") {
  IndexedMesh m = sphere(1, 1);
  std::swap(m.triangles[5][0], m.triangles[5][1]);
  const CheckReport r = check(m);
  CHECK(r.misoriented_edges.count == 3);
  CHECK(r.closed());
  CHECK_FALSE(r.oriented());
  CHECK(r.manifold());
  CHECK(r.embedded());
  CHECK_FALSE(r.holds());
}

TEST_CASE("a mesh turned inside out is inverted and nothing else", "[quick][check]") {
  const CheckReport r = check(inverted(sphere(1, 1)));
  CHECK(r.inverted_components.count == 1);
  CHECK_FALSE(r.outward());
  CHECK(r.closed());
  CHECK(r.oriented());
  CHECK(*r.volume < 0);
  CHECK_FALSE(r.holds());
}

TEST_CASE("two boxes that share a corner are a bow-tie vertex", "[quick][check]") {
  // By index and, joined without merging, by position.
  const CheckReport r = check(join(box({0, 0, 0}, {1, 1, 1}), box({1, 1, 1}, {2, 2, 2})));
  CHECK(r.nonmanifold_vertices.count == 1);
  CHECK(r.nonmanifold_vertices.examples.at(0).index == 7);
  CHECK(r.merged_vertices == 1);
  CHECK(r.nonmanifold_edges.count == 0);
  CHECK(r.self_intersections.count == 0);
  CHECK(r.components == 2);
  CHECK_FALSE(r.manifold());
  CHECK_FALSE(r.holds());
}

TEST_CASE("two boxes that share an edge are non-manifold there", "[quick][check]") {
  const CheckReport r = check(join(box({0, 0, 0}, {1, 1, 1}), box({1, 1, 0}, {2, 2, 1})));
  CHECK(r.nonmanifold_edges.count == 1);
  CHECK(r.closed());
  CHECK(r.oriented());
  CHECK_FALSE(r.manifold());
  CHECK_FALSE(r.holds());
}

TEST_CASE("boxes that overlap, touch with a face, an edge in a face or a vertex in a face intersect",
          "[quick][check]") {
  const IndexedMesh a = box({0, 0, 0}, {4, 4, 4});
  // crossing
  CHECK(check(join(a, box({2, 1, 1}, {6, 3, 3}))).self_intersections.count > 0);
  // coplanar overlap of faces, no shared vertices
  CHECK(check(join(a, box({4, 1, 1}, {6, 3, 3}))).self_intersections.count > 0);
  // a vertex touching the inside of a face
  IndexedMesh tip = sphere(0, 1, {5, 2, 2.5});
  CHECK(check(join(a, tip)).self_intersections.count == 4);
  CHECK_FALSE(check(join(a, tip)).holds());
  // and one unit in the last place beside it
  tip.vertices[1][0] = std::nextafter(4.0, 5.0);
  CHECK(check(join(a, tip)).self_intersections.count == 0);
  CHECK(check(join(a, tip)).holds());
  tip.vertices[1][0] = std::nextafter(4.0, 3.0);
  CHECK(check(join(a, tip)).self_intersections.count > 0);
}

TEST_CASE("triangles at one place meet each other, and not all pairs are counted", "[quick][check]") {
  constexpr std::uint32_t kCopies = 4000;
  IndexedMesh mesh;
  for (std::uint32_t i = 0; i < kCopies; ++i) {
    for (const Vec3d& p : {Vec3d{double(i) * 1e-9, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}}) mesh.vertices.push_back(p);
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const CheckReport report = check(mesh);
  CHECK(report.self_intersections.count >= kCopies);
  CHECK(report.self_intersections.count <= 20 * (kCopies + 256));  // half of the square would be 8 million
  CHECK(report.self_intersections.at_least);
  CHECK(verdict_text(report, "m").find("at least ") != std::string::npos);
  CHECK(verdict_json(report, "m").find("\"at_least\": true") != std::string::npos);
}

TEST_CASE("a fold flat onto its neighbour is an intersection of neighbours", "[quick][check]") {
  // A tetrahedron pressed flat: closed, oriented, manifold, but each pair of faces overlaps.
  IndexedMesh m;
  m.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}};
  m.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const CheckReport flat = check(m);
  CHECK(flat.self_intersections.count == 3);
  CHECK(flat.closed());
  CHECK(flat.manifold());
  CHECK(flat.inverted_components.count == 1);  // no volume: decided exactly
  m.vertices[3][2] = 1e-80;
  CHECK(check(m).holds());
  m.vertices[3][2] = -1e-80;
  CHECK(check(m).self_intersections.count == 0);
  CHECK(check(m).inverted_components.count == 1);
}

TEST_CASE("the orientation of a body thinner than the rounding of its volume is decided exactly", "[quick][check]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> c(1, 2);
  int outward = 0;
  for (int n = 0; n < 200; ++n) {
    IndexedMesh m;
    for (int i = 0; i < 3; ++i) m.vertices.push_back({c(random), c(random), c(random)});
    Vec3d inside;  // of the first three, but for rounding
    for (std::size_t i = 0; i < 3; ++i) inside[i] = (m.vertices[0][i] + m.vertices[1][i] + m.vertices[2][i]) / 3;
    m.vertices.push_back(inside);
    m.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const int side = orient3d(m.vertices[0], m.vertices[1], m.vertices[2], inside);
    CHECK(check(m).outward() == (side > 0));
    CHECK(check(m).embedded() == (side != 0));
    outward += side > 0;
  }
  CHECK(outward > 50);
  CHECK(outward < 150);
}

TEST_CASE("a corner pulled through the far side crosses triangles that share a vertex", "[quick][check]") {
  IndexedMesh m = sphere(0, 1);
  m.vertices[0] = {-0.5, 0.3, 0.3};  // +x vertex through the triangle (y, -x, z)
  const CheckReport r = check(m);
  CHECK(r.self_intersections.count > 0);
  CHECK(r.closed());
  CHECK(r.manifold());
  CHECK_FALSE(r.embedded());
}

TEST_CASE("self-intersecting pairs equal rational clipping of all pairs", "[quick][check]") {
  const int seed = GENERATE(range(0, 10));
  std::mt19937 random(std::uint32_t(seed) + 1);
  std::uniform_int_distribution<long> coordinate(0, 12);
  std::uniform_int_distribution<std::uint32_t> corner(0, 59);
  std::vector<reference::Point> points;
  IndexedMesh m;
  while (points.size() < 60) {
    const reference::Point p{coordinate(random), coordinate(random), coordinate(random)};
    if (std::find(points.begin(), points.end(), p) != points.end()) continue;
    points.push_back(p);
    m.vertices.push_back({double(p[0]), double(p[1]), double(p[2])});
  }
  const auto corners = [&](const auto& t) { return reference::Triangle{points[t[0]], points[t[1]], points[t[2]]}; };
  while (m.triangles.size() < 80) {
    const std::array<std::uint32_t, 3> t{corner(random), corner(random), corner(random)};
    if (!reference::zero_area(corners(t))) m.triangles.push_back(t);
  }
  std::uint64_t expected = 0;
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    for (std::size_t j = i + 1; j < m.triangles.size(); ++j) {
      std::vector<std::uint32_t> shared;
      for (const auto a : m.triangles[i])
        for (const auto b : m.triangles[j])
          if (a == b) shared.push_back(a);
      bool meets = false;
      for (const auto& p : reference::intersection(corners(m.triangles[i]), corners(m.triangles[j])))
        meets |= shared.empty() || shared.size() == 3 || (shared.size() == 1 && !is_point(p, points[shared[0]])) ||
                 (shared.size() == 2 && !on_segment(p, points[shared[0]], points[shared[1]]));
      expected += meets;
    }
  }
  const CheckReport r = check(m);
  CHECK(r.self_intersections.count == expected);
  CHECK(!r.self_intersections.at_least);
  CHECK(r.self_intersections.examples.size() == 5);
}

TEST_CASE("a triangle of no area is counted", "[quick][check]") {
  IndexedMesh m = cube(1);
  m.vertices.push_back({-1, -1, 0});           // on the edge 0-4: split one of the two faces there, close with a sliver
  m.triangles.erase(m.triangles.begin() + 8);  // {0, 4, 6}
  m.triangles.insert(m.triangles.end(), {{0, 8, 6}, {8, 4, 6}, {0, 4, 8}});
  const CheckReport r = check(m);
  CHECK(r.degenerate_triangles.count == 1);
  CHECK(r.degenerate_triangles.examples.at(0).index == 13);
  CHECK(r.closed());
  CHECK(r.oriented());
  CHECK(r.manifold());
  CHECK_FALSE(r.holds());
  m.triangles.push_back({3, 3, 5});  // a repeated corner leaves the rest as it was
  CHECK(check(m).degenerate_triangles.count == 2);
  CHECK(check(m).manifold());
  CHECK(check(m).components == 1);
}

TEST_CASE("a sliver that no double computation can tell from a line is no degenerate triangle", "[quick][check]") {
  IndexedMesh m = cube(1);
  m.vertices[7] = {1, 1, std::nextafter(1.0, 2.0)};
  CHECK(check(m).degenerate_triangles.count == 0);
  CHECK(check(m).holds());
}

TEST_CASE("the same triangle twice is a duplicate", "[quick][check]") {
  IndexedMesh m = cube(1);
  m.triangles.push_back({3, 0, 2});
  const CheckReport r = check(m);
  CHECK(r.duplicate_triangles.count == 1);
  CHECK(r.duplicate_triangles.examples.at(0).index == 12);
  CHECK(r.duplicate_triangles.examples.at(0).other == 0);
  CHECK(r.nonmanifold_edges.count == 3);
  CHECK_FALSE(r.holds());
}

TEST_CASE("coordinates that are not numbers, faces out of range and magnitudes out of the domain do not hold",
          "[quick][check]") {
  IndexedMesh nan = cube(1);
  nan.vertices[3][1] = std::nan("");
  CHECK(check(nan).non_finite_vertices.count == 1);
  CHECK(check(nan).non_finite_vertices.examples.at(0).index == 3);
  CHECK_FALSE(check(nan).holds());
  IndexedMesh infinite = cube(1);
  infinite.vertices[0][2] = HUGE_VAL;
  CHECK(check(infinite).non_finite_vertices.count == 1);
  IndexedMesh tiny = cube(1);
  tiny.vertices[6][0] = -1e-300;
  CHECK(check(tiny).undecidable_vertices.count == 1);
  CHECK_FALSE(check(tiny).holds());
  IndexedMesh bad = cube(1);
  bad.triangles[4][2] = 8;
  CHECK(check(bad).bad_faces.count == 1);
  CHECK(check(bad).bad_faces.examples.at(0).index == 4);
  CHECK_FALSE(check(bad).closed());
  CHECK_FALSE(check(bad).holds());
}

TEST_CASE("what is left out at a vertex that cannot be decided is no hole", "[quick][check]") {
  IndexedMesh sound = box({0, 0, 0}, {1, 1, 1}), crossed = sound;
  sound.vertices[7][0] = 1 + 1e-12;
  CHECK(check(sound).answer() == Answer::proven);
  sound.vertices[0] = {5e-324, 0, 0};  // the domain ends at 1e-90
  CHECK(check(sound).boundary_edges.count > 0);
  CHECK(check(sound).answer() == Answer::undecided);
  crossed.vertices[0] = {5e-324, 0, 0};
  crossed.triangles.push_back(crossed.triangles.back());
  CHECK(check(crossed).answer() == Answer::refuted);  // a triangle is there twice, whatever the rest is
}

TEST_CASE("faces that a reader had to leave out refute a proxy, and data that differ leave it undecided",
          "[quick][check]") {
  IndexedMesh m = cube(1);
  m.bad_faces = 2;
  CHECK(check(m).bad_faces.count == 2);
  CHECK(check(m).answer() == Answer::refuted);
  m.bad_faces = 0, m.differing = 1;
  CHECK(check(m).answer() == Answer::undecided);
}

TEST_CASE("a cavity holds, a box within a box holds, an inverted box beside one does not", "[quick][check]") {
  CHECK(check(join(cube(3), inverted(cube(1)))).holds());
  CHECK(check(join(cube(3), cube(1))).holds());
  CHECK(check(join(cube(3), inverted(cube(1)))).components == 2);
  const CheckReport r = check(join(cube(3), inverted(cube(1, {9, 0, 0}))));
  CHECK(r.inverted_components.count == 1);
  CHECK(r.inverted_components.examples.at(0).index == 12);
  CHECK_FALSE(r.holds());
}

TEST_CASE("vertices repeated for every triangle are merged", "[quick][check]") {
  IndexedMesh soup;
  for (const TriangleD& t : triangles_of(cube(1))) {
    const auto n = std::uint32_t(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), t.begin(), t.end());
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  soup.vertices[0][0] += 0.0;
  const CheckReport r = check(soup);
  CHECK(r.holds());
  CHECK(r.merged_vertices == 28);
  CHECK(r.vertices == 8);
}

TEST_CASE("a torus has genus one", "[quick][check]") {
  IndexedMesh m;
  const std::uint32_t n = 8;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const double u = i * 2 * M_PI / n, v = j * 2 * M_PI / n, r = 3 + std::cos(v);
      m.vertices.push_back({r * std::cos(u), r * std::sin(u), std::sin(v)});
      const std::uint32_t i1 = (i + 1) % n, j1 = (j + 1) % n;
      m.triangles.push_back({i * n + j, i1 * n + j, i1 * n + j1});
      m.triangles.push_back({i * n + j, i1 * n + j1, i * n + j1});
    }
  const CheckReport r = check(m);
  CHECK(r.holds());
  CHECK(r.genus == 1);
  CHECK(r.euler == 0);
}
