#include <algorithm>
#include <cmath>
#include <random>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/pass/color/scene_colors.h"
#include "lib/pass/color/vertex_colors.h"
#include "lib/volume/reduce.h"
#include "lib/voxel/color_samples.h"
#include "tests/catch.h"
#include "tests/support/colored_scene.h"
#include "tests/support/lattice_boxes.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Two boxes side by side, red and blue.
ColoredScene two_boxes() {
  ColoredScene s;
  add_box(s.triangles, {0, 0, 0}, {10, 10, 10});
  s.paint(kRed);
  add_box(s.triangles, {10, 0, 0}, {20, 10, 10});
  s.paint(kBlue);
  return s;
}

ResultKey key_of(const NearbyColors& colors) {
  KeyHash hash("test");
  colors.add_to(hash);
  return hash.key();
}

LinearColor at_world(const NearbyColors& colors, const GridFrame& frame, const Vec3d& p) {
  Vec3d v = frame.to_voxels(p);
  for (double& x : v) x *= kLatticePerVoxel;
  return colors.at(v, {});
}

}  // namespace

TEST_CASE("samples of a triangle are shares of its area, near enough to each other", "[quick][pass][colors]") {
  const TriangleD t =
      GENERATE(TriangleD{{{0, 0, 0}, {9, 0, 0}, {3, 7, 2}}}, TriangleD{{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}},
               TriangleD{{{0, 0, 0}, {50, 0, 0}, {25, 0.001, 0}}});
  double sum = 0;
  std::size_t count = 0;
  Vec3d centre{};
  for_each_sample(t, 0.5, 2, [&](const std::array<double, 3>& w, double share) {
    CHECK(w[0] + w[1] + w[2] == Approx(1));
    CHECK(std::min({w[0], w[1], w[2]}) > 0);
    sum += share;
    ++count;
    for (std::size_t k = 0; k < 3; ++k) centre[k] += share * w[k];
  });
  CHECK(sum == Approx(1));
  CHECK(count >= 4);
  CHECK(count < 600);  // a needle costs its length
  for (const double w : centre) CHECK(w == Approx(1.0 / 3));
}

TEST_CASE("cells have the colours of the surface in them", "[quick][pass][colors]") {
  const ColoredScene scene = two_boxes();
  const Voxelized voxels = voxelized(scene.triangles, 0.125);
  const GridFrame& frame = voxels.header.frame;
  const auto colors = gathered(scene, voxels, 1 << 20);
  REQUIRE(colors != nullptr);
  const NearbyColors near = colors->all(frame);
  CHECK(at_world(near, frame, {4, 10, 5}) == kRed);
  CHECK(at_world(near, frame, {16, 0, 5}) == kBlue);
  CHECK(at_world(near, frame, {4, 11, 5}) == kRed);  // not in a cell of the surface
  CHECK(at_world(near, frame, {18, 13, 5}) == kBlue);
  CHECK(at_world(near, frame, {-4, 5, 5}) == kRed);
  CHECK(at_world(near, frame, {10, 900, 5}).r > 20000);  // far away: a mean of all
  CHECK(at_world(near, frame, {1, 1, 0}) == kRed);
  GridFrame coarse = frame;
  for (int n = 0; n < 3; ++n) coarse = reduced(coarse);
  colors->prepare(coarse);
  CHECK(at_world(colors->all(coarse), coarse, {2, 10, 5}) == kRed);
  CHECK(at_world(colors->all(coarse), coarse, {18, 10, 5}) == kBlue);
  // A part of it.
  const VoxelBox box{{0, 0, 0}, {40, 40, 40}};
  CHECK(at_world(colors->around(frame, box, 4), frame, {1, 1, 0}) == kRed);
  CHECK(at_world(colors->around(frame, box, 4), frame, {19, 1, 0}) == kRed);  // blue is out of reach
}

TEST_CASE("faces between two layers of voxels keep their colours on both sides of a box", "[quick][pass][colors]") {
  ColoredScene scene = two_boxes();
  add_box(scene.triangles, {4, 4, 4}, {6, 6, 6});  // out of sight
  scene.paint(kWhite);
  const Voxelized voxels = voxelized(scene.triangles, 0.125);  // the boxes begin and end at multiples of a cell
  const auto colors = gathered(scene, voxels, 1 << 20);
  for (const Vec3d& p : {Vec3d{5, 5, 0}, Vec3d{5, 5, 10}, Vec3d{5, 0, 5}, Vec3d{5, 10, 5}, Vec3d{0, 5, 5}}) {
    const Vec3d v = voxels.header.frame.to_voxels(p);
    const VoxelCoord at{std::int32_t(v[0]), std::int32_t(v[1]), std::int32_t(v[2])};
    const NearbyColors here = colors->around(voxels.header.frame, VoxelBox{at, at + VoxelCoord{1, 1, 1}}, 0);
    CAPTURE(p[0], p[1], p[2]);
    CHECK_FALSE(here.empty());
    CHECK(at_world(here, voxels.header.frame, p) == kRed);
  }
}

TEST_CASE("what lies inside has no colour", "[quick][pass][colors]") {
  ColoredScene scene = two_boxes();
  add_box(scene.triangles, {3, 3, 3}, {7, 7, 7});
  scene.paint(LinearColor{0, 65535, 0});
  const Voxelized voxels = voxelized(scene.triangles, 0.125);
  const NearbyColors near = gathered(scene, voxels, 1 << 20)->all(voxels.header.frame);
  CHECK(at_world(near, voxels.header.frame, {5, 5, 7}).g == 0);
}

TEST_CASE("what lies a voxel or more below the surface does not tint it", "[quick][pass][colors]") {
  const double thickness = GENERATE(0.15, 0.2, 0.3);  // voxels of 0.125, cells of 0.5
  ColoredScene scene;                                 // a room that is red outside, and a blue house on a red plate
  add_box(scene.triangles, {0, 0, 0}, {10, 10, 10});
  add_box(scene.triangles, {20, 0, 0}, {30, thickness, 10});
  scene.paint(kRed);
  add_box(scene.triangles, {thickness, thickness, thickness}, {10 - thickness, 10 - thickness, 10 - thickness});
  add_box(scene.triangles, {22, thickness, 2}, {28, 8, 8});
  scene.paint(kBlue);
  const Voxelized voxels = voxelized(scene.triangles, 0.125);
  const GridFrame& frame = voxels.header.frame;
  const NearbyColors near = gathered(scene, voxels, 1 << 20)->all(frame);
  const auto seen = [&](const Vec3d& p, const Vec3d& normal) { return near.at(frame.to_lattice(p), normal); };
  CAPTURE(thickness);
  CHECK(seen({0, 5, 5}, {-1, 0, 0}) == kRed);
  CHECK(seen({10, 5, 5}, {1, 0, 0}) == kRed);
  CHECK(seen({5, 0, 5}, {0, -1, 0}) == kRed);
  CHECK(seen({5, 5, 10}, {0, 0, 1}) == kRed);
  CHECK(seen({25, 0, 5}, {0, -1, 0}) == kRed);
  CHECK(seen({25, 8, 5}, {0, 1, 0}) == kBlue);
}

TEST_CASE("a white scene has no colours", "[quick][pass][colors]") {
  ColoredScene scene;
  add_box(scene.triangles, {0, 0, 0}, {10, 10, 10});
  scene.paint(kWhite);
  CHECK(gathered(scene, voxelized(scene.triangles, 0.25), 1 << 20) == nullptr);
}

TEST_CASE("neither the order of the triangles nor threads nor memory change a colour", "[quick][pass][colors]") {
  std::mt19937 random(5);
  ColoredScene scene;
  std::uniform_int_distribution<std::uint32_t> any(0, 65535);
  add_sphere(scene.triangles, {0, 0, 0}, 10, 60);
  add_box(scene.triangles, {-20, -9, -20}, {20, -8, 20});
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    TriangleColors c;
    for (LinearColor& corner : c)
      corner = {std::uint16_t(any(random)), std::uint16_t(any(random)), std::uint16_t(any(random))};
    scene.colors.push_back(c);
  }
  const Voxelized voxels = voxelized(scene.triangles, 0.125);
  const GridFrame frame = voxels.header.frame, coarse = reduced(frame);
  const auto reference = gathered(scene, voxels, std::uint64_t(1) << 30);
  reference->prepare(coarse);
  std::vector<std::size_t> order(scene.triangles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  ColoredScene shuffled;
  for (const std::size_t i : order) {
    shuffled.triangles.push_back(scene.triangles[i]);
    shuffled.colors.push_back(scene.colors[i]);
  }
  const ThreadLimit threads(GENERATE(1, 3));
  std::uint64_t put = 0;
  const auto other = gathered(shuffled, voxels, 20000, &put);
  other->prepare(coarse);
  CHECK(put > 4 * 20000);  // some waited in the store
  CHECK(key_of(other->all(frame)) == key_of(reference->all(frame)));
  CHECK(key_of(other->all(coarse)) == key_of(reference->all(coarse)));
  CHECK(key_of(other->all(frame)) != key_of(other->all(coarse)));
}

TEST_CASE("a key knows the colours nearby and no others", "[quick][pass][colors]") {
  ColoredScene scene = two_boxes();
  const Voxelized voxels = voxelized(scene.triangles, 0.125);
  const GridFrame& frame = voxels.header.frame;
  const VoxelBox left{{0, 0, 0}, {64, 90, 90}};
  const auto before = gathered(scene, voxels, 1 << 20);
  scene.colors.back() = {kWhite, kRed, kBlue};  // far right
  const auto after = gathered(scene, voxels, 1 << 20);
  CHECK(key_of(before->around(frame, left, 4)) == key_of(after->around(frame, left, 4)));
  CHECK(key_of(before->all(frame)) != key_of(after->all(frame)));
}

TEST_CASE("vertices get the colours of their side, and none that is nowhere", "[quick][pass][colors]") {
  const ColoredScene scene = two_boxes();
  const Voxelized voxels = voxelized(scene.triangles, 0.125);
  const GridFrame& frame = voxels.header.frame;
  const auto colors = gathered(scene, voxels, 1 << 20);
  // A grid of squares over the top, one voxel above it.
  LatticeMesh mesh;
  mesh.frame = frame;
  constexpr std::uint32_t n = 17;
  const Vec3d corner = frame.to_voxels({0, 10, 0});
  const std::int64_t step = 160 / 16 * kLatticePerVoxel;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t k = 0; k < n; ++k) {
      mesh.vertices.push_back({std::int64_t(corner[0] * 64) + i * step, std::int64_t((corner[1] + 1) * 64),
                               std::int64_t(corner[2] * 64) + k * step / 2});
      if (i > 0 && k > 0) {
        const std::uint32_t v = i * n + k;
        mesh.triangles.push_back({v, v - 1, v - n});
        mesh.triangles.push_back({v - n, v - 1, v - n - 1});
      }
    }
  }
  color_vertices(mesh, colors->all(frame));
  REQUIRE(mesh.colors.size() == mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = mesh.triangles[f][k] / n;
      const LinearColor c = mesh.colors[f][k];
      CAPTURE(f, i, c.r, c.g, c.b);
      if (i < 7) CHECK(c == kRed);
      if (i == 7) CHECK(c.r > 60000);  // one square from the border
      if (i == 9) CHECK(c.b > 60000);
      if (i > 9) CHECK(c == kBlue);
      CHECK(c.g == 0);
    }
  }
}

TEST_CASE("a surface has one direction, whichever way its triangles are wound", "[quick][pass][colors]") {
  for (std::uint16_t side = 0; side < kColorSides.size(); ++side) {
    const auto& [x, y, z] = kColorSides[side];
    const Vec3d along{0.01 * x, 0.01 * y, 0.01 * z};
    CHECK(color_side_of(along) == side);
    CHECK(color_side_of(-5.0 * along) == side);
  }
  CHECK(color_side_of({}) == 0);
  CHECK(color_side_of({NAN, 0, 0}) == 0);
}

TEST_CASE("all of a cell counts where nothing of it looks along the normal, also but for rounding",
          "[quick][pass][colors]") {
  const auto side = [](const Vec3d& along) { return color_side_of(along); };
  const std::vector<CellColor> cells{{{0, 0, 0}, kRed, side({1, 0, 0}), 1000},
                                     {{0, 0, 0}, kBlue, side({0, 0, 1}), 3000}};
  const NearbyColors colors(cells, {0, 0, 0}, {0, 0, 0});
  const Vec3d middle{2.0 * kLatticePerVoxel, 2.0 * kLatticePerVoxel, 2.0 * kLatticePerVoxel};
  for (const Vec3d& normal : {Vec3d{0, 1, 0}, Vec3d{1e-3, 1, 0}, Vec3d{0.05, 1, 1e-17}, Vec3d{0, 1, -0.1}}) {
    const LinearColor c = colors.at(middle, normal);
    CAPTURE(normal[0], normal[2], c.r, c.b);
    CHECK(std::abs(int(c.r) - 65535 / 4) < 10);
    CHECK(std::abs(int(c.b) - 65535 * 3 / 4) < 10);
  }
  CHECK(colors.at(middle, {1, 0, 0}) == kRed);  // a quarter of it looks there
  // There is no step where a side begins to be enough.
  LinearColor before = colors.at(middle, {0, 1, 0});
  for (int degrees = 1; degrees <= 90; ++degrees) {
    const double angle = degrees * 3.14159265358979 / 180;
    const LinearColor now = colors.at(middle, {std::sin(angle), std::cos(angle), 0});
    CAPTURE(degrees, before.r, now.r);
    CHECK(now.r >= before.r);
    CHECK(now.r - before.r < 65535 / 12);
    before = now;
  }
}

TEST_CASE("no vertex of a box of two colours has a mixed one, however it is turned", "[quick][pass][colors]") {
  const double angle = GENERATE(0.0, 0.3, 0.54, 0.9);
  LatticeMesh box;
  add_box(box, {{0, 0, 0}, {20, 10, 14}});
  const auto turned = [&](LatticeCoord v) {
    const auto x = double(v.x), z = double(v.z);
    return Vec3d{x * std::cos(angle) - z * std::sin(angle), double(v.y), x * std::sin(angle) + z * std::cos(angle)};
  };
  ColoredScene scene;
  const auto is_top = [&](const std::array<std::uint32_t, 3>& t) {
    return box.vertices[t[0]].y == 10 && box.vertices[t[1]].y == 10 && box.vertices[t[2]].y == 10;
  };
  for (const auto& t : box.triangles) {
    scene.triangles.push_back({turned(box.vertices[t[0]]), turned(box.vertices[t[1]]), turned(box.vertices[t[2]])});
    scene.paint(is_top(t) ? kRed : kBlue);
  }
  const Voxelized voxels = voxelized(scene.triangles, 0.11);  // its edges lie anywhere in cells
  const auto colors = gathered(scene, voxels, 1 << 20);
  LatticeMesh mesh = box;
  mesh.frame = voxels.header.frame;
  for (LatticeCoord& v : mesh.vertices) {
    const Vec3d p = mesh.frame.to_voxels(turned(v));
    for (int i = 0; i < 3; ++i) v[i] = std::lround(p[std::size_t(i)] * kLatticePerVoxel);
  }
  color_vertices(mesh, colors->all(mesh.frame));
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    CAPTURE(angle, f);
    for (const LinearColor& c : mesh.colors[f])
      CHECK(linear_bytes(c) == linear_bytes(is_top(box.triangles[f]) ? kRed : kBlue));
  }
}

TEST_CASE("colours do not bleed over edges of the scene, and go on where it is smooth", "[quick][pass][colors]") {
  ColoredScene scene;  // a box with a red top; the sides are blue below and fade to green above
  const auto add = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d, const TriangleColors& abc,
                       const LinearColor& of_d) {
    scene.triangles.push_back({a, b, c});
    scene.colors.push_back(abc);
    scene.triangles.push_back({a, c, d});
    scene.colors.push_back({abc[0], abc[2], of_d});
  };
  const std::array<Vec3d, 4> foot{Vec3d{0, 0, 0}, {20, 0, 0}, {20, 0, 20}, {0, 0, 20}};
  const auto up = [](Vec3d p) { return Vec3d{p[0], 20, p[2]}; };
  constexpr LinearColor kGreen{0, 65535, 0};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3d &p = foot[k], &q = foot[(k + 1) % 4];
    add(q, p, up(p), up(q), {kBlue, kBlue, kGreen}, kGreen);
  }
  add(up(foot[3]), up(foot[2]), up(foot[1]), up(foot[0]), {kRed, kRed, kRed}, kRed);
  add(foot[0], foot[1], foot[2], foot[3], {kBlue, kBlue, kBlue}, kBlue);
  const Voxelized voxels = voxelized(scene.triangles, 0.125);
  const GridFrame& frame = voxels.header.frame;
  const auto colors = gathered(scene, voxels, 1 << 20);
  LatticeMesh mesh;
  mesh.frame = frame;
  const auto lattice = [&](double x) { return std::int64_t(std::lround(x * 64)); };
  const Vec3d lo = frame.to_voxels({0, 0, 0}), hi = frame.to_voxels({20, 20, 20});
  add_box(mesh, {{lattice(lo[0]), lattice(lo[1]), lattice(lo[2])}, {lattice(hi[0]), lattice(hi[1]), lattice(hi[2])}});
  color_vertices(mesh, colors->all(frame));
  REQUIRE(mesh.colors.size() == mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& t = mesh.triangles[f];
    const auto is_up = [&](std::uint32_t v) { return mesh.vertices[v].y > lattice(lo[1]); };
    const bool is_top = is_up(t[0]) && is_up(t[1]) && is_up(t[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const LinearColor c = mesh.colors[f][k];
      CAPTURE(f, k, c.r, c.g, c.b);
      if (is_top) CHECK(c == kRed);
      if (!is_top) CHECK(c.r == 0);
      if (!is_top && is_up(t[k])) CHECK(c.g > 50000);
    }
  }
}
