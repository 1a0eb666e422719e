#include <random>

#include "lib/check/check_proxy.h"
#include "lib/core/error.h"
#include "lib/core/predicates.h"
#include "lib/meshing/convex_parts.h"
#include "tests/catch.h"
#include "tests/support/voxel_source.h"

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

bool convex_around(const LatticeMesh& hull, const std::vector<LatticeCoord>& all) {
  for (const auto& t : hull.triangles) {
    for (const LatticeCoord& p : all) {
      if (orient3d(hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]], p) > 0) return false;
    }
  }
  return true;
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
  CHECK_THROWS_AS(convex_hull(mesh), Error);
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

}  // namespace bp::test
