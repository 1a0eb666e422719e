#include <cmath>

#include "lib/core/vec3.h"
#include "lib/geometry/triangle_totals.h"
#include "lib/live/smooth_surface.h"
#include "tests/catch.h"

using namespace bp;

TEST_CASE("the smooth surface of a ball is closed, has its volume, and normals without stairs", "[quick][live]") {
  BitBox cells(VoxelBox{{-64, -64, -64}, {64, 64, 64}});
  constexpr double kRadius = 40;
  for_each(cells.box(), [&](VoxelCoord p) {
    if (std::hypot(p.x + 0.5, p.y + 0.5, p.z + 0.5) < kRadius) cells.set(p);
  });
  GridFrame frame;
  frame.voxel = 0.5;
  frame.origin = {100, -50, 7};
  const SmoothSurface surface = smooth_surface(cells, 4, frame);
  TriangleTotals totals;
  totals.add(surface.triangles);
  const double cell = 4 * frame.voxel;
  REQUIRE(totals.volume);
  CHECK(*totals.volume / (4 * M_PI / 3 * std::pow(kRadius * cell, 3)) == Approx(1).margin(0.02));
  CHECK(totals.area / (4 * M_PI * std::pow(kRadius * cell, 2)) == Approx(1).margin(0.03));  // 1.5 with stairs
  const Vec3d middle = frame.world_origin();
  REQUIRE(surface.normals.size() == surface.triangles.size());
  double worst = 1;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d d = surface.triangles[i][k] - middle;
      worst = std::min(worst, dot(d, unpack_normal(surface.normals[i][k])) / length(d));
    }
  }
  CHECK(worst > 0.97);
}

TEST_CASE("creases of a block stay, and a thin sheet beside it keeps its own normals", "[quick][live]") {
  BitBox cells(VoxelBox{{0, 0, 0}, {64, 64, 64}});
  for_each(VoxelBox{{4, 4, 10}, {60, 60, 11}}, [&](VoxelCoord p) { cells.set(p); });    // the sheet
  for_each(VoxelBox{{20, 20, 11}, {40, 40, 31}}, [&](VoxelCoord p) { cells.set(p); });  // the block
  const SmoothSurface surface = smooth_surface(cells, 1, {});
  double sheet = 1, top = 1, side = 1;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d& p = surface.triangles[i][k];
      const Vec3d n = unpack_normal(surface.normals[i][k]);
      const double away = std::max(std::abs(p[0] - 30), std::abs(p[1] - 30));
      if (away > 14 && away < 24 && p[2] > 10.5 && p[2] < 11.5) sheet = std::min(sheet, n[2]);
      if (away < 8 && p[2] > 29) top = std::min(top, n[2]);
      if (std::abs(p[1] - 30) < 8 && p[0] > 38 && p[2] > 14 && p[2] < 28 && p[0] < 41) side = std::min(side, n[0]);
    }
  }
  CHECK(sheet > 0.98);
  CHECK(top > 0.99);
  CHECK(side > 0.98);
}

TEST_CASE("a wire and a sheet of one cell do not vanish", "[quick][live]") {
  BitBox cells(VoxelBox{{0, 0, 0}, {64, 64, 64}});
  const bool sheet = GENERATE(false, true);
  for_each(VoxelBox{{10, 30, 30}, {50, sheet ? 50 : 31, 31}}, [&](VoxelCoord p) { cells.set(p); });
  double low = 64, high = 0;
  for (const TriangleD& t : smooth_surface(cells, 1, {}).triangles) {
    for (const Vec3d& p : t) {
      if (p[0] < 20 || p[0] > 40 || (sheet && (p[1] < 38 || p[1] > 42))) continue;
      low = std::min(low, p[2]);
      high = std::max(high, p[2]);
    }
  }
  CHECK(high - low > 0.6);
  CHECK(high - low <= 1);
}

TEST_CASE("no cells have no surface", "[quick][live]") {
  CHECK(smooth_surface({}, 1, {}).triangles.empty());
  CHECK(smooth_surface(BitBox(VoxelBox{{0, 0, 0}, {64, 64, 64}}), 1, {}).triangles.empty());
}
