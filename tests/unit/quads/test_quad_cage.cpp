#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "lib/check/check_proxy.h"
#include "lib/enclosed/enclosed_voxels.h"
#include "lib/quads/quad_cage.h"
#include "lib/quads/quads.h"
#include "tests/catch.h"
#include "tests/support/proxy_checks.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

const VoxelBox kBodyBox{{0, 0, 0}, {48, 40, 60}};
const MirrorPlane kPlane{0, 24};

/// A body on two slanted legs, and a ball for a head.
bool body(VoxelCoord p) {
  const double x = std::abs(p.x + 0.5 - 24), y = p.y - 20.0, z = p.z;
  if (z < 30) return std::hypot(x - 16 + z / 4, y) < 4;
  return std::hypot(x, y) < 13 - std::abs(z - 38) / 2 || x * x + y * y + (z - 51) * (z - 51) < 40;
}

/// Draws the other diagonals.
LatticeMesh turned(LatticeMesh mesh) {
  for (const auto& pair : mesh.quads) {
    const auto other = across(quad_of(mesh.triangles[pair[0]], mesh.triangles[pair[1]]));
    for (std::size_t i = 0; i < 2; ++i) mesh.triangles[pair[i]] = other[i];
  }
  return mesh;
}

using Corners = std::array<std::array<std::int64_t, 3>, 4>;

/// From the least corner on.
Corners corners_of(const LatticeMesh& mesh, const Quad& q, bool mirrored) {
  Corners all;
  for (std::size_t i = 0; i < 4; ++i) {
    LatticeCoord p = mesh.vertices[q[mirrored ? 3 - i : i]];
    if (mirrored) p = kPlane.mirrored(p);
    all[i] = {p.x, p.y, p.z};
  }
  std::rotate(all.begin(), std::min_element(all.begin(), all.end()), all.end());
  return all;
}

/// The top and the legs of a table, whose sides lie along the axes.
constexpr std::array<VoxelBox, 5> kTable{VoxelBox{{0, 0, 44}, {96, 48, 48}}, VoxelBox{{4, 4, 0}, {8, 8, 44}},
                                         VoxelBox{{88, 4, 0}, {92, 8, 44}}, VoxelBox{{4, 40, 0}, {8, 44, 44}},
                                         VoxelBox{{88, 40, 0}, {92, 44, 44}}};

/// Returns the distance of the farthest vertex from the table, in voxels.
double farthest_from_table(const LatticeMesh& cage) {
  double farthest = 0;
  for (const LatticeCoord& p : cage.vertices) {
    double nearest = HUGE_VAL;
    for (const VoxelBox& box : kTable) {
      Vec3d off;
      for (int i = 0; i < 3; ++i) {
        const double x = double(p[i]) / kLatticePerVoxel;
        off[std::size_t(i)] = std::max({box.min[i] - x, 0.0, x - box.max[i]});
      }
      nearest = std::min(nearest, length(off));
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

}  // namespace

TEST_CASE("no vertex of a cage stays behind: all lie within two voxels of a table, for few faces and many",
          "[quick][quads]") {
  const std::optional<MirrorPlane> plane =
      GENERATE(std::optional<MirrorPlane>(), std::optional<MirrorPlane>(MirrorPlane{0, 48}));
  const auto is_table = [](VoxelCoord p) {
    return std::any_of(kTable.begin(), kTable.end(), [&](const VoxelBox& box) { return box.contains(p); });
  };
  MemoryShelf shelf;
  fill_shelf(shelf, {{0, 0, 0}, {96, 48, 48}}, is_table);
  const EnclosedVoxels enclosed(shelf);
  for (const std::uint64_t faces : {300, 1000, 2000, 3000}) {
    CAPTURE(faces, plane.has_value());
    CHECK(farthest_from_table(shrunk_cage(cell_quads(shelf, {}, faces, plane), enclosed, plane)) <= 2);
  }
}

TEST_CASE("a shrunk cage encloses over any diagonal, and is tighter than its boxes", "[quick][quads]") {
  const std::uint64_t faces = GENERATE(120, 400);
  const std::optional<MirrorPlane> plane = GENERATE(std::optional<MirrorPlane>(), std::optional<MirrorPlane>(kPlane));
  MemoryShelf shelf;
  fill_shelf(shelf, kBodyBox, body);
  const CellQuads boxes = cell_quads(shelf, {}, faces, plane);
  const LatticeMesh cage = shrunk_cage(boxes, EnclosedVoxels(shelf), plane);
  CHECK(cage.triangles.size() == boxes.mesh.triangles.size());
  CHECK(double(volume6_of(cage)) < 0.8 * double(volume6_of(boxes.mesh)));
  CHECK(10 * cage.quads.size() >= 9 * boxes.mesh.quads.size());
  for (const LatticeMesh& mesh : {cage, turned(cage)}) test::check_proxy(mesh, kBodyBox, body);
}

TEST_CASE("a symmetric cage is its own mirror image, to the last bit", "[quick][quads]") {
  MemoryShelf shelf;
  fill_shelf(shelf, kBodyBox, body);
  const LatticeMesh cage = shrunk_cage(cell_quads(shelf, {}, 300, kPlane), EnclosedVoxels(shelf), kPlane);
  std::set<Corners> quads, images;
  for (const Quad& q : polygon_faces(cage).quads) {
    quads.insert(corners_of(cage, q, false));
    images.insert(corners_of(cage, q, true));
  }
  CHECK(quads.size() > 100);
  CHECK(quads == images);
  const auto in_plane = [](const LatticeCoord& p) { return p.x == kPlane.lattice(); };
  CHECK(std::count_if(cage.vertices.begin(), cage.vertices.end(), in_plane) > 8);
}
