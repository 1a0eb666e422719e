#include "lib/check/detail/surface.h"
#include "lib/core/parallel.h"
#include "lib/enclosed/enclosed_voxels.h"
#include "lib/simplify/collapse_regions.h"
#include "lib/simplify/cost_order.h"
#include "lib/simplify/regions.h"
#include "lib/surface/repair.h"
#include "lib/surface/surface.h"
#include "lib/tighten/detail/tighten_regions.h"
#include "lib/tighten/tight_proxy.h"
#include "tests/support/proxy_checks.h"
#include "tests/support/random_lattice.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr VoxelBox kGround{{0, 0, 0}, {60, 60, 20}};
constexpr std::uint64_t kPerRegion = 600;

/// Towers of all heights, some on air: nothing is flat, and parts lie close to each other.
struct Towers {
  Towers() {
    RandomLattice random(7);
    std::vector<int> height(std::size_t(kGround.max.x * kGround.max.y));
    for (int& h : height) h = int(random.between(1, 17));
    solid = [height](VoxelCoord p) {
      const int h = height[std::size_t(p.y * kGround.max.x + p.x)];
      return p.z < h && (h % 5 != 0 || p.z != h - 3);
    };
    fill_shelf(shelf, kGround, solid);
    repair_contacts(shelf);
  }
  [[nodiscard]] LatticeMesh surface() const {
    GridFrame frame;
    frame.voxel = 1;
    return dense_surface(shelf, frame);
  }
  Solid solid;
  MemoryShelf shelf;
};

Piece piece_of(const LatticeMesh& mesh) {
  return {kEverywhere, mesh.vertices, mesh.triangles, {}};
}

IndexedMesh in_world(const LatticeMesh& mesh) {
  IndexedMesh out;
  for (const LatticeCoord& v : mesh.vertices) out.vertices.push_back(mesh.frame.world(v));
  out.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  return out;
}

/// Checks that the proxy is embedded, and around a sample of the voxels.
void check_large_proxy(const LatticeMesh& proxy, const Solid& solid) {
  CheckReport report;
  WeldedMesh welded = weld(in_world(proxy), 3, report);
  check_topology(welded, 3, report);
  const Surface surface(welded);
  CHECK(report.closed());
  CHECK(report.oriented());
  CHECK(report.manifold());
  CHECK(surface.self_intersections(3).count == 0);
  CHECK(inverted_components(welded, surface, 3).count == 0);
  RandomLattice random(3);
  for (int i = 0; i < 20000; ++i) {
    const VoxelCoord p{std::int32_t(random.between(0, kGround.max.x - 1)),
                       std::int32_t(random.between(0, kGround.max.y - 1)),
                       std::int32_t(random.between(0, kGround.max.z - 1))};
    if (!solid(p)) continue;
    const Vec3d centre = proxy.frame.world(LatticeCoord{p.x, p.y, p.z} * kLatticePerVoxel + LatticeCoord{32, 32, 32});
    if (surface.winding(centre) < 1) FAIL_CHECK("voxel outside: " << p.x << ' ' << p.y << ' ' << p.z);
  }
}

}  // namespace

TEST_CASE("a vertex is free in one region at most, which knows all that reaches into its cell", "[quick][meshing]") {
  const Towers towers;
  const Piece whole = piece_of(towers.surface());
  const int turn = GENERATE(0, 1, 2);
  const std::vector<Region> regions = regions_of(whole, kPerRegion, turn);
  REQUIRE(regions.size() > 8);
  std::vector<int> free_in(whole.vertices.size(), 0), changed_in(whole.triangles.size(), 0);
  for (const Region& region : regions) {
    std::vector<char> here(whole.triangles.size(), 0);
    for (std::size_t i = 0; i < region.faces.size(); ++i) {
      here[region.faces[i]] = 1;
      changed_in[region.faces[i]] += i >= region.fixed;
    }
    for (std::size_t i = 0; i < region.vertices.size(); ++i) {
      if (!region.free[i]) continue;
      ++free_in[region.vertices[i]];
      REQUIRE(region.cell.holds_inside(whole.vertices[region.vertices[i]]));
    }
    for (FaceId f = 0; f < whole.triangles.size(); ++f) {
      const auto& [a, b, c] = whole.triangles[f];
      const LatticeBox box = box_of(whole.vertices[a], whole.vertices[b], whole.vertices[c]);
      REQUIRE(bool(here[f]) == region.cell.meets(box));
    }
    const HalfEdgeMesh mesh = mesh_of(whole, region);
    for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
      bool any_free = false;
      for (HalfEdgeId h = 3 * f; h < 3 * f + 3; ++h) any_free = any_free || !mesh.locked(mesh.from(h));
      REQUIRE(any_free == (f >= region.fixed));
      if (any_free) {
        REQUIRE(region.cell.holds(box_of(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2))));
      }
    }
  }
  CHECK(*std::max_element(free_in.begin(), free_in.end()) == 1);
  CHECK(*std::max_element(changed_in.begin(), changed_in.end()) == 1);
  CHECK(std::count(free_in.begin(), free_in.end(), 1) > std::int64_t(whole.vertices.size() / 2));
}

TEST_CASE("what was changed in regions comes back to its place, and the rest stays", "[quick][meshing]") {
  const Towers towers;
  const LatticeMesh surface = towers.surface();
  Piece whole = piece_of(surface);
  const std::vector<Region> regions = regions_of(whole, kPerRegion, 0);
  for (const Region& region : regions) put_back(mesh_of(whole, region), region, whole);
  drop_removed(whole);
  CHECK(whole.vertices == surface.vertices);
  CHECK(whole.triangles == surface.triangles);
  HalfEdgeMesh mesh = mesh_of(whole, regions[1]);
  HalfEdgeId h = 0;
  while (!mesh.can_collapse(h)) ++h;
  const LatticeCoord kept = mesh.position(mesh.from(h)), lost = mesh.position(mesh.to(h));
  mesh.collapse(h, kept);
  put_back(mesh, regions[1], whole);
  drop_removed(whole);
  CHECK(whole.triangles.size() == surface.triangles.size() - 2);
  CHECK(whole.vertices.size() == surface.vertices.size() - 1);
  CHECK(std::count(whole.vertices.begin(), whole.vertices.end(), lost) == 0);
  CHECK_NOTHROW(HalfEdgeMesh(whole.vertices, whole.triangles, kEverywhere));
}

TEST_CASE("a shell that goes as a whole takes faces along that had stayed", "[quick][meshing]") {
  const Towers towers;
  Piece whole = piece_of(towers.surface());
  const std::vector<Region> regions = regions_of(whole, kPerRegion, 0);
  const auto inner = std::find_if(regions.begin(), regions.end(), [](const Region& r) {
    return r.cell.min.x > kEverywhere.min.x && r.cell.min.y > kEverywhere.min.y;
  });
  REQUIRE(inner != regions.end());
  // A tetrahedron above the ground, its base in two sides of the cell: corners that are locked, and a free apex.
  const std::int64_t x = inner->cell.min.x, y = inner->cell.min.y, z = 40 * kLatticePerVoxel;
  const auto n = std::uint32_t(whole.vertices.size());
  whole.vertices.insert(whole.vertices.end(),
                        {{x, y + 60, z}, {x, y + 60, z + 60}, {x + 60, y, z + 30}, {x + 30, y + 50, z + 30}});
  for (const Triangle& t : {Triangle{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}})
    whole.triangles.push_back({n + t[0], n + t[1], n + t[2]});
  const std::size_t faces = whole.triangles.size();
  std::size_t gone = 0;
  for (const Region& region : regions_of(whole, kPerRegion, 0)) {
    const auto at = std::find(region.vertices.begin(), region.vertices.end(), n + 3);
    if (at == region.vertices.end() || !region.free[std::size_t(at - region.vertices.begin())]) continue;
    CHECK(std::count_if(region.faces.begin(), region.faces.begin() + std::ptrdiff_t(region.fixed),
                        [&](FaceId f) { return f >= faces - 4; }) == 1);
    HalfEdgeMesh mesh = mesh_of(whole, region);
    for (FaceId f = 0; f < region.faces.size(); ++f) {
      if (region.faces[f] >= faces - 4) mesh.erase(f), ++gone;
    }
    put_back(mesh, region, whole);
  }
  REQUIRE(gone == 4);
  drop_removed(whole);
  CHECK(whole.triangles.size() == faces - 4);
  CHECK_NOTHROW(HalfEdgeMesh(whole.vertices, whole.triangles, kEverywhere));
}

TEST_CASE("a wall whose vertices all lie in a few planes is cut across, not along them", "[quick][meshing]") {
  MemoryShelf shelf;
  fill_shelf(shelf, {{0, 0, 0}, {120, 60, 60}}, [](VoxelCoord p) {
    const bool hole = p.y % 3 == 1 && p.z % 3 == 1;
    return p.x < 2 ? !hole : p.y / 2 == 15 && p.z == 30;  // with a rod across, longer than the wall
  });
  repair_contacts(shelf);
  const Piece whole = piece_of(dense_surface(shelf, {}));
  std::vector<char> free(whole.vertices.size(), 0);
  for (int turn = 0; turn < 3; ++turn) {
    for (const Region& region : regions_of(whole, kPerRegion, turn)) {
      CHECK(region.faces.size() - region.fixed <= kPerRegion);
      for (std::size_t i = 0; i < region.vertices.size(); ++i) free[region.vertices[i]] |= region.free[i];
    }
  }
  CHECK(std::count(free.begin(), free.end(), 1) > std::int64_t(whole.vertices.size() * 9 / 10));
}

TEST_CASE("parts without faces share nothing", "[quick][meshing]") {
  struct None : CostOrder {
    [[nodiscard]] std::uint64_t face_count() const override { return 0; }
    void add_costs(std::vector<double>&) const override {}
    bool run(double, std::uint64_t) override { return true; }
  } none;
  struct Jammed : None {
    [[nodiscard]] std::uint64_t face_count() const override { return 10; }
    bool run(double, std::uint64_t) override { return false; }
  } jammed;
  const std::vector<CostOrder*> parts{&none, &jammed, &none};
  take_cheapest(parts, 4);
  CHECK(jammed.face_count() == 10);
}

TEST_CASE("a large proxy that is made by regions holds, and is the same for any number of threads", "[meshing]") {
  const Towers towers;
  const EnclosedVoxels enclosed(towers.shelf);
  SimplifyParams params;
  params.faces = GENERATE(5000, 8000);
  params.faces_per_region = kPerRegion;  // so every step goes by regions, of the larger one the last ones, too
  const auto make = [&](int threads) {
    const ThreadLimit limit(threads);
    return tight_proxy(towers.surface(), enclosed, params);
  };
  const auto [proxy, simplified, tightened] = make(1);
  if (params.faces == 8000) {
    CHECK(simplified.stop == StopReason::faces);
    CHECK(proxy.triangles.size() == params.faces);
  } else {  // the last steps are on one mesh: some faces are needless
    CHECK(simplified.stop == StopReason::least_volume);
    CHECK(proxy.triangles.size() <= params.faces);
    CHECK(double(proxy.triangles.size()) > 0.96 * double(params.faces));
  }
  CHECK(tightened.volume_after < tightened.volume_before);
  CHECK(tightened.volume_after == Approx(std::abs(double(volume6_of(proxy))) / 6));
  check_large_proxy(proxy, towers.solid);
  const LatticeMesh same = make(3).mesh;
  CHECK(same.vertices == proxy.vertices);
  CHECK(same.triangles == proxy.triangles);
  params.faces_per_region = proxy.triangles.size() * 100;
  const TightenCounts of_whole = make(3).tightened;
  CHECK(tightened.volume_after < (params.faces == 5000 ? 1.02 : 1.06) * of_whole.volume_after);
}

TEST_CASE("a large proxy made by regions that need nothing but grow, or fit, is embedded", "[meshing]") {
  const Towers towers;
  SimplifyParams params;
  params.faces = 8000;
  params.faces_per_region = kPerRegion;
  params.free = GENERATE(false, true);
  SimplifyCounts counts;
  const LatticeMesh proxy = simplify(towers.surface(), params, counts);
  CHECK(proxy.triangles.size() == params.faces);
  check_large_proxy(proxy, params.free ? Solid([](VoxelCoord) { return false; }) : towers.solid);
}

TEST_CASE("a bulk that is taken by regions leaves a proxy that holds, the same for any number of threads",
          "[meshing]") {
  const Towers towers;
  const LatticeMesh dense = towers.surface();
  SimplifyParams params;
  params.faces = 20000;
  params.strict_from = 30000;
  params.faces_per_region = 150;
  REQUIRE(has_bulk_regions(dense.triangles.size(), {params.strict_from, 1e300}, params));
  CHECK_FALSE(has_bulk_regions(dense.triangles.size(), {params.faces_per_region, 1e300}, params));  // too few are left
  CHECK_FALSE(has_bulk_regions(params.strict_from, {params.strict_from, 1e300}, params));  // nothing is left to take
  const auto make = [&](int threads) {
    const ThreadLimit limit(threads);
    SimplifyCounts counts;
    return simplify(dense, params, counts);
  };
  const LatticeMesh proxy = make(1), same = make(3);
  CHECK(proxy.triangles.size() == params.faces);
  check_large_proxy(proxy, towers.solid);
  CHECK(same.vertices == proxy.vertices);
  CHECK(same.triangles == proxy.triangles);
  Piece whole = whole_piece(MeshSurface(dense));
  const std::uint64_t enough = whole.triangles.size() / 2;
  SimplifyCounts counts;
  collapse_bulk_in_regions(whole, {enough, 1e300}, params, counts);
  CHECK(whole.triangles.size() <= enough);
  CHECK(whole.triangles.size() > enough - enough / 10);
}
