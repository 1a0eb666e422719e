#include <random>

#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"
#include "tools/run/part_boxes.h"

using namespace bp;
using namespace bp::test;

namespace {

/// A slanted rod of many triangles, a part called rod, and a far triangle that is none.
std::string rod_file(const TempDir& dir, std::vector<TriangleD>& rod, Bounds3d& bounds) {
  std::string text = "v -40 -40 -40\nv -39 -40 -40\nv -40 -39 -40\nf 1 2 3\no rod\n";
  std::mt19937 random(3);
  const auto jitter = [&] { return double(random() % 1000) / 1000; };
  for (int i = 0; i < 60; ++i) {
    TriangleD t;
    for (Vec3d& p : t) {
      const double s = i + 2 * jitter();
      p = {s, s / 2 + jitter(), s / 3 + jitter()};
      text += "v " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
      for (double& c : p) c = std::stod(std::to_string(c));
    }
    text += "f -3 -2 -1\n";
    rod.push_back(t);
  }
  for (const TriangleD& t : rod)
    for (const Vec3d& p : t) bounds.add(p);
  bounds.add({-40, -40, -40});
  return dir.file("rod.obj", text);
}

double distance_to(const Bounds3d& box, const Vec3d& p) {
  double d = 0;
  for (std::size_t i = 0; i < 3; ++i) d = std::max({d, box.min[i] - p[i], p[i] - box.max[i]});
  return d;
}

}  // namespace

TEST_CASE("boxes of a part hold its triangles, and no point far from them", "[quick][tools]") {
  const TempDir dir;
  std::vector<TriangleD> rod;
  Bounds3d bounds;
  const std::string file = rod_file(dir, rod, bounds);
  SceneFiles scene;
  scene.files = {{file, bytes_of_file(file).size()}};
  const std::vector<Bounds3d> boxes = part_boxes(scene, bounds, "r?d", {});
  CHECK(boxes.size() > 20);
  CHECK(boxes.size() <= 2048);
  for (const TriangleD& t : rod) {
    for (int k = 0; k < 30; ++k) {
      const double u = k % 6 / 5.0, v = (1 - u) * (k / 6) / 4.0;
      Vec3d p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = t[0][i] + u * (t[1][i] - t[0][i]) + v * (t[2][i] - t[0][i]);
      double least = 1e9;
      for (const Bounds3d& box : boxes) least = std::min(least, distance_to(box, p));
      if (least > 1e-9) FAIL_CHECK("a point lies " << least << " off");
    }
  }
  const double cell = bounds.diagonal() / 256;
  for (const Bounds3d& box : boxes) {  // the rod is thin: boxes keep to its line
    for (const Vec3d& p : {box.min, box.max}) CHECK(std::abs(p[1] - p[0] / 2) < 1 + 6 * cell);
  }
}

TEST_CASE("parts are refused where the scene is not there any more, or another one", "[quick][tools]") {
  const TempDir dir;
  std::vector<TriangleD> rod;
  Bounds3d bounds;
  const std::string file = rod_file(dir, rod, bounds);
  const auto complaint = [&](const SceneFiles& scene, const std::string& pattern) {
    try {
      (void)part_boxes(scene, bounds, pattern, {});
    } catch (const Error& e) {
      CHECK(e.code() == ErrorCode::bad_input);
      return std::string(e.what());
    }
    return std::string();
  };
  SceneFiles scene;
  CHECK_THAT(complaint(scene, "rod"), Contains("names no scene file"));
  scene.files = {{file, bytes_of_file(file).size()}};
  CHECK_THAT(complaint(scene, "pod"), Contains("fits 'pod'"));
  bounds.max[0] -= 1;  // another scene of the same size
  CHECK_THAT(complaint(scene, "rod"), Contains("has changed"));
  scene.files[0].bytes += 1;
  CHECK_THAT(complaint(scene, "rod"), Contains("has changed"));
  scene.files[0].name += "x";
  CHECK_THAT(complaint(scene, "rod"), Contains("is not there"));
}
