#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "lib/core/vec3.h"
#include "lib/pass/color/vertex_colors.h"
#include "tests/catch.h"
#include "tests/support/colored_scene.h"
#include "tests/support/lattice_boxes.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr int kSide = 24;  // of a cube whose walls the tests paint; cells are half a unit wide

/// A level of one box around [0, kSide]^3, with the colours of the scene.
LatticeMesh wall_of(const ColoredScene& scene) {
  const Voxelized voxels = voxelized(scene.triangles, 0.125);
  LatticeMesh mesh;
  mesh.frame = voxels.header.frame;
  const auto corner = [&](double x) {
    const Vec3d p = 64.0 * mesh.frame.to_voxels({x, x, x});
    return LatticeCoord{std::lround(p[0]), std::lround(p[1]), std::lround(p[2])};
  };
  add_box(mesh, {corner(0), corner(kSide)});
  color_vertices(mesh, gathered(scene, voxels, 1 << 20)->all(mesh.frame));
  return mesh;
}

/// Returns the visible blocks of a cube of this size. blue({x, y, z}): the block with this number is blue, else red.
ColoredScene blocks(const std::array<int, 3>& size, const std::function<bool(const std::array<int, 3>&)>& blue) {
  ColoredScene scene;
  const auto outer = [&](int i, std::size_t axis) { return i == 0 || (i + 1) * size[axis] == kSide; };
  for (int z = 0; z * size[2] < kSide; ++z) {
    for (int y = 0; y * size[1] < kSide; ++y) {
      for (int x = 0; x * size[0] < kSide; ++x) {
        if (!outer(x, 0) && !outer(y, 1) && !outer(z, 2)) continue;
        const Vec3d low{double(x * size[0]), double(y * size[1]), double(z * size[2])};
        add_box(scene.triangles, low, low + Vec3d{double(size[0]), double(size[1]), double(size[2])});
        scene.paint(blue({x, y, z}) ? kBlue : kRed);
      }
    }
  }
  return scene;
}

bool is_across(const LatticeMesh& mesh, std::size_t f, int axis) {
  const auto& t = mesh.triangles[f];
  return mesh.vertices[t[0]][axis] == mesh.vertices[t[1]][axis] &&
         mesh.vertices[t[0]][axis] == mesh.vertices[t[2]][axis];
}

/// Least and largest share of blue in the corners of a face. Faces that lie across `axis` do not count.
std::pair<double, double> blue_of_faces(const LatticeMesh& mesh, int axis) {
  std::pair<double, double> shares{1, 0};
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (axis >= 0 && is_across(mesh, f, axis)) continue;
    double red = 0, blue = 0;
    for (const LinearColor& c : mesh.colors[f]) red += c.r, blue += c.b;
    shares = {std::min(shares.first, blue / (red + blue)), std::max(shares.second, blue / (red + blue))};
  }
  return shares;
}

}  // namespace

TEST_CASE("a band of another colour does not fade over a large face", "[quick][pass][colors]") {
  const double height = GENERATE(1.5, 4.0, 6.0);  // of the foot of a wall; a level has one face for both
  ColoredScene scene;
  add_box(scene.triangles, {0, 0, 0}, {kSide, height, kSide});
  scene.paint(kBlue);
  add_box(scene.triangles, {0, height, 0}, {kSide, kSide, kSide});
  scene.paint(kRed);
  const LatticeMesh mesh = wall_of(scene);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const bool is_bottom =
        is_across(mesh, f, 1) && mesh.vertices[mesh.triangles[f][0]].y == box_of(mesh.vertices).min.y;
    CAPTURE(height, f);
    for (const LinearColor& c : mesh.colors[f]) {
      CHECK((is_bottom ? c.b : c.r) > 62000);
      CHECK((is_bottom ? c.r : c.b) < 3500);
    }
  }
}

TEST_CASE("a corner of another colour does not fade over a large face", "[quick][pass][colors]") {
  const int of = GENERATE(2, 5);
  const LatticeMesh mesh = wall_of(blocks({2, 2, 2}, [&](const auto& at) {
    return std::max({at[0], at[1], at[2]}) < of;
  }));
  for (const auto& corners : mesh.colors)
    for (const LinearColor& c : corners) CHECK(c.b < 3500);
}

TEST_CASE("walls of stripes keep the mean of their colours", "[quick][pass][colors]") {
  const int axis = GENERATE(0, 1, 2), of = GENERATE(2, 3), times = GENERATE(1, 2, 4), first = GENERATE(0, 1);
  const int width = of == 2 && times == 4 ? 6 : times;  // two stripes of each colour, or more
  std::array<int, 3> size{kSide, kSide, kSide};
  size[std::size_t(axis)] = width;
  const LatticeMesh mesh = wall_of(blocks(size, [&](const auto& at) { return at[std::size_t(axis)] % of == first; }));
  CAPTURE(axis, of, width, first);
  const auto [least, most] = blue_of_faces(mesh, axis);
  CHECK(least > 0.4 / of);  // some vertices are those of a red face, too
  CHECK(most < 1.0 / of + 0.25);
}

TEST_CASE("a chequered wall keeps the mean of its colours", "[quick][pass][colors]") {
  const int width = GENERATE(2, 4, 6);
  CAPTURE(width);
  const LatticeMesh mesh =
      wall_of(blocks({width, width, width}, [](const auto& at) { return (at[0] + at[1] + at[2]) % 2 == 1; }));
  const auto [least, most] = blue_of_faces(mesh, -1);
  CHECK(least > 0.4);
  CHECK(most < 0.6);
}
