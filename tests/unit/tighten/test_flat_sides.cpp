#include <cmath>

#include "lib/enclosed/enclosed_triangles.h"
#include "lib/tighten/tight_proxy.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

namespace {

using Quad = std::array<Vec3d, 4>;

std::vector<TriangleD> triangles_of(const std::vector<Quad>& quads) {
  std::vector<TriangleD> out;
  for (const auto& [a, b, c, d] : quads) {
    out.push_back({a, b, c});
    out.push_back({a, c, d});
  }
  return out;
}

/// Returns the volume, in voxels, of a proxy around triangles of the scene.
double volume_around(const Solid& solid, const VoxelBox& box, const std::vector<TriangleD>& scene, std::uint64_t faces,
                     StopReason& stop) {
  GridFrame frame;
  frame.voxel = 1;
  MemoryShelf shelf;
  fill_shelf(shelf, box, solid);
  const EnclosedTriangles enclosed(scene, frame);
  SimplifyParams params;
  params.faces = faces;
  const TightProxy proxy = tight_proxy(ShelfSurface(shelf, frame), enclosed, params);
  REQUIRE_NOTHROW(HalfEdgeMesh(proxy.mesh));
  stop = proxy.simplified.stop;
  return double(volume6_of(proxy.mesh)) / 6 / std::pow(double(kLatticePerVoxel), 3);
}

// A slab, thin for its length, half a voxel from the sides of its voxels.
constexpr double kLong = 200.5, kThick = 2.5;
std::vector<TriangleD> slab() {
  const auto at = [](int i) { return Vec3d{i & 1 ? kLong : 0.5, i & 2 ? kLong : 0.5, i & 4 ? kThick : 0.5}; };
  const auto side = [&](int a, int b, int c, int d) { return Quad{at(a), at(b), at(c), at(d)}; };
  return triangles_of(
      {side(0, 2, 3, 1), side(4, 5, 7, 6), side(0, 1, 5, 4), side(2, 6, 7, 3), side(0, 4, 6, 2), side(1, 3, 7, 5)});
}
bool in_slab(VoxelCoord v) {
  return v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x <= 200 && v.y <= 200 && v.z <= 2;
}

// Gabled houses in a row, whose roofs are steps of voxels.
constexpr int kHouses = 8, kPitch = 40;
constexpr double kWide = 30, kDeep = 50, kEaves = 10, kRidge = 19;
std::vector<TriangleD> houses() {
  std::vector<TriangleD> out;
  for (int i = 0; i < kHouses; ++i) {
    const double x = i * kPitch + 0.5, middle = x + kWide / 2, right = x + kWide;
    const std::array<Vec3d, 5> front{
        Vec3d{x, 0.5, 0.5}, {right, 0.5, 0.5}, {right, 0.5, kEaves}, {middle, 0.5, kRidge}, {x, 0.5, kEaves}};
    auto back = front;
    for (Vec3d& p : back) p[1] += kDeep;
    for (std::size_t k = 0; k < 5; ++k) {
      const std::size_t next = (k + 1) % 5;
      for (const TriangleD& t : triangles_of({{front[k], back[k], back[next], front[next]}})) out.push_back(t);
    }
    for (std::size_t k = 1; k < 4; ++k) {
      out.push_back({front[0], front[k], front[k + 1]});
      out.push_back({back[0], back[k + 1], back[k]});
    }
  }
  return out;
}
bool in_houses(VoxelCoord v) {
  if (v.x < 0 || v.x >= kHouses * kPitch || v.y < 0 || v.y > 50 || v.z < 0) return false;
  const double x = v.x % kPitch;
  if (x > kWide) return false;
  const double inwards =
      std::clamp(std::min(x + 0.5, kWide + 0.5 - x), 0.0, kWide / 2);  // of the cell's nearest corner
  return v.z <= kEaves + (kRidge - kEaves) * inwards / (kWide / 2);
}

}  // namespace

TEST_CASE("the sides of a thin plate come as near as those of a block", "[quick][meshing]") {
  StopReason stop{};
  const double least = (kLong - 0.5) * (kLong - 0.5) * (kThick - 0.5);
  const double volume = volume_around(in_slab, {{-2, -2, -2}, {204, 204, 6}}, slab(), 100, stop);
  CHECK(volume > least);
  CHECK(volume < 1.05 * least);
}

TEST_CASE("faces enough for all steps of a roof leave no more volume than a good number of few", "[quick][meshing]") {
  StopReason stop{};
  const VoxelBox box{{-2, -2, -2}, {kHouses * kPitch + 2, 54, 24}};
  const double few = volume_around(in_houses, box, houses(), 160, stop);
  for (const std::uint64_t faces : {600, 3000}) {
    CAPTURE(faces);
    CHECK(volume_around(in_houses, box, houses(), faces, stop) < 1.001 * few);
    CHECK(stop == StopReason::least_volume);
  }
}
