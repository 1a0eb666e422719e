#include <cmath>
#include <random>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/enclosed/enclosed_triangles.h"
#include "lib/exact/triangle_intersection.h"
#include "lib/tighten/fan_fit.h"
#include "lib/tighten/tight_proxy.h"
#include "tests/catch.h"

using namespace bp;

namespace {

/// A lattice frame of 1 unit a voxel, so that scene units times 64 are lattice units.
GridFrame unit_frame() {
  GridFrame frame;
  frame.voxel = 1;
  return frame;
}

/// Octahedron, its faces split `levels` times and its vertices pushed out to `radius` lattice units, rounded.
LatticeMesh ball(double radius, int levels) {
  LatticeMesh m;
  m.frame = unit_frame();
  std::vector<std::array<Vec3d, 3>> faces;
  for (int i = 0; i < 8; ++i) {
    const Vec3d x{i & 1 ? -1.0 : 1.0, 0, 0}, y{0, i & 2 ? -1.0 : 1.0, 0}, z{0, 0, i & 4 ? -1.0 : 1.0};
    const bool odd = ((i & 1) + ((i >> 1) & 1) + (i >> 2)) % 2 == 1;
    faces.push_back(odd ? std::array{x, z, y} : std::array{x, y, z});
  }
  for (int level = 0; level < levels; ++level) {
    std::vector<std::array<Vec3d, 3>> next;
    for (const auto& [a, b, c] : faces) {
      const Vec3d ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
      next.insert(next.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = next;
  }
  for (const auto& f : faces) {
    std::array<std::uint32_t, 3> t{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double s = radius / length(f[k]);
      const LatticeCoord p{std::llround(s * f[k][0]), std::llround(s * f[k][1]), std::llround(s * f[k][2])};
      const auto at = std::find(m.vertices.begin(), m.vertices.end(), p);
      t[k] = std::uint32_t(at - m.vertices.begin());
      if (at == m.vertices.end()) m.vertices.push_back(p);
    }
    m.triangles.push_back(t);
  }
  return m;
}

std::vector<TriangleD> scene_of(const LatticeMesh& m) {
  std::vector<TriangleD> scene;
  for (const auto& t : m.triangles)
    scene.push_back(
        {m.frame.world(m.vertices[t[0]]), m.frame.world(m.vertices[t[1]]), m.frame.world(m.vertices[t[2]])});
  return scene;
}

double volume(const LatticeMesh& m) {
  double sum = 0;
  for (const auto& t : m.triangles)
    sum += double(orient3d_value({0, 0, 0}, m.vertices[t[0]], m.vertices[t[1]], m.vertices[t[2]])) / 6;
  return sum;
}

bool touches(const LatticeMesh& proxy, const LatticeMesh& scene) {
  for (const auto& t : proxy.triangles) {
    const LatticeCoord a[3] = {proxy.vertices[t[0]], proxy.vertices[t[1]], proxy.vertices[t[2]]};
    for (const auto& s : scene.triangles) {
      const LatticeCoord b[3] = {scene.vertices[s[0]], scene.vertices[s[1]], scene.vertices[s[2]]};
      if (triangles_intersect(a, b)) return true;
    }
  }
  return false;
}

bool embedded(const LatticeMesh& m) {
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    for (std::size_t j = i + 1; j < m.triangles.size(); ++j) {
      if (triangles_meet_beyond_shared(m.vertices.data(), m.triangles[i], m.triangles[j])) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("a tight proxy of a ball of triangles touches neither it nor itself and is nearly as small as can be",
          "[quick][meshing]") {
  const LatticeMesh scene = ball(20 * 64, 4);
  LatticeMesh dense = ball(24 * 64, 4);
  const EnclosedTriangles enclosed(scene_of(scene), dense.frame);
  SimplifyParams params;
  params.faces = 120;
  params.dense = false;
  const auto [proxy, simplified, tightened] = tight_proxy(dense, enclosed, params);
  REQUIRE_NOTHROW(HalfEdgeMesh(proxy));
  CHECK(proxy.triangles.size() == 120);  // none is needless
  CHECK(simplified.faces_out == 120);
  CHECK(simplified.stop == StopReason::faces);
  CHECK(embedded(proxy));
  CHECK_FALSE(touches(proxy, scene));
  CHECK(volume(proxy) > volume(scene));
  // Measured; the growing collapses alone end far above.
  CHECK(volume(proxy) < 1.14 * volume(scene));
}

TEST_CASE("a proxy made in waves touches neither the scene nor itself, and is the same for every number of threads",
          "[quick][meshing]") {
  const LatticeMesh scene = ball(40 * 64, 4), dense = ball(44 * 64, 5);
  const EnclosedTriangles enclosed(scene_of(scene), dense.frame);
  SimplifyParams params;
  params.faces = 800;
  params.dense = false;
  std::vector<LatticeMesh> proxies;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    proxies.push_back(tight_proxy(dense, enclosed, params).mesh);
    CHECK(proxies.back().vertices == proxies.front().vertices);
    CHECK(proxies.back().triangles == proxies.front().triangles);
  }
  CHECK(has_waves(HalfEdgeMesh(proxies.front()), false));
  CHECK(embedded(proxies.front()));
  CHECK_FALSE(touches(proxies.front(), scene));
  CHECK(volume(proxies.front()) < 1.08 * volume(scene));
}

TEST_CASE("what tightening may not sweep over is found wherever it lies", "[quick][meshing]") {
  // A scene of one small triangle inside a tetrahedron; each corner of the tetrahedron is pulled far in.
  const LatticeMesh frame_only = ball(64, 0);
  const TriangleD small = {Vec3d{1, 1, 1}, Vec3d{1.25, 1, 1}, Vec3d{1, 1.25, 1}};
  const EnclosedTriangles enclosed({small}, frame_only.frame);
  const LatticeCoord a{0, 0, 0}, b{640, 0, 0}, c{0, 640, 0}, apex{0, 0, 640};
  const auto allowed = [&](const LatticeCoord& to, Blocker* blocker) {
    const std::vector<NewFace> star = {{{0, 1, 2}, {to, a, b}}, {{0, 2, 3}, {to, b, c}}, {{0, 3, 1}, {to, c, a}}};
    std::vector<Tetrahedron> swept;
    for (const NewFace& f : star) {
      if (orient3d(apex, f.corners[1], f.corners[2], to) < 0) swept.push_back({apex, f.corners[1], f.corners[2], to});
    }
    return enclosed.allows(star, swept, blocker);
  };
  Blocker blocker;
  CHECK(allowed({0, 0, 400}, &blocker));
  CHECK_FALSE(allowed({0, 0, 8}, &blocker));  // wholly swept over: no face of the new star meets it
  CHECK(blocker.count == 3);
  CHECK(blocker.points[0] == Vec3d{64, 64, 64});
  CHECK_FALSE(allowed({0, 0, 80}, nullptr));  // a face of the new star cuts through, or it is swept over
}

TEST_CASE("the apex of least volume lies over all points and touches some", "[quick][meshing]") {
  const int seed = GENERATE(range(0, 20));
  std::mt19937 random{unsigned(seed)};
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  FanFit fit;
  for (int i = 0; i < 6; ++i) fit.add_rim({1000 * std::cos(i * M_PI / 3), 1000 * std::sin(i * M_PI / 3), 0});
  std::vector<Vec3d> points;
  for (int i = 0; i < 50; ++i) {
    points.push_back({1000 * place(random), 1000 * place(random), 100 + 100 * place(random)});
    fit.add_point(points.back(), 0);
  }
  REQUIRE(fit.close());
  const auto x = fit.least_volume({0, 0, 1000}, 2000);
  REQUIRE(x);
  double least = 1e300;
  for (const Vec3d& p : points) {  // height of the fan over p: it is a graph, so the lowest of what is over p's sector
    for (int i = 0; i < 6; ++i) {
      const Vec3d &a = fit.rim()[std::size_t(i)], &b = fit.rim()[std::size_t(i + 1) % 6];
      const Vec3d up{0, 0, 1};
      if (dot(cross(up, a - *x), p - *x) < 0 || dot(cross(up, b - *x), p - *x) >= 0) continue;
      const Vec3d n = cross(a - *x, b - *x);
      least = std::min(least, dot(n, *x - p) / n[2]);
    }
  }
  CHECK(least > 0);
  CHECK(least < 2);
}

TEST_CASE("all vertices together find what none finds alone", "[quick][meshing][tighten]") {
  // 128 faces around a ball of 2048. Moved one at a time, as far as each goes, the first ones take the room of the
  // others.
  const LatticeMesh scene = ball(20 * 64, 4);
  const LatticeMesh outer = ball(24 * 64, 2);
  REQUIRE_FALSE(touches(outer, scene));
  const EnclosedTriangles enclosed(scene_of(scene), outer.frame);
  TightenParams alone;
  alone.sweeps = 0;
  alone.final_sweeps = 20;
  TightenParams together = alone;
  together.sweeps = 20;
  TightenCounts counts;
  const LatticeMesh a = tighten(outer, enclosed, alone, counts);
  const LatticeMesh b = tighten(outer, enclosed, together, counts);
  CHECK(embedded(b));
  CHECK_FALSE(touches(b, scene));
  const double excess_a = volume(a) - volume(scene), excess_b = volume(b) - volume(scene);
  CAPTURE(excess_a / volume(scene), excess_b / volume(scene));
  CHECK(excess_b > 0);
  CHECK(excess_b < 0.7 * excess_a);  // measured: 0.55
}
