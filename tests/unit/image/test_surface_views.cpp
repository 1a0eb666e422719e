#include "lib/image/surface_views.h"
#include "tests/catch.h"

using namespace bp;

namespace {

/// The two triangles of a rectangle in the plane of x and y.
std::vector<TriangleD> rectangle(double x0, double x1, double y1, double z) {
  return {{Vec3d{x0, 0, z}, Vec3d{x1, 0, z}, Vec3d{x1, y1, z}}, {Vec3d{x0, 0, z}, Vec3d{x1, y1, z}, Vec3d{x0, y1, z}}};
}

Bounds3d unit_box() {
  Bounds3d box;
  box.add({0, 0, 0});
  box.add({1, 1, 1});
  return box;
}

}  // namespace

TEST_CASE("views of the same surface do not differ", "[quick]") {
  const std::vector<TriangleD> scene = rectangle(0, 1, 1, 0.5);
  const SurfaceViews views(scene, unit_box());
  CHECK(views.difference(scene) == 0);
  const TriangleD first = scene[0];
  const std::vector<TriangleD> turned{scene[1], {first[2], first[0], first[1]}};
  CHECK(views.difference(turned) < 1e-6);  // rounding of depths
}

TEST_CASE("what is missing, and what is too much, counts by its pixels", "[quick]") {
  const std::vector<TriangleD> whole = rectangle(0, 1, 1, 0.5), half = rectangle(0, 0.5, 1, 0.5);
  CHECK(SurfaceViews(whole, unit_box()).difference(half) == Approx(0.5).margin(0.02));
  CHECK(SurfaceViews(half, unit_box()).difference(whole) == Approx(0.5).margin(0.02));
  CHECK(SurfaceViews(whole, unit_box()).difference({}) > 0.9);
}

TEST_CASE("a depth counts in proportion", "[quick]") {
  const std::vector<TriangleD> scene = rectangle(0, 1, 1, 0.5);
  const SurfaceViews views(scene, unit_box());
  const double little = views.difference(rectangle(0, 1, 1, 0.51)), more = views.difference(rectangle(0, 1, 1, 0.52));
  CHECK(little > 0);
  CHECK(more > 1.5 * little);
  CHECK(views.difference(rectangle(0, 1, 1, 0.9)) <= 1);
}

TEST_CASE("a surface that stands otherwise counts where its depth is about the same", "[quick]") {
  std::vector<TriangleD> stairs;  // as fine as a pixel or two, so that depths hardly differ
  for (int i = 0; i < 64; ++i) {
    const double x = i / 64.0, z = i % 2 == 0 ? 0.5 : 0.51, next = i % 2 == 0 ? 0.51 : 0.5;
    stairs.push_back({Vec3d{x, 0, z}, Vec3d{x + 1 / 64.0, 0, next}, Vec3d{x + 1 / 64.0, 1, next}});
    stairs.push_back({Vec3d{x, 0, z}, Vec3d{x + 1 / 64.0, 1, next}, Vec3d{x, 1, z}});
  }
  const SurfaceViews views(rectangle(0, 1, 1, 0.505), unit_box());
  CHECK(views.difference(stairs) > 4 * views.difference(rectangle(0, 1, 1, 0.51)));
}

TEST_CASE("colours count in proportion if both surfaces have some", "[quick]") {
  const std::vector<TriangleD> scene = rectangle(0, 1, 1, 0.5);
  const auto grey = [](int level) {
    return [level](std::uint32_t, const std::array<double, 3>&, double) {
      return SurfaceViews::Color{std::uint8_t(level), std::uint8_t(level), std::uint8_t(level)};
    };
  };
  const SurfaceViews views(scene, unit_box(), grey(100));
  CHECK(views.difference(scene, grey(100)) == 0);
  CHECK(views.difference(scene, grey(151)) == Approx(0.2));
  CHECK(views.difference(scene) == 0);
  // A gradient: the shares of the corners are those of the place that a pixel shows.
  const auto ramp = [&](std::uint32_t i, const std::array<double, 3>& shares, double) {
    double x = 0;
    for (std::size_t k = 0; k < 3; ++k) x += shares[k] * scene[i][k][0];
    return SurfaceViews::Color{std::uint8_t(255 * x), 0, 0};
  };
  CHECK(SurfaceViews(scene, unit_box(), ramp).difference(scene, grey(0)) == Approx(0.5).margin(0.02));
}

TEST_CASE("what lies behind others is not shown", "[quick]") {
  std::vector<TriangleD> scene = rectangle(0, 1, 1, 0);
  const std::vector<TriangleD> above = rectangle(0, 1, 1, 1), inside = rectangle(0.4, 0.45, 0.05, 0.5);
  scene.insert(scene.end(), above.begin(), above.end());
  const std::vector<std::uint32_t> two = SurfaceViews(scene, unit_box()).shown();
  CHECK(two == std::vector<std::uint32_t>{0, 1, 2, 3});
  scene.insert(scene.begin(), inside.begin(), inside.end());
  CHECK(SurfaceViews(above, unit_box()).shown().size() == 2);
  CHECK(SurfaceViews(scene, unit_box()).shown().size() >= 4);
}
