#include <functional>

#include "lib/core/error.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"
#include "tools/notes/estimate.h"
#include "tools/notes/proportion.h"

using namespace bp;
using namespace bp::test;

namespace {

Bounds3d box(double x, double y, double z) {
  Bounds3d b;
  b.add({0, 0, 0});
  b.add({x, y, z});
  return b;
}

/// The message of the usage error that f() throws; "" if it throws none.
std::string question(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::bad_argument);
    return e.what();
  }
  return "";
}

std::string scale(const std::string& text, const Bounds3d& scene, double voxel = 0.005) {
  return question([&] { question_scale("--scale", parse_length(text), scene, voxel); });
}

std::string voxel(const std::string& text, const Bounds3d& scene) {
  return question([&] { question_voxel("--voxel", parse_length(text), scene); });
}

}  // namespace

TEST_CASE("a share or a number of voxels longer than the scene is refused", "[quick][tools]") {
  const Bounds3d scene = box(0.5, 1.2, 0);  // diagonal 1.3
  CHECK(scale("100%", scene).empty());
  CHECK(scale("4096%", scene) == "--scale 4096% is longer than the scene's diagonal (1.3); 100% is the most");
  CHECK(scale("130vx", scene, 0.01).empty());
  CHECK(scale("131vx", scene, 0.01) == "--scale 131vx is longer than the scene's diagonal (1.3); 100% is the most");
}

TEST_CASE("a length beyond a quarter of the diagonal is questioned", "[quick][tools]") {
  const Bounds3d scene = box(0.5, 1.2, 0);  // diagonal 1.3
  CHECK(scale("2", scene) == "--scale 2 is 154 % of the scene's diagonal (1.3): did you mean 2%?");
  CHECK_THAT(scale("60", scene), Contains("did you mean 60vx?"));
  CHECK_THAT(scale("200", scene), Contains("is the scene in other units?"));
  CHECK_THAT(scale("0.33", scene), Contains("did you mean 0.33%?"));
  CHECK(scale("0.325", scene).empty());
  for (const char* word : {"99%", "200vx", "100%", "0"}) CHECK(scale(word, scene).empty());
  CHECK(scale("2", box(0, 0, 0)).empty());
  CHECK(scale("2", Bounds3d()).empty());
}

TEST_CASE("a grid that is too coarse or too fine is questioned", "[quick][tools]") {
  const Bounds3d scene = box(0.5, 1.2, 0);
  CHECK(voxel("10", scene) ==
        "--voxel 10 makes a grid of 0.12 voxels along the scene's longest side (1.2): did you mean 10%? to insist, "
        "write 769%");
  CHECK_THAT(voxel("256", scene), Contains("did you mean --resolution 256?"));
  CHECK_THAT(voxel("0.00001", scene),
             Contains("--voxel 1e-05 makes a grid of 120000 voxels along the scene's longest side (1.2), more than "
                      "16384: is the scene in other units? to insist, say --voxel 0.000769%"));
  CHECK_NOTHROW(question_resolution(16384, scene));
  CHECK_THROWS_WITH(question_resolution(100000, scene), Contains("more than 16384: to insist, say --voxel 0.000923%"));
  CHECK_THAT(voxel("0.9997", box(0.01, 0, 0)), Contains("to insist, write 9997%"));
  CHECK_THAT(voxel("0.9997", box(0.1, 0, 0)), Contains("to insist, write 1000%"));
  CHECK_FALSE(voxel("1e-300", scene).empty());
  CHECK_FALSE(voxel("1e300", scene).empty());
  for (const char* word : {"0.15", "0.0001", "769%", "1e-9%"}) CHECK(voxel(word, scene).empty());
  CHECK(voxel("10", box(0, 0, 0)).empty());
}

TEST_CASE("a scale that is a large share of the scene is told, with the same number of percent", "[quick][tools]") {
  const Bounds3d scene = box(8.8, 0, 0);
  CHECK(scale_share_note(Length{2, Length::Unit::scene}, scene) ==
        "--scale 2 is 22.7 % of the scene's diagonal (8.8), and gaps up to 4 are closed; --scale 2% would be 0.176");
  CHECK(scale_share_note(Length{0.8, Length::Unit::scene}, scene).empty());
  CHECK(scale_share_note(Length{20, Length::Unit::percent}, scene).empty());
  CHECK(scale_share_note({}, scene).empty());
}

TEST_CASE("only a run of more than ten seconds is announced", "[quick][tools]") {
  const std::uint64_t memory = std::uint64_t(1) << 30;
  CHECK(estimate_note(estimate_voxelize(box(1, 1, 1), 1.0 / 256), memory).empty());
  CHECK(estimate_note(estimate_mesh(box(1, 1, 1), 1.0 / 256), memory).empty());
  const Estimate large = estimate_mesh(box(1, 1, 0.5), 1.0 / 16384);
  CHECK_THAT(estimate_note(large, memory), Contains("a grid of 16385 x 16385 x 8193 voxels: about "));
  CHECK_THAT(estimate_note(large, memory), Contains("with 1 GiB of memory; what does not fit goes to files in --temp"));
  VoxelizeCounts sparse;  // two small triangles in opposite corners
  sparse.area = 1e-6;
  sparse.extent = 4e-3;
  sparse.scene.triangles = 2;
  const double touched = most_touched_voxels(sparse, 1.0 / 16384);
  CHECK(estimate_note(estimate_mesh(box(1, 1, 0.5), 1.0 / 16384, 1, touched), memory).empty());
  CHECK(estimate_voxelize(box(1, 1, 1), 1.0 / 60000, touched).core_seconds < 1);
  sparse.area = 1e3;
  CHECK(estimate_mesh(box(1, 1, 0.5), 1.0 / 16384, 1, most_touched_voxels(sparse, 1.0 / 16384)).bytes == large.bytes);
  Estimate twice = large;
  twice.then(large);
  CHECK(twice.core_seconds == 2 * large.core_seconds);
  CHECK(twice.bytes == large.bytes);
}

TEST_CASE("the estimate of a tileset is within a factor of 3 of what runs took", "[quick][tools]") {
  // Sides of the grid in voxels; user seconds and peak memory of bplod --profile 3dtiles with its defaults.
  struct Run {
    double x, y, z, seconds, bytes;
  };
  const Run run =
      GENERATE(Run{1822, 1223, 51, 57.8, 346e6}, Run{1562, 977, 45, 33.5, 299e6}, Run{692, 711, 218, 19.7, 286e6},
               Run{821, 237, 552, 45.6, 339e6}, Run{806, 493, 269, 6.6, 356e6});
  VoxelizeCounts many;
  many.area = 1e12;
  const Estimate e = estimate_levels(box(run.x, run.y, run.z), many, 1, 4, true);
  CAPTURE(e.core_seconds, run.seconds, e.bytes, run.bytes);
  CHECK(std::abs(std::log(e.core_seconds / run.seconds)) < std::log(3.0));
  CHECK(std::abs(std::log(e.bytes / run.bytes)) < std::log(3.0));
}
