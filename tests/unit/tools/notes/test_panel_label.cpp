#include <cmath>

#include "tests/catch.h"
#include "tools/notes/panel_label.h"

using namespace bp;

namespace {

Bounds3d between(const Vec3d& a, const Vec3d& b) {
  Bounds3d bounds;
  bounds.add(a);
  bounds.add(b);
  return bounds;
}

}  // namespace

TEST_CASE("panels carry names of files, and of folders where files have the same name", "[quick][tools]") {
  using Names = std::vector<std::string>;
  CHECK(panel_names({"scenes/horse.ply", "out/proxy.glb", "-"}) == Names{"horse.ply", "proxy.glb", "stdin"});
  CHECK(panel_names({"a/x.obj", "b/x.obj", "b/y.obj"}) == Names{"a/x.obj", "b/x.obj", "y.obj"});
  CHECK(panel_names({"/r/a/b/x.obj", "/r/c/b/x.obj"}) == Names{"a/b/x.obj", "c/b/x.obj"});
  CHECK(panel_names({"x.obj", "a/x.obj", "a/x.obj"}) == Names{"x.obj", "a/x.obj", "a/x.obj"});
  CHECK(panel_names({"/x.obj", "x.obj"}) == Names{"/x.obj", "x.obj"});
}

TEST_CASE("bounds are told to a thousandth of the diagonal, wherever they lie", "[quick][tools]") {
  CHECK(bounds_text({}).empty());
  CHECK(bounds_text(between({0, 0, -0.5}, {1, 2, 3})) == "x 0 to 1, y 0 to 2, z -0.5 to 3");
  CHECK(bounds_text(between({1842009.91234, 258.9, -5176046.5}, {1842019.98765, 260, -5176030})) ==
        "x 1842009.91 to 1842019.99, y 258.9 to 260, z -5176046.5 to -5176030");
  CHECK(bounds_text(between({496556.62, 6781089.89, -0.5}, {503335.94, 6785634.4, 175.3})) ==
        "x 496557 to 503336, y 6781090 to 6785634, z -0.5 to 175");
  CHECK(bounds_text(between({-0.000213217, 0, 0}, {0.000213217, 1e-5, 1e-3})) ==
        "x -0.000213 to 0.000213, y 0 to 1e-05, z 0 to 0.001");
  for (const double x : {1e300, 1e-300, HUGE_VAL, 0.0})
    CHECK_FALSE(bounds_text(between({-x, 0, 0}, {x, 1, 1})).empty());
}

TEST_CASE("a picture without a font comes with a remedy", "[quick][tools]") {
  CHECK(note_on_font(nullptr).find("fonts-dejavu-core") != std::string::npos);
}
