#include <cmath>
#include <random>

#include "io/mesh/mesh_writer.h"
#include "lib/core/error.h"
#include "tests/catch.h"
#include "tools/run/origin.h"

using namespace bp;
using Catch::Matchers::Contains;

namespace {

Bounds3d box(const Vec3d& min, const Vec3d& max) {
  Bounds3d bounds;
  bounds.add(min);
  bounds.add(max);
  return bounds;
}

}  // namespace

TEST_CASE("the origin that is chosen is a round point near a scene that lies far off", "[quick][tools]") {
  CHECK(auto_origin(box({84616.5, 447423, -0.47}, {85140.8, 447751, 13.58})) == Vec3d{84900, 447600, 0});
  CHECK(auto_origin(box({496557, 6781090, -0.5}, {503336, 6785630, 175})) == Vec3d{500000, 6783000, 0});
  CHECK(auto_origin(box({0, 0, 0}, {10, 20, 30})) == Vec3d{});
  CHECK(auto_origin(box({100, 0, 0}, {130, 20, 30})) == Vec3d{});
  CHECK(auto_origin(box({5, 5, 5}, {5, 5, 5})) == Vec3d{});
  CHECK(auto_origin(Bounds3d{}) == Vec3d{});
  const Vec3d small = auto_origin(box({1000.01, 0, 0}, {1000.03, 0.01, 0.01}));  // a power of two
  CHECK(small == Vec3d{1000 + 3.0 / 128, 1.0 / 128, 1.0 / 128});
}

TEST_CASE("the origin that is chosen moves every lattice point exactly", "[quick][tools]") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> exponent(-6, 9), distance(0, 7), resolution(0, 5), place(-1, 1);
  int frames = 0;
  for (int i = 0; i < 3000; ++i) {
    const double side = std::pow(10, exponent(random)), far = side * std::pow(10, distance(random));
    const Vec3d lo{far * place(random), far * place(random), far * place(random)};
    const Bounds3d bounds = box(lo, {lo[0] + side, lo[1] + side * std::abs(place(random)), lo[2] + side / 100});
    const double voxel = side / std::pow(10, resolution(random));
    if (side / voxel > 20000 || far / voxel > 1e9) continue;  // make_frame() refuses more
    const GridFrame frame = make_frame(bounds, voxel);
    const Vec3d origin = origin_of(parse_origin("auto"), frame, bounds);  // throws if it rounds
    const VoxelBox voxels = voxel_bounds(frame, bounds);
    for (int n = 0; n < 10; ++n) {
      LatticeCoord p;
      for (int k = 0; k < 3; ++k)
        p[k] = std::uniform_int_distribution<std::int64_t>(voxels.min[k] * 64, voxels.max[k] * 64)(random);
      const Vec3d world = frame.world(p);
      for (std::size_t k = 0; k < 3; ++k) {
        const double moved = world[k] - origin[k];
        REQUIRE(moved + origin[k] == world[k]);
        REQUIRE(world[k] - moved == origin[k]);
        if (origin != Vec3d{}) REQUIRE(std::abs(moved) <= 1.1 * side + 3 * frame.voxel);
      }
    }
    ++frames;
  }
  CHECK(frames > 1000);
}

TEST_CASE("an origin that would round is refused before there is a mesh", "[quick][tools]") {
  const Bounds3d bounds = box({6801760.1, -455564.7, 31.3}, {6809760.1, -447564.7, 131.3});
  const GridFrame frame = make_frame(bounds, 0.37);
  CHECK_THROWS_WITH(origin_of(parse_origin("6801760.1,-455564.7,1e-9"), frame, bounds), Contains("without rounding"));
  CHECK(origin_of(parse_origin("6801760,-455564,0"), frame, bounds) == Vec3d{6801760, -455564, 0});
  CHECK(origin_of(parse_origin("off"), frame, bounds) == Vec3d{});
  CHECK(origin_of({}, frame, bounds) == Vec3d{});
}

TEST_CASE("coordinates that 32-bit floats cannot tell apart are noted, unless somebody knows", "[quick][tools]") {
  const Bounds3d far = box({6801760.1, -455564.7, 31.3}, {6809760.1, -447564.7, 131.3});
  const GridFrame frame = make_frame(far, 8);
  CHECK_THAT(origin_note({}, frame, far), Contains("steps of 0.5 ") && Contains("--origin auto"));
  CHECK(origin_note(parse_origin("off"), frame, far).empty());
  CHECK_THAT(origin_note(parse_origin("auto"), frame, far), Contains("subtracts 6806000,-452000,0 "));
  CHECK(origin_note(parse_origin("6806000,-452000,0"), frame, far).empty());
  CHECK_THAT(origin_note(parse_origin("1,0,0"), frame, far), Contains("steps of 0.5 "));
  const Bounds3d near = box({0, 0, 0}, {10, 20, 30});
  CHECK(origin_note({}, make_frame(near, 0.03), near).empty());
  CHECK(origin_note(parse_origin("auto"), make_frame(near, 0.03), near).empty());
}

TEST_CASE("an origin is a point, auto or off", "[quick][tools]") {
  CHECK(parse_origin("auto").text() == "auto");
  CHECK(parse_origin("off").text() == "off");
  CHECK(parse_origin("1,-2.5,3e6").text() == "1,-2.5,3000000");
  CHECK(OriginOption{}.text().empty());
  const std::string text = GENERATE("", "Auto", "1,2", "none", "0");
  CHECK_THROWS_AS(parse_origin(text), Error);
}
