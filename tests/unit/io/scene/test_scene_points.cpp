#include "lib/core/vec3.h"
#include "tests/unit/io/scene/gltf_document.h"
#include "tests/unit/io/scene/moved_points.h"

using namespace bp;
using namespace bp::test;

namespace {

void stay(PointBatch&) {}
void double_x(PointBatch& batch) {
  for (Vec3d& p : batch.positions) p[0] *= 2;
  for (Vec3d& n : batch.normals) n = {0, 0, 1};
}

const std::string kObj =
    "\xEF\xBB\xBFmtllib a.mtl\r\no part\n  v 1.50 0 -0.0 1.0 # x\nvt 0.5 0.5\nvn 0 0 1\nv\t1e1 2 3 0.1 0.2 0.3\n"
    "v 4 \\\n 5 6\nusemtl m\nf 1/1/1 2 3\n#v 1 2 3\nvp 1 2\nf 1 2 4\nv 0.1234567890123 0 0";

std::string ascii_points() {
  return "ply\nformat ascii 1.0\nelement thing 2\nproperty int a\nelement vertex 2\nproperty float x\nproperty uchar "
         "red\n"
         "property float y\nproperty double z\nproperty float nx\nproperty float ny\nproperty float nz\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n7\n8\n"
         "1.50 255 2 3 1 0 0 extra\n-4 1 5 0.1234567890123 0 1.0 0\n3 0 1 0\n";
}

void put_float(std::string& bytes, float value, bool big) {
  char raw[4];
  std::memcpy(raw, &value, 4);
  if (big) std::reverse(raw, raw + 4);
  bytes.append(raw, 4);
}

std::string binary_ply(bool big) {
  std::string bytes =
      std::string("ply\nformat binary_") + (big ? "big" : "little") +
      "_endian 1.0\nelement pad 3\nproperty uchar a\nelement vertex 3\nproperty float y\nproperty uchar "
      "red\nproperty float x\nproperty float z\nelement face 1\nproperty list uchar uchar "
      "vertex_indices\nend_header\nabc";
  for (int i = 0; i < 3; ++i) {
    put_float(bytes, float(i), big);
    bytes += 'r';
    put_float(bytes, 1.25F + float(i), big);
    put_float(bytes, -float(i), big);
  }
  return bytes + std::string("\3\0\1\2", 4);
}

}  // namespace

TEST_CASE("points that stay keep every byte of an OBJ and a PLY", "[io][deform][quick]") {
  const TempDir dir;
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>{"a.obj", kObj},
                                    {"b.ply", ascii_points()},
                                    {"c.ply", binary_ply(false)},
                                    {"d.ply", binary_ply(true)}}) {
    INFO(name);
    CHECK(moved(dir, dir.file(name, bytes), stay) == bytes);
  }
}

TEST_CASE("the points of an OBJ move, and the rest of the text stays", "[io][deform][quick]") {
  const TempDir dir;
  const std::string path = dir.file("a.obj", kObj);
  const std::vector<Vec3d> expected{{1.5, 0, 0}, {10, 2, 3}, {4, 5, 6}, {0.1234567890123, 0, 0}};
  CHECK(points_of(path) == expected);
  std::string text = kObj;
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("1.50", "3");
  replace("1e1", "20");
  replace("v 4 ", "v 8 ");
  replace("0.1234567890123", "0.2469135780246");
  CHECK(moved(dir, path, double_x) == text);
  const auto points = open_points(path, {});
  std::vector<Vec3d> ignored;
  while (points->read(ignored)) {
  }
  CHECK(points->left_behind() != "");
}

TEST_CASE("points of an OBJ far from the origin move as exactly as they are written", "[io][deform][quick]") {
  const TempDir dir;
  const std::string path = dir.file("far.obj", "v 4321567.8 432156.75 0.125\nv 4321567.81 1 2\n");
  const MovePoints shift = [](PointBatch& batch) {
    for (Vec3d& p : batch.positions) p = p + Vec3d{0.25, 0.25, 0.25};
  };
  const auto points = points_of(dir.file("moved-far.obj", moved(dir, path, shift)));
  REQUIRE(points.size() == 2);
  CHECK(std::abs(points[0][0] - 4321568.05) < 1e-6);
  CHECK(std::abs(points[0][1] - 432157.0) < 1e-6);
  CHECK(std::abs(points[1][0] - 4321568.06) < 1e-6);
}

TEST_CASE("the points and normals of a PLY move, and the rest stays", "[io][deform][quick]") {
  const TempDir dir;
  const std::string path = dir.file("b.ply", ascii_points());
  CHECK(points_of(path) == std::vector<Vec3d>{{1.5, 2, 3}, {-4, 5, 0.1234567890123}});
  std::string text = ascii_points();
  text.replace(text.find("1.50 255 2 3 1 0 0"), 18, "3 255 2 3 0 0 1");
  text.replace(text.find("-4 1 5 0.1234567890123 0 1.0 0"), 30, "-8 1 5 0.1234567890123 0 0 1");
  CHECK(moved(dir, path, double_x) == text);
  for (const bool big : {false, true}) {
    const std::string after = moved(dir, dir.file("c.ply", binary_ply(big)), double_x);
    CHECK(points_of(dir.file("after.ply", after)) == std::vector<Vec3d>{{2.5, 0, 0}, {4.5, 1, -1}, {6.5, 2, -2}});
    CHECK(after.size() == binary_ply(big).size());
    CHECK(after.substr(after.size() - 4) == std::string("\3\0\1\2", 4));
  }
}

TEST_CASE("files whose points cannot be moved are refused", "[io][deform][quick]") {
  const TempDir dir;
  const auto refused = [&](const std::string& name, const std::string& bytes, const char* why) {
    CHECK_THROWS_WITH(points_of(dir.file(name, bytes)), Contains(why));
  };
  refused("a.stl", "solid\nendsolid\n", "moved in OBJ, PLY and glTF");
  refused("a.obj", "v 1 2\n", "three numbers");
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 1\n";
  refused("a.ply", head + "property int x\nproperty int y\nproperty int z\nend_header\n1 2 3\n", "whole numbers");
  refused("b.ply", head + "property list uchar int x\nend_header\n1 2\n", "have lists");
  refused("c.ply", head + "property float x\nproperty float y\nproperty float z\nend_header\n1 2\n", "truncated");
  refused("e.ply",
          "ply\nformat ascii 1.0\nelement thing 9000000000000000000\nproperty int a\nelement vertex 1\nproperty float "
          "x\nproperty float y\nproperty float z\nend_header\n1\n0 0 0\n",
          "truncated");
  refused("d.ply", binary_ply(false).substr(0, 250), "truncated");
}
