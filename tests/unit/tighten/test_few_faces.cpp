#include "lib/enclosed/enclosed_voxels.h"
#include "lib/hulls/convex_parts.h"
#include "lib/surface/repair.h"
#include "lib/tighten/few_faces.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

namespace {

/// A palm, fingers of different lengths that spread, and a thumb.
bool hand(VoxelCoord v) {
  if (v.y < 0 || v.y >= 5 || v.z < 0) return false;
  if (v.z < 18) return (v.x >= 0 && v.x < 20) || (v.z >= 4 && v.z < 8 && v.x >= 20 && v.x < 32);
  for (int i = 0; i < 4; ++i) {
    const int left = 5 * i + (v.z - 18) * (2 * i - 3) / 8, long_to = 32 + 4 * (i % 3);
    if (v.z < long_to && v.x >= left && v.x < left + 4 && v.y >= i % 2 && v.y < 4) return true;
  }
  return false;
}

/// Two blocks apart.
bool pair(VoxelCoord v) {
  return v.y >= 0 && v.y < 8 && v.z >= 0 && v.z < 8 && v.x >= 0 && v.x < 40 && (v.x < 8 || v.x >= 30);
}

/// Two plates of one voxel that slant, far apart, without a convex hull of their own.
bool plates(VoxelCoord v) {
  const std::int32_t x = v.x - (v.x < 20 ? 0 : 28), y = v.y, z = v.z - (v.x < 20 ? 0 : 30);
  return x >= 0 && y >= 0 && z >= 0 && x + y + z == 11;
}

struct Ground {
  MemoryShelf shelf;
  GridFrame frame;
  std::optional<EnclosedVoxels> enclosed;
  std::optional<ShelfSurface> dense;

  explicit Ground(const Solid& solid) {
    fill_shelf(shelf, {{-8, -2, -2}, {44, 12, 48}}, solid);
    repair_contacts(shelf);
    enclosed.emplace(shelf);
    dense.emplace(shelf, frame);
  }
  [[nodiscard]] LatticeMesh proxy(std::uint64_t faces) const {
    SimplifyParams params;
    params.faces = faces;
    return tight_proxy_of_few(*dense, *enclosed, params).mesh;
  }
};

bool holds(const LatticeMesh& mesh, const Solid& solid) {
  for (int z = -2; z < 48; ++z) {
    for (int y = -2; y < 12; ++y) {
      for (int x = -8; x < 44; ++x) {
        constexpr std::int64_t e = kLatticePerVoxel;
        if (solid({x, y, z}) && !inside(mesh, {e * x + 31, e * y + 30, e * z + 29})) return false;
      }
    }
  }
  return true;
}

}  // namespace

TEST_CASE("more faces never hold more volume, down to a tetrahedron", "[quick][meshing]") {
  const Ground ground(hand);
  double before = HUGE_VAL;
  for (const std::uint64_t faces : {4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20, 24, 30, 36, 44, 50, 60, 63}) {
    CAPTURE(faces);
    const LatticeMesh mesh = ground.proxy(faces);
    const auto volume = double(volume6_of(mesh));
    CHECK(mesh.triangles.size() <= faces);
    CHECK(volume <= before);
    CHECK(self_intersections(mesh) == 0);
    CHECK(holds(mesh, hand));
    before = volume;
  }
}

TEST_CASE("few faces keep parts apart, also where they do not suffice for them", "[quick][meshing]") {
  const Ground ground(pair);
  for (const std::uint64_t faces : {4, 30, 63}) {
    const LatticeMesh mesh = ground.proxy(faces);
    CHECK(components_of(mesh).size() == 2);
    CHECK(mesh.triangles.size() == 24);
  }
}

TEST_CASE("more faces never hold more volume where two parts are far apart", "[quick][meshing]") {
  const Ground ground(plates);
  double before = HUGE_VAL;
  for (std::uint64_t faces = 8; faces <= 32; faces += 2) {
    CAPTURE(faces);
    const LatticeMesh mesh = ground.proxy(faces);
    CHECK(mesh.triangles.size() <= faces);
    CHECK(double(volume6_of(mesh)) <= before);
    CHECK(self_intersections(mesh) == 0);
    CHECK(holds(mesh, plates));
    before = double(volume6_of(mesh));
  }
}
