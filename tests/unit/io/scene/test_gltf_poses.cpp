#include <cmath>
#include <numbers>

#include "io/scene/scene_pose.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/gltf_document.h"

using namespace bp;
using namespace bp::test;

namespace {

/// The quad, with morph targets that lift it by 1 and shift it by 2 along x.
Document morphing_quad() {
  Document d;
  d.node({{"mesh", d.quad_mesh()}});
  const int up = d.floats(std::vector<Vec3d>(4, Vec3d{0, 0, 1})),
            along = d.floats(std::vector<Vec3d>(4, Vec3d{2, 0, 0}));
  d.json["meshes"][0]["primitives"][0]["targets"] = Json::array({{{"POSITION", up}}, {{"POSITION", along}}});
  return d;
}

void animate(Document& d, const char* path, const std::vector<float>& times, const std::vector<float>& values,
             const char* type, std::size_t count, const char* way = "LINEAR") {
  const int input = d.array(times, kF32, "SCALAR", times.size()), output = d.array(values, kF32, type, count);
  if (!d.json.contains("animations"))
    d.json["animations"] = Json::array({{{"samplers", Json::array()}, {"channels", Json::array()}}});
  Json& animation = d.json["animations"][0];
  animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", way}});
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", 0}, {"path", path}}}});
}

/// Where the first corner of the quad is in each pose.
std::vector<Vec3d> first_corners(const Document& d, std::optional<double> per_second = {}) {
  const TempDir dir;
  const std::string path = dir.file("cage.glb", d.glb());
  std::vector<Vec3d> places;
  for (const ScenePose& pose : read_poses(path, {}, per_second)) {
    SceneOptions options;
    options.pose = std::make_shared<const ScenePose>(pose);
    const IndexedMesh mesh = read_mesh(path, options);
    REQUIRE(mesh.triangles.size() == 2);
    places.push_back(mesh.vertices[mesh.triangles[0][0]]);
  }
  return places;
}

std::string complaint_of_poses(const Document& d, double per_second) {
  try {
    (void)first_corners(d, per_second);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

using Places = std::vector<Vec3d>;

}  // namespace

TEST_CASE("a file that does not move has one pose", "[quick][io]") {
  Document d;
  d.node({{"mesh", d.quad_mesh()}});
  CHECK(first_corners(d) == Places{{0, 0, 0}});
  const TempDir dir;
  CHECK(read_poses(dir.file("cage.obj", "v 0 0 0\n"), {}).size() == 1);
}

TEST_CASE("without an animation each morph target is a pose, or the weights of the file are", "[quick][io]") {
  Document d = morphing_quad();
  CHECK(first_corners(d) == Places{{0, 0, 1}, {2, 0, 0}});
  d.json["meshes"][0]["weights"] = {0.5, 0.25};
  CHECK(first_corners(d) == Places{{0.5, 0, 0.5}});
  d.json["nodes"][0]["weights"] = {0, 1};
  CHECK(first_corners(d) == Places{{2, 0, 0}});
}

TEST_CASE("an animation of weights has a pose at each of its times, or so many a second", "[quick][io]") {
  Document d = morphing_quad();
  animate(d, "weights", {0, 1, 3}, {0, 0, 1, 0, 0, 1}, "SCALAR", 6);
  CHECK(first_corners(d) == Places{{0, 0, 0}, {0, 0, 1}, {2, 0, 0}});
  CHECK(first_corners(d, 1) == Places{{0, 0, 0}, {0, 0, 1}, {1, 0, 0.5}, {2, 0, 0}});
}

TEST_CASE("nodes that are animated move a mesh, and times of all channels count", "[quick][io]") {
  Document d;
  d.node({{"mesh", d.quad_mesh()}, {"translation", {1, 0, 0}}, {"scale", {3, 3, 3}}});
  animate(d, "translation", {0, 2}, {1, 0, 0, 5, 0, 0}, "VEC3", 2);
  animate(d, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0}, "VEC4", 2, "STEP");
  CHECK(first_corners(d) == Places{{1, 0, 0}, {3, 0, 0}, {5, 0, 0}});
}

TEST_CASE("rotations take the shorter arc, and cubic curves their tangents", "[quick][io]") {
  Document d;
  const float half = float(std::numbers::sqrt2 / 2);
  const int positions = d.floats({{1, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 1, 1}});
  d.node({{"mesh", d.mesh(positions, d.array<std::uint8_t>({0, 1, 2, 0, 2, 3}, kU8, "SCALAR", 6))}});
  animate(d, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, -half, -half}, "VEC4", 2);
  const Places turned = first_corners(d, 2);
  REQUIRE(turned.size() == 3);
  CHECK(std::abs(turned[1][0] - std::numbers::sqrt2 / 2) < 1e-6);
  CHECK(std::abs(turned[1][1] - std::numbers::sqrt2 / 2) < 1e-6);
  CHECK(std::abs(turned[2][1] - 1) < 1e-6);

  Document cubic = morphing_quad();
  // From 0 to 1 with the tangents 0 and 4: 1/2 and -4/8 at the half.
  animate(cubic, "weights", {0, 1}, {0, 0, 0, 0, 0, 0, 4, 0, 1, 0, 0, 0}, "SCALAR", 12, "CUBICSPLINE");
  const Places blended = first_corners(cubic, 2);
  REQUIRE(blended.size() == 3);
  CHECK(std::abs(blended[1][2]) < 1e-6);
  CHECK(blended[2] == Vec3d{0, 0, 1});
}

TEST_CASE("animations that cannot be followed are refused", "[quick][io]") {
  Document endless = morphing_quad();
  animate(endless, "weights", {0, 1e6F}, {0, 0, 1, 0}, "SCALAR", 4);
  CHECK_THAT(complaint_of_poses(endless, 24), Contains("24000001 poses, and at most 100000"));
  Document falling = morphing_quad();
  animate(falling, "weights", {1, 0}, {0, 0, 1, 0}, "SCALAR", 4);
  CHECK_THAT(complaint_of_poses(falling, 1), Contains("times that do not rise"));
  Document uneven = morphing_quad();
  animate(uneven, "weights", {0, 1}, {0, 0, 1}, "SCALAR", 3);
  CHECK_THAT(complaint_of_poses(uneven, 1), Contains("2 times and 3 values"));
  Document short_target = morphing_quad();
  short_target.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = short_target.floats({{0, 0, 1}});
  CHECK_THAT(complaint_of_poses(short_target, 1), Contains("moves 1 of 4 vertices"));
}
