#include <map>
#include <random>
#include <set>

#include "lib/check/check_proxy.h"
#include "lib/core/parallel.h"
#include "lib/exact/predicates.h"
#include "lib/hulls/convex_parts.h"
#include "lib/hulls/detail/convex_shape.h"
#include "lib/hulls/detail/convex_simplify.h"
#include "lib/mesh/lattice_geometry.h"
#include "tests/catch.h"
#include "tests/support/lattice_boxes.h"
#include "tests/support/voxel_source.h"
#include "tests/unit/check/meshes.h"

namespace bp::test {

namespace {

/// Vertices only: a hull needs no triangles.
LatticeMesh points(unsigned seed, int n, std::int64_t reach) {
  LatticeMesh mesh;
  std::mt19937 random(seed);
  const auto pick = [&] { return std::int64_t(random() % std::uint64_t(2 * reach + 1)) - reach; };
  for (int i = 0; i < n; ++i) mesh.vertices.push_back({pick(), pick(), pick()});
  return mesh;
}

LatticeMesh convex_hull(const LatticeMesh& mesh) {
  const ConvexHull hull = *hull_of(mesh.vertices);
  LatticeMesh made;
  made.vertices = hull.vertices, made.triangles = hull.triangles;
  return made;
}

bool convex_around(const LatticeMesh& hull, const std::vector<LatticeCoord>& all) {
  for (const auto& t : hull.triangles) {
    for (const LatticeCoord& p : all) {
      if (orient3d(hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]], p) > 0) return false;
    }
  }
  return true;
}

/// Cells of a plan, '#', as blocks of `edge`; rows are apart along y, characters along x, and all are `edge` high.
LatticeMesh blocks(const std::vector<std::string>& plan, std::int64_t edge) {
  LatticeMesh mesh;
  std::map<LatticeCoord, std::uint32_t> number;
  const auto vertex = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    const LatticeCoord p{x * edge, y * edge, z * edge};
    const auto [found, is_new] = number.emplace(p, std::uint32_t(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(p);
    return found->second;
  };
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
  };
  const auto full = [&](std::int64_t x, std::int64_t y) {
    return y >= 0 && y < std::int64_t(plan.size()) && x >= 0 && x < std::int64_t(plan[0].size()) &&
           plan[std::size_t(y)][std::size_t(x)] == '#';
  };
  for (std::int64_t y = 0; y < std::int64_t(plan.size()); ++y) {
    for (std::int64_t x = 0; x < std::int64_t(plan[0].size()); ++x) {
      if (!full(x, y)) continue;
      quad(vertex(x, y, 1), vertex(x + 1, y, 1), vertex(x + 1, y + 1, 1), vertex(x, y + 1, 1));
      quad(vertex(x, y, 0), vertex(x, y + 1, 0), vertex(x + 1, y + 1, 0), vertex(x + 1, y, 0));
      const std::array<std::int64_t, 2> ring[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                                        beside[] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
      for (std::size_t k = 0; k < 4; ++k) {
        if (full(x + beside[k][0], y + beside[k][1])) continue;
        const auto &a = ring[k], &b = ring[(k + 1) % 4];
        quad(vertex(x + a[0], y + a[1], 0), vertex(x + b[0], y + b[1], 0), vertex(x + b[0], y + b[1], 1),
             vertex(x + a[0], y + a[1], 1));
      }
    }
  }
  return mesh;
}

/// A ball with deep dents and long thorns: what is seen from its centre lies in it.
LatticeMesh thorny(unsigned seed, int levels, double reach) {
  const IndexedMesh ball = sphere(levels, 1);
  LatticeMesh mesh;
  std::mt19937 random(seed);
  for (const Vec3d& p : ball.vertices) {
    const double r = reach * (0.2 + 0.8 * double(random() % 1000) / 1000);
    mesh.vertices.push_back({std::llround(r * p[0]), std::llround(r * p[1]), std::llround(r * p[2])});
  }
  mesh.triangles = ball.triangles;
  return mesh;
}

double volume6_in(const ConvexParts& parts) {
  double sum = 0;
  for (const LatticeMesh& hull : parts.hulls) sum += double(volume6_of(hull));
  return sum;
}

IndexedMesh all_of(const ConvexParts& parts) {
  IndexedMesh all;
  for (const LatticeMesh& hull : parts.hulls) all = join(all, indexed(hull));
  return all;
}

bool in_a_hull(const ConvexParts& parts, const LatticeCoord& p, std::int64_t scale) {
  for (const LatticeMesh& hull : parts.hulls) {
    bool inside = true;
    for (const auto& t : hull.triangles) {
      const auto at = [&](std::size_t k) { return hull.vertices[t[k]] * scale; };
      inside = inside && orient3d(at(0), at(1), at(2), p) <= 0;
    }
    if (inside) return true;
  }
  return false;
}

/// How far hulls reach out of the mesh's box, in shares of its longest side.
double reach_of(const ConvexParts& parts, const LatticeMesh& mesh) {
  const LatticeBox box = box_of(mesh.vertices);
  std::int64_t reach = 0, side = 0;
  for (int i = 0; i < 3; ++i) {
    side = std::max(side, box.max[i] - box.min[i]);
    for (const LatticeMesh& hull : parts.hulls) {
      const LatticeBox around = box_of(hull.vertices);
      reach = std::max({reach, box.min[i] - around.min[i], around.max[i] - box.max[i]});
    }
  }
  return double(reach) / double(side);
}

/// Returns the proof of bpcheck --convex for `scene` and for the hulls.
CheckReport proof(const ConvexParts& parts, const std::vector<TriangleD>& scene) {
  VectorSource source(scene);
  CheckOptions options;
  options.convex = true;
  return check_proxy(all_of(parts), &source, options);
}

/// Triangles of the surface, drawn a little towards a point that sees all of it.
std::vector<TriangleD> shrunk(const LatticeMesh& mesh, double by, const Vec3d& centre = {0, 0, 0}) {
  std::vector<TriangleD> triangles = triangles_of(indexed(mesh));
  for (TriangleD& t : triangles) {
    for (Vec3d& p : t) {
      for (std::size_t i = 0; i < 3; ++i) p[i] = centre[i] + (1 - by) * (p[i] - centre[i]);
    }
  }
  return triangles;
}

}  // namespace

TEST_CASE("a hull is closed, convex, and has every point within, also of few distinct ones", "[quick][meshing][lod]") {
  const auto seed = GENERATE(range(0u, 12u));
  const std::int64_t reach = GENERATE(1, 2, 5, 1 << 20);
  CAPTURE(seed, reach);
  const LatticeMesh mesh = points(seed, 60, reach);
  const LatticeMesh hull = convex_hull(mesh);
  CHECK(convex_around(hull, mesh.vertices));
  const CheckReport report = check_proxy(indexed(hull), nullptr);
  CHECK(report.closed());
  CHECK(report.oriented());
  CHECK(report.manifold());
  CHECK(report.outward());
  CHECK(report.sound());
  CHECK(report.genus == 0);
}

TEST_CASE("points in a plane have no hull", "[quick][meshing][lod]") {
  LatticeMesh mesh = points(1, 20, 100);
  for (LatticeCoord& p : mesh.vertices) p.z = p.x + p.y;
  CHECK_FALSE(hull_of(mesh.vertices));
}

TEST_CASE("components come apart with their own vertices", "[quick][meshing][lod]") {
  LatticeMesh both = convex_hull(points(3, 30, 50));
  const std::size_t first = both.triangles.size();
  LatticeMesh other = convex_hull(points(4, 20, 50));
  for (auto t : other.triangles) {
    for (std::uint32_t& v : t) v += std::uint32_t(both.vertices.size());
    both.triangles.push_back(t);
  }
  for (const LatticeCoord& p : other.vertices) both.vertices.push_back(p + LatticeCoord{500, 0, 0});
  const std::vector<LatticeMesh> parts = components_of(both);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].triangles.size() == first);
  CHECK(parts[1].triangles.size() == other.triangles.size());
  CHECK(parts[1].vertices.size() == other.vertices.size());
}

TEST_CASE("blocks come apart into the boxes that they are of", "[quick][meshing][lod]") {
  struct Case {
    std::vector<std::string> plan;
    std::size_t boxes;
  };
  const auto& [plan, boxes] = GENERATE(Case{{"###"}, 1}, Case{{"#..", "#..", "###"}, 2}, Case{{"#.#", "#.#", "###"}, 3},
                                       Case{{"###", "#.#", "###"}, 4}, Case{{".#.", "###", ".#."}, 3});
  const std::int64_t edge = GENERATE(64, 4096);
  CAPTURE(plan, edge);
  const LatticeMesh mesh = blocks(plan, edge);
  const ConvexParts parts = convex_parts(mesh, {0});
  CHECK(parts.hulls.size() == boxes);
  CHECK(volume6_in(parts) < 1.06 * double(volume6_of(mesh)));
  const CheckReport r = proof(parts, {});
  CHECK(r.convex());
  CHECK(r.manifold());
  for (const LatticeMesh& hull : parts.hulls) CHECK(hull.vertices.size() <= 16);
}

TEST_CASE("hulls hold all of a solid, thorns and all, and are as few as was asked", "[quick][meshing][lod]") {
  const auto seed = GENERATE(range(0u, 6u));
  const std::size_t most = GENERATE(std::size_t(1), std::size_t(5), std::size_t(40));
  const double reach = GENERATE(40.0, 3000.0);
  CAPTURE(seed, most, reach);
  const LatticeMesh mesh = thorny(seed, 2, reach);
  const ConvexParts parts = convex_parts(mesh, {most});
  CHECK(parts.hulls.size() <= most);
  constexpr std::int64_t kSamples = 8;  // along an edge
  std::size_t out = 0;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const LatticeCoord a = mesh.vertices[t[k]], b = mesh.vertices[t[(k + 1) % 3]];
      for (std::int64_t i = 0; i < kSamples; ++i) out += in_a_hull(parts, a * (kSamples - i) + b * i, kSamples) ? 0 : 1;
    }
  }
  CHECK(out == 0);
  const CheckReport r = proof(parts, shrunk(mesh, 1e-6));  // the whole boundary, not only samples
  CHECK(r.holds());
  for (const LatticeMesh& hull : parts.hulls) CHECK(hull.vertices.size() <= kMostCorners);
}

TEST_CASE("more hulls lie nearer; one is the hull", "[quick][meshing][lod]") {
  const LatticeMesh mesh = thorny(3, 2, 2000);
  const double one = volume6_in(convex_parts(mesh, {1})), some = volume6_in(convex_parts(mesh, {12})),
               many = volume6_in(convex_parts(mesh, {60}));
  CHECK(some < 0.9 * one);
  CHECK(many < 0.9 * some);
  CHECK(one < 1.1 * double(volume6_of(convex_hull(mesh))));
  const LatticeMesh box = blocks({"##"}, 64);
  REQUIRE(convex_parts(box, {1}).hulls.size() == 1);
  CHECK(volume6_of(convex_parts(box, {1}).hulls[0]) == volume6_of(box));
  CHECK(convex_parts(box, {1}).hulls[0].vertices.size() == 8);
}

TEST_CASE("parts have a hull each, unless fewer are asked for: then near ones have one together",
          "[quick][meshing][lod]") {
  LatticeMesh mesh;
  for (std::int64_t i = 0; i < 60; ++i) {
    const LatticeCoord at{i % 2 * 150, i / 2 % 5 * 1000, i / 10 * 1000};
    add_box(mesh, {at, at + LatticeCoord{100, 100, 100}});
  }
  const ConvexParts each = convex_parts(mesh, {0});
  CHECK(each.solids == 60);
  CHECK(each.hulls.size() == 60);
  CHECK(volume6_in(each) == double(volume6_of(mesh)));
  const ConvexParts pairs = convex_parts(mesh, {30});
  CHECK(pairs.hulls.size() == 30);
  CHECK(volume6_in(pairs) == 1.25 * double(volume6_of(mesh)));
  CHECK(proof(pairs, shrunk(mesh, 0)).not_held.count == 12 * 60);  // it touches their sides
  CHECK(convex_parts(mesh, {7}).hulls.size() == 7);
}

TEST_CASE("narrow gaps between parts stay open", "[quick][meshing][lod]") {
  LatticeMesh mesh;
  for (std::int64_t i = 0; i < 40; ++i) {
    const LatticeCoord at{i * 1020, 0, 0};  // a fiftieth of a part apart
    add_box(mesh, {at, at + LatticeCoord{1000, 1000, 3000}});
  }
  CHECK(convex_parts(mesh, {0}).hulls.size() == 40);
  CHECK(convex_parts(mesh, {100}).hulls.size() == 40);
  CHECK_FALSE(convex_parts(mesh, {100}).limited);
  CHECK(convex_parts(mesh, {39}).hulls.size() == 39);
  CHECK(convex_parts(mesh, {39}).limited);
  CHECK(convex_parts(mesh, {1}).hulls.size() == 1);
}

TEST_CASE("cavities stay open where hulls can leave them so", "[quick][meshing][lod]") {
  LatticeMesh mesh;
  add_box(mesh, {{0, 0, 0}, {1000, 1000, 1000}});
  add_box(mesh, {{100, 100, 100}, {900, 900, 900}}, false);
  add_box(mesh, {{400, 400, 400}, {600, 600, 600}});  // a part of its own, within
  const ConvexParts parts = convex_parts(mesh, {0});
  CHECK(parts.solids == 2);
  CHECK(parts.hulls.size() == 7);
  CHECK(in_a_hull(parts, {50, 50, 50}, 1));
  CHECK(in_a_hull(parts, {500, 500, 500}, 1));
  CHECK_FALSE(in_a_hull(parts, {250, 250, 250}, 1));
}

TEST_CASE("hulls are the same with one thread and with several", "[quick][meshing][lod]") {
  const LatticeMesh mesh = thorny(9, 2, 3000);
  const auto vertices = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<LatticeCoord> all;
    for (const LatticeMesh& hull : convex_parts(mesh, {20}).hulls)
      all.insert(all.end(), hull.vertices.begin(), hull.vertices.end());
    return all;
  };
  CHECK(vertices(1) == vertices(3));
}

TEST_CASE("hulls keep to the faces asked, without slivers, and hold all of the solid", "[quick][meshing][lod]") {
  const auto seed = GENERATE(range(0u, 3u));
  const std::uint64_t faces = GENERATE(std::uint64_t(4), std::uint64_t(7), std::uint64_t(50), std::uint64_t(300));
  CAPTURE(seed, faces);
  const LatticeMesh mesh = thorny(seed, 2, 3000);
  const ConvexParts parts = convex_parts(mesh, {0, faces});
  std::size_t sum = 0;
  for (const LatticeMesh& hull : parts.hulls) {
    sum += hull.triangles.size();
    CHECK(slivers_of({hull.vertices, hull.triangles}) == 0);
  }
  CHECK(sum <= faces);
  CHECK(parts.short_of_faces);
  if (faces >= 50) CHECK(reach_of(parts, mesh) <= 3 * kNearBox);  // a single hull may reach as far as it must
  CHECK(proof(parts, shrunk(mesh, 1e-6)).holds());
}

TEST_CASE("faces that do not suffice for each part are for several together", "[quick][meshing][lod]") {
  LatticeMesh mesh;
  for (std::int64_t i = 0; i < 60; ++i) {
    const LatticeCoord at{i % 2 * 150, i / 2 % 5 * 1000, i / 10 * 1000};
    add_box(mesh, {at, at + LatticeCoord{100, 100, 100}});
  }
  CHECK_FALSE(convex_parts(mesh, {0, 12 * 60}).short_of_faces);
  CHECK(convex_parts(mesh, {0, 12 * 60}).hulls.size() == 60);
  const ConvexParts pairs = convex_parts(mesh, {0, 12 * 30});  // as pairs they are boxes; alone, tetrahedra are larger
  CHECK(pairs.hulls.size() <= 45);
  CHECK(volume6_in(pairs) < 1.6 * double(volume6_of(mesh)));
  CHECK(proof(pairs, shrunk(mesh, 0)).convex());
}

TEST_CASE("a hull with fewer corners is around the one with more", "[quick][meshing][lod]") {
  const auto most = GENERATE(std::size_t(8), std::size_t(20), std::size_t(64), std::size_t(400));
  LatticeMesh ball;
  for (const Vec3d& p : sphere(3, 1000).vertices) ball.vertices.push_back(rounded(p));
  const ConvexHull hull = *hull_of(ball.vertices);
  const ConvexHull fewer = with_fewer_corners(hull, most, 0);
  CHECK(fewer.vertices.size() <= most);
  CHECK(fewer.vertices.size() <= hull.vertices.size());
  LatticeMesh mesh;
  mesh.vertices = fewer.vertices, mesh.triangles = fewer.triangles;
  CHECK(convex_around(mesh, hull.vertices));
  if (most == 64) CHECK(volume6_of(fewer) < 1.15 * volume6_of(hull));
  if (most == 400) CHECK(volume6_of(fewer) == volume6_of(hull));
}

TEST_CASE("hulls at the same place are set apart, also very thin ones", "[quick][meshing][lod]") {
  const std::int64_t thick = GENERATE(1, 2, 3, 5, 100), wide = GENERATE(1, 100, 4096);
  CAPTURE(thick, wide);
  LatticeMesh boxes;
  add_box(boxes, {{0, 0, 0}, {wide, 100, thick}});
  const ConvexHull box = *hull_of(boxes.vertices);
  std::vector<ConvexHull> hulls(GENERATE(std::size_t(3), std::size_t(12)), box);
  set_corners_apart(hulls);
  std::set<LatticeCoord> places;
  std::size_t corners = 0;
  for (const ConvexHull& hull : hulls) {
    places.insert(hull.vertices.begin(), hull.vertices.end());
    LatticeMesh mesh;
    mesh.vertices = hull.vertices, mesh.triangles = hull.triangles;
    CHECK(convex_around(mesh, box.vertices));
    corners += hull.vertices.size();
  }
  CHECK(places.size() == corners);
}

TEST_CASE("hulls keep to the corners asked for", "[quick][meshing][lod]") {
  const std::size_t corners = GENERATE(std::size_t(8), std::size_t(16), std::size_t(32));
  const LatticeMesh mesh = thorny(2, 2, 3000);
  HullLimits limits;
  limits.hulls = 12, limits.corners = corners;
  const ConvexParts parts = convex_parts(mesh, limits);
  for (const LatticeMesh& hull : parts.hulls) CHECK(hull.vertices.size() <= corners);
  CHECK(proof(parts, shrunk(mesh, 1e-6)).holds());
}

}  // namespace bp::test
