#include "lib/pass/mesh/detail/components.h"
#include "lib/pass/mesh/detail/proxy_limits.h"
#include "lib/pass/mesh/surface_around.h"
#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Corners in voxels.
LatticeMesh lattice(const IndexedMesh& mesh) {
  LatticeMesh out;
  for (const Vec3d& p : mesh.vertices)
    out.vertices.push_back({std::int64_t(p[0] * kLatticePerVoxel), std::int64_t(p[1] * kLatticePerVoxel),
                            std::int64_t(p[2] * kLatticePerVoxel)});
  out.triangles = mesh.triangles;
  return out;
}

double volume_vox(const LatticeMesh& mesh) {
  return double(volume6_of(mesh)) / (6.0 * kLatticePerVoxel * kLatticePerVoxel * kLatticePerVoxel);
}

/// A cube of edge 20 with a cavity of edge 8 in which a cube of edge 4 floats; apart, a cube of edge 6 with a cavity of
/// edge 2, and one of edge 1.
IndexedMesh parts() {
  IndexedMesh all = cube(3, {40, 0, 0});
  all = join(all, inverted(cube(4)));
  all = join(all, cube(10));
  all = join(all, inverted(cube(1, {40, 0, 0})));
  all = join(all, cube(2));
  return join(all, cube(0.5, {0, 0, 30}));
}
constexpr double kHollow = 8000 - 512, kWithin = 64, kApart = 216 - 8, kCrumb = 1;

}  // namespace

TEST_CASE("small parts are dropped with the cavities in them, whichever way the mesh is turned", "[quick][pass]") {
  struct Case {
    double share;
    std::uint64_t parts;
    double left;
  };
  const Case c = GENERATE(Case{0, 0, kHollow + kWithin + kApart + kCrumb},  //
                          Case{0.001, 1, kHollow + kWithin + kApart},       // 1 of 8000
                          Case{0.008, 1, kHollow + kWithin + kApart},       // 64 of 8000 is not less than that
                          Case{0.0081, 2, kHollow + kApart},                //
                          Case{0.028, 3, kHollow}, Case{1, 3, kHollow});    // 216 of 8000, hollow or not
  const bool turned = GENERATE(false, true);
  LatticeMesh mesh = lattice(parts());
  if (turned) turn_over(mesh);
  const std::size_t triangles = mesh.triangles.size();
  const DroppedComponents dropped = drop_small_components(mesh, c.share);
  CAPTURE(c.share, turned);
  CHECK(dropped.parts == c.parts);
  CHECK(volume_vox(mesh) == (turned ? -c.left : c.left));
  CHECK(dropped.volume_vox == kHollow + kWithin + kApart + kCrumb - c.left);
  CHECK(mesh.triangles.size() == triangles - 12 * (c.parts + (c.parts == 3 ? 1 : 0)));
  CHECK(mesh.vertices.size() * 3 == mesh.triangles.size() * 2);  // 8 and 12 a cube: no vertex is left without a face
}
