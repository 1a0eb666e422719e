// The scene against the proxy.
#include <limits>
#include <random>

#include "lib/check/detail/surface.h"
#include "lib/core/parallel.h"
#include "lib/exact/triangle_intersection.h"
#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Winding number by solid angles: floating point, no rays, no cases.
double solid_angle_winding(const std::vector<TriangleD>& triangles, const Vec3d& p) {
  double sum = 0;
  for (const TriangleD& t : triangles) {
    Vec3d a, b, c;
    for (std::size_t i = 0; i < 3; ++i) a[i] = t[0][i] - p[i], b[i] = t[1][i] - p[i], c[i] = t[2][i] - p[i];
    const auto dot = [](const Vec3d& u, const Vec3d& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
    const double det =
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    sum += std::atan2(det, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (2 * M_PI);
}

}  // namespace

TEST_CASE("a scene inside is enclosed, also far from the origin", "[quick][check]") {
  const double far = GENERATE(0.0, 6e6);
  const Vec3d c{far, -far, far / 2};
  const CheckReport r = check(sphere(3, 2, c), triangles_of(sphere(4, 1.9, c)));
  CHECK(r.encloses());
  CHECK(r.holds());
  CHECK(r.scene_triangles == 2048);
  CHECK(r.sides_decided);
  CHECK(r.scene_to_proxy.has_value());
  CHECK(r.proxy_to_scene.has_value());
}

TEST_CASE("an open scene has no volume, a closed one that of itself wherever the proxy lies", "[quick][check]") {
  std::vector<TriangleD> scene = triangles_of(box({5, 6, 7}, {6, 8, 8}));
  CHECK(check(box({0, 0, 0}, {20, 20, 20}), scene).scene_volume == 2.0);
  CHECK(check(box({-3, 2, 1}, {9, 9, 9}), scene).scene_volume == 2.0);
  for (TriangleD& t : scene) std::swap(t[0], t[1]);
  CHECK(check(box({-3, 2, 1}, {9, 9, 9}), scene).scene_volume == -2.0);
  std::swap(scene[0][0], scene[0][1]);
  CHECK_FALSE(check(box({0, 0, 0}, {20, 20, 20}), scene).scene_volume);
  scene.erase(scene.begin());
  CHECK_FALSE(check(box({0, 0, 0}, {20, 20, 20}), scene).scene_volume);
}

TEST_CASE("a scene vertex beyond the range of doubles' exact predicates is judged where it is", "[quick][check]") {
  const IndexedMesh proxy = box({0, 0, 0}, {1, 1, 1});
  const double least = std::numeric_limits<double>::denorm_min();
  const auto with = [](const Vec3d& p) { return std::vector<TriangleD>{{{{0.5, 0.5, 0.5}, {0.5, 0.25, 0.5}, p}}}; };
  CHECK(check(proxy, with({least, 0.5, 0.5})).holds());
  CHECK(check(proxy, with({0, 0.5, 0.5})).touching.count == 1);
  CHECK(check(proxy, with({-least, 0.5, 0.5})).touching.count == 1);
  CHECK(check(proxy, with({1e300, 0.5, 0.5})).touching.count == 1);
  const std::vector<TriangleD> away{{{{1e300, 0, 0}, {1e300, 1e200, 0}, {1e300, 0, 1e-200}}}};
  CHECK(check(proxy, away).outside.count == 1);
  CHECK_FALSE(check(proxy, away).scene_to_proxy);  // its square is no double
  CHECK(check(proxy, {{{{least, least, least}, {2 * least, least, least}, {least, least, 0.5}}}}).holds());
}

TEST_CASE("a scene triangle that pokes out by one unit in the last place touches", "[quick][check]") {
  const double far = GENERATE(1.0, 6e6);
  const IndexedMesh proxy = box({far, far, far}, {far + 2, far + 2, far + 2});
  const double top = far + 2;
  const auto with_tip = [&](double z) {
    return std::vector<TriangleD>{
        {{{far + 0.5, far + 0.5, far + 0.5}, {far + 1.5, far + 0.5, far + 0.5}, {far + 1.25, far + 0.75, z}}}};
  };
  const CheckReport out = check(proxy, with_tip(std::nextafter(top, 1e9)));
  CHECK(out.touching.count == 1);
  CHECK(out.outside.count == 0);
  CHECK_FALSE(out.holds());
  CHECK(check(proxy, with_tip(top)).touching.count == 1);  // touching from inside
  CHECK_FALSE(check(proxy, with_tip(top)).holds());
  CHECK(check(proxy, with_tip(std::nextafter(top, 0.0))).holds());
}

TEST_CASE("a scene triangle in the plane of a face touches it only where they overlap", "[quick][check]") {
  const IndexedMesh proxy = cube(1);
  const CheckReport on = check(proxy, {{{{-0.5, -0.5, 1}, {0.5, -0.5, 1}, {0, 0.5, 1}}}});
  CHECK(on.touching.count == 1);
  const CheckReport beside = check(proxy, {{{{2, -0.5, 1}, {3, -0.5, 1}, {2.5, 0.5, 1}}}});
  CHECK(beside.touching.count == 0);
  CHECK(beside.outside.count == 1);
}

TEST_CASE("triangles entirely outside are counted with number and position", "[quick][check]") {
  std::vector<TriangleD> scene = triangles_of(cube(0.5));
  for (const TriangleD& t : triangles_of(cube(0.5, {4, 0, 0}))) scene.push_back(t);
  const CheckReport r = check(cube(1), scene);
  CHECK(r.outside.count == 12);
  CHECK(r.touching.count == 0);
  CHECK_FALSE(r.encloses());
  CHECK(r.outside.examples.size() == 5);
  CHECK(r.outside.examples.at(0).index == 12);
  CHECK(r.outside.examples.at(0).position[0] > 3);
}

TEST_CASE("a scene around the proxy is outside", "[quick][check]") {
  const CheckReport r = check(cube(1), triangles_of(cube(2)));
  CHECK(r.outside.count == 12);
  CHECK(r.touching.count == 0);
}

TEST_CASE("a scene in a cavity of the proxy is outside, in a nested shell inside", "[quick][check]") {
  CHECK(check(join(cube(3), inverted(cube(2))), triangles_of(cube(1))).outside.count == 12);
  CHECK(check(join(cube(3), cube(2)), triangles_of(cube(1))).holds());
  CHECK(check(join(cube(3), inverted(cube(1))), triangles_of(cube(2))).holds());  // around the cavity
}

TEST_CASE("everything is outside an inverted proxy", "[quick][check]") {
  CHECK(check(inverted(cube(2)), triangles_of(cube(1))).outside.count == 12);
}

TEST_CASE("an open proxy decides no sides but still counts crossings", "[quick][check]") {
  IndexedMesh open = cube(1);
  open.triangles.pop_back();
  const CheckReport r = check(open, triangles_of(cube(0.5)));
  CHECK_FALSE(r.sides_decided);
  CHECK_FALSE(r.encloses());
  CHECK(r.outside.count == 0);
  CHECK(check(open, triangles_of(box({0, 0, 0}, {0.5, 0.5, 3}))).touching.count > 0);
}

TEST_CASE("a corner of the scene that only touches an edge or a vertex of the proxy counts", "[quick][check]") {
  const auto at = [](const Vec3d& p) { return std::vector<TriangleD>{{{p, {0, 0, 0}, {0.1, 0.2, 0}}}}; };
  CHECK(check(cube(1), at({1, 1, 0.25})).touching.count == 1);
  CHECK(check(cube(1), at({1, 1, 1})).touching.count == 1);
  CHECK(check(cube(1), at({std::nextafter(1, 0), std::nextafter(1, 0), std::nextafter(1, 0)})).holds());
}

TEST_CASE("a scene triangle of no area is tested as the segment it is", "[quick][check]") {
  CHECK(check(cube(1), {{{{0, 0, 0}, {0, 0, 0.5}, {0, 0, 1}}}}).touching.count == 1);
  CHECK(check(cube(1), {{{{0, 0, 0}, {0, 0, 0.5}, {0, 0, 0.25}}}}).holds());
  CHECK(check(cube(1), {{{{5, 5, 5}, {5, 5, 5}, {5, 5, 5}}}}).outside.count == 1);
}

TEST_CASE("a scene coordinate that is no place is a violation of its own", "[quick][check]") {
  const double nowhere = GENERATE(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN());
  const CheckReport r = check(cube(1), {{{{nowhere, 0, 0}, {0, 0, 0.5}, {0, 0.1, 0.25}}}});
  CHECK(r.undecidable_scene.count == 1);
  CHECK_FALSE(r.holds());
  CHECK_FALSE(r.scene_to_proxy.has_value());
}

TEST_CASE("winding numbers equal solid angles where rays meet edges, corners and vertical faces", "[quick][check]") {
  // Boxes on small integer coordinates, overlapping, nested and inverted; points above and below their corners.
  const int seed = GENERATE(range(0, 20));
  std::mt19937 random(std::uint32_t(seed) + 1);
  std::uniform_int_distribution<int> low(0, 3), size(1, 3);
  IndexedMesh m;
  for (int b = 0; b < 4; ++b) {
    const Vec3d l{double(low(random)), double(low(random)), double(low(random))};
    const IndexedMesh one = box(l, {l[0] + size(random), l[1] + size(random), l[2] + size(random)});
    m = join(m, b % 2 == 1 ? inverted(one) : one);
  }
  m = join(m, sphere(0, 2, {3, 3, 3}));
  CheckReport report;
  WeldedMesh welded = weld(m, 0, report);
  check_topology(welded, 0, report);
  const Surface surface(welded);
  const auto triangles = triangles_of(m);
  int tested = 0, nonzero = 0;
  for (double x = 0; x <= 6; x += 0.5)
    for (double y = 0; y <= 6; y += 0.5)
      for (double z = -0.5; z <= 6; z += 0.5) {
        const Vec3d p{x, y, z};
        if (surface.touched_by({p, p, p}) != Surface::kNone) continue;
        const double expected = solid_angle_winding(triangles, p);
        CAPTURE(x, y, z, expected);
        REQUIRE(surface.winding(p) == std::lround(expected));
        ++tested, nonzero += surface.winding(p) != 0;
      }
  CHECK(tested > 500);
  CHECK(nonzero > 20);
}

TEST_CASE("the verdict does not depend on threads or on how the scene arrives", "[quick][check]") {
  // A shell that pokes through the proxy here and there, larger than one work item.
  IndexedMesh proxy = sphere(2, 1.02);
  const std::vector<TriangleD> scene = triangles_of(sphere(6, 1));
  const auto run = [&](int threads, std::size_t batch) {
    const ThreadLimit limit(threads);
    VectorSource source(scene, batch);
    return check_proxy(proxy, &source);
  };
  const CheckReport a = run(1, 100), b = run(2, 30000);
  CHECK(a.touching.count > 0);
  CHECK(a.outside.count > 0);
  CHECK(a.touching.count == b.touching.count);
  CHECK(a.outside.count == b.outside.count);
  CHECK(a.touching.examples.at(4).index == b.touching.examples.at(4).index);
  CHECK(a.touching.examples.at(4).other == b.touching.examples.at(4).other);
  CHECK(a.scene_volume == b.scene_volume);
  CHECK(a.scene_to_proxy->mean == b.scene_to_proxy->mean);
  CHECK(a.proxy_to_scene->max == b.proxy_to_scene->max);
  CHECK(a.proxy_to_scene->where == b.proxy_to_scene->where);
}

TEST_CASE("touching and outside triangles equal a test of all pairs", "[quick][check]") {
  const IndexedMesh proxy = sphere(2, 1.02);
  const std::vector<TriangleD> scene = triangles_of(sphere(4, 1));
  const auto faces = triangles_of(proxy);
  std::uint64_t touching = 0, outside = 0;
  for (const TriangleD& t : scene) {
    const bool touches = std::any_of(faces.begin(), faces.end(),
                                     [&](const TriangleD& f) { return triangles_intersect(t.data(), f.data()); });
    touching += touches;
    outside += !touches && solid_angle_winding(faces, t[0]) < 0.5;
  }
  const CheckReport r = check(proxy, scene);
  CHECK(r.touching.count == touching);
  CHECK(r.outside.count == outside);
}

TEST_CASE("triangles scattered inside and outside are told apart one by one", "[quick][check]") {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> c(-2, 2);
  std::vector<TriangleD> scene(30000);
  std::uint64_t outside = 0;
  for (TriangleD& t : scene) {
    const Vec3d p{c(random), c(random), c(random)};
    t = {p, {p[0] + 1e-9, p[1], p[2]}, {p[0], p[1] + 1e-9, p[2]}};
    outside += std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) > 1;
  }
  const CheckReport r = check(cube(1), scene);
  CHECK(r.touching.count == 0);
  CHECK(r.outside.count == outside);
}

TEST_CASE("volumes and distances are those of concentric spheres and boxes", "[quick][check]") {
  const CheckReport r = check(cube(2), triangles_of(cube(1)));
  CHECK(std::abs(*r.volume - 64) < 1e-12);
  CHECK(std::abs(*r.scene_volume - 8) < 1e-12);
  CHECK(std::abs(r.scene_to_proxy->max - 1) < 1e-12);
  CHECK(std::abs(r.scene_to_proxy->mean - 1) < 1e-12);
  CHECK(std::abs(r.proxy_to_scene->max - std::sqrt(3.0)) < 1e-12);
  CHECK(r.scene_to_proxy->samples == 20);  // 8 corners, 12 centroids
}

TEST_CASE("a scene beyond the budget has no distance from the proxy, and the report says so", "[quick][check]") {
  CheckOptions options;
  options.scene_memory_bytes = 1000;
  VectorSource source(triangles_of(sphere(3, 1)));
  const CheckReport r = check_proxy(sphere(3, 2), &source, options);
  CHECK(r.holds());
  CHECK(r.scene_to_proxy.has_value());
  CHECK_FALSE(r.proxy_to_scene.has_value());
  CHECK(r.distance_note.find("512 triangles") != std::string::npos);
}

TEST_CASE("sampling caps the number of triangles and finds about the same distance", "[quick][check]") {
  CheckOptions options;
  options.distance_samples = 500;
  VectorSource source(triangles_of(sphere(5, 1)));
  const CheckReport r = check_proxy(sphere(5, 2), &source, options);
  CHECK(r.scene_to_proxy->samples <= 2000);
  CHECK(r.scene_to_proxy->samples > 500);
  CHECK(std::abs(r.scene_to_proxy->mean - 1) < 0.01);
}

TEST_CASE("the largest distance is within its bounds where no corner and no middle of a face has it",
          "[quick][check]") {
  // Two posts below the roof of a long box: farthest from them is a place between, where the roof has no corner.
  std::vector<TriangleD> scene;
  for (const double x : {0.0, 30.0, 96.0}) {
    for (TriangleD t : triangles_of(cube(1))) {
      for (Vec3d& p : t) p[0] += x;
      scene.push_back(t);
    }
  }
  IndexedMesh proxy = cube(1);
  for (Vec3d& p : proxy.vertices) p = {p[0] < 0 ? -1.5 : 97.5, 1.5 * p[1], 1.5 * p[2]};
  const CheckReport r = check(proxy, scene);
  CHECK(r.holds());
  CHECK(r.scene_to_proxy->at_most == r.scene_to_proxy->max);
  const double farthest = std::sqrt(32 * 32 + 2 * 0.5 * 0.5);  // from x = 63: 32 from both posts
  CHECK(r.proxy_to_scene->max <= farthest * (1 + 1e-12));
  CHECK(r.proxy_to_scene->max >= farthest * 0.998);
  CHECK(*r.proxy_to_scene->at_most >= farthest * (1 - 1e-12));
  CHECK(*r.proxy_to_scene->at_most <= farthest * 1.002);
  CHECK(std::abs(r.proxy_to_scene->where[0] - 63) < 1);
}

TEST_CASE("the nearest triangle equals a search of all", "[quick][check]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> c(-2, 2), d(-0.3, 0.3);
  std::vector<TriangleD> triangles(500);
  for (TriangleD& t : triangles) {
    const Vec3d p{c(random), c(random), c(random)};
    for (Vec3d& q : t) q = {p[0] + d(random), p[1] + d(random), p[2] + d(random)};
  }
  const TriangleBvh bvh(triangles);
  for (int n = 0; n < 500; ++n) {
    const Vec3d p{c(random), c(random), c(random)};
    double least = HUGE_VAL;
    for (const TriangleD& t : triangles) {
      least = std::min(least, distance_squared(p, t));
      // the distance itself against a fine sampling of the triangle
      if (n == 0) {
        double sampled = HUGE_VAL;
        for (int i = 0; i <= 100; ++i)
          for (int j = 0; i + j <= 100; ++j) {
            double sum = 0;
            for (std::size_t k = 0; k < 3; ++k) {
              const double q = t[0][k] + (t[1][k] - t[0][k]) * i / 100 + (t[2][k] - t[0][k]) * j / 100;
              sum += (q - p[k]) * (q - p[k]);
            }
            sampled = std::min(sampled, sum);
          }
        const double exact = std::sqrt(distance_squared(p, t));
        CHECK(exact <= std::sqrt(sampled) + 1e-12);
        CHECK(exact >= std::sqrt(sampled) - 0.01);
      }
    }
    CHECK(bvh.nearest(p).distance_squared == least);
  }
}
