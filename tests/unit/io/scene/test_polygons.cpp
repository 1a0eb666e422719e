// Polygons that are not convex, as all readers cut them.
#include <algorithm>
#include <map>

#include "io/image/texture_writer.h"
#include "io/scene/texture_table.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr const char* kOutline = "v 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nv 0 0 0\n";
constexpr const char* kL = "f 2 3 4 5 6 1\n";  // its first corner does not see all others

/// Twice the area, and whether all triangles face the same way, towards z.
double area2(const std::vector<TriangleD>& triangles) {
  double sum = 0;
  for (const TriangleD& t : triangles) {
    const double area = (t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[1][1] - t[0][1]) * (t[2][0] - t[0][0]);
    CHECK(area >= 0);
    sum += area;
  }
  return sum;
}

/// A comb of at least so many corners in one face, that begins at a tooth.
std::string comb(int corners) {
  std::string text, face = "f";
  int n = 0;
  const auto add = [&](double x, double y) {
    text += fmt::format("v {} {} 0\n", x, y);
    ++n;
  };
  const int teeth = corners / 2;
  for (int i = teeth; i-- > 0;) add(2 * i + 1, 9), add(2 * i, 1);
  add(0, 0), add(2 * teeth, 0);
  for (int i = 1; i <= n; ++i) face += fmt::format(" {}", i);
  return text + face + "\n";
}

}  // namespace

TEST_CASE("a polygon that is not convex is cut within its outline", "[quick][io]") {
  const TempDir dir;
  const std::string path = dir.file("l.obj", std::string(kOutline) + kL);
  const std::vector<TriangleD> triangles = read_all(path);
  CHECK(triangles.size() == 4);
  CHECK(area2(triangles) == 10);
  CHECK(read_mesh(path).triangles.size() == 4);
  SceneOptions fans;
  fans.fans = true;
  const std::vector<TriangleD> fan = read_all(path, fans);
  REQUIRE(fan.size() == 4);
  for (const TriangleD& t : fan) CHECK(t[0] == Vec3d{3, 1, 0});
}

TEST_CASE("edges within a polygon that is not convex are told from its own", "[quick][io]") {
  const TempDir dir;
  const auto source = open_scene(dir.file("l.obj", std::string(kOutline) + kL + "f 1 2 3\n"));
  const std::vector<TriangleD> triangles = read_all(*source);
  source->rewind();
  const std::vector<std::uint8_t> inner = read_inner_edges(*source);
  REQUIRE(inner.size() == 5);
  std::map<std::pair<Vec3d, Vec3d>, int> edges;
  std::size_t within = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(((inner[i] & kSamePolygonBefore) != 0) == (i > 0));
    CHECK(((inner[i] & kSamePolygonAfter) != 0) == (i < 3));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d &a = triangles[i][k], &b = triangles[i][(k + 1) % 3];
      if ((inner[i] >> k & 1) == 0) continue;
      ++within;
      ++edges[std::minmax(a, b)];
    }
  }
  CHECK(within == 6);
  CHECK(edges.size() == 3);  // diagonals, each of two triangles
  CHECK(inner[4] == 0);
}

TEST_CASE("colours, places in images and normals stay at their corners", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("wall.png", encode_texture(TextureImage(2, 2, {255, 9, 0, 200})).bytes);
  (void)dir.file("m.mtl", "newmtl wall\nmap_Kd wall.png\n");
  const std::string path = dir.file(
      "l.obj",
      "mtllib m.mtl\nv 3 0 0 1 0 0\nv 3 1 0 0 1 0\nv 1 1 0 0 0 1\nv 1 3 0 1 1 0\nv 0 3 0 0 1 1\nv 0 0 0 0 0 0\n"
      "vt .3 0\nvt .3 .1\nvt .1 .1\nvt .1 .3\nvt 0 .3\nvt 0 0\nvn 1 0 0\nvn 0 1 0\nvn 0 0 1\nusemtl wall\n"
      "f 2/2/1 3/3/2 4/4/3 5/5/1 6/6/2 1/1/3\nf 6/6/2 1/1/3 2/2/1 3/3/2 4/4/3 5/5/1\n");
  SceneOptions options;
  options.colors = options.surface = true;
  options.textures = std::make_shared<TextureTable>();
  const auto source = open_scene(path, options);
  std::vector<TriangleD> triangles;
  std::vector<TriangleColors> colors;
  std::vector<TriangleTexture> textures;
  REQUIRE(source->read_textured(triangles, colors, textures));
  REQUIRE(triangles.size() == 8);
  struct Corner {
    LinearColor color;
    std::array<float, 2> uv;
    PackedNormal normal;
  };
  std::map<Vec3d, Corner> corners;
  for (std::size_t i = 8; i-- > 0;) {  // from the second face, which is a fan, to the first
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner here{colors[i][k], textures[i].uv[k], textures[i].normals[k]};
      const Corner& known = corners.emplace(triangles[i][k], here).first->second;
      CHECK((known.color == here.color && known.uv == here.uv && known.normal == here.normal));
    }
  }
  CHECK(corners.size() == 6);
}

TEST_CASE("a polygon larger than a batch is delivered whole, and as its fan beyond the limit", "[quick][io]") {
  const TempDir dir;
  const std::vector<TriangleD> cut = read_all(dir.file("a.obj", comb(4000)));
  CHECK(cut.size() == 4000);
  CHECK(area2(cut) == 20 * 2000 - 1);  // 2,000 teeth from 1 to 9, 2 wide; the last one leans
  SceneOptions keep;
  keep.keep_degenerate = true;
  const std::vector<TriangleD> fan = read_all(dir.file("b.obj", comb(40000)), keep);
  REQUIRE(fan.size() == 40000);
  CHECK(std::all_of(fan.begin(), fan.end(), [&](const TriangleD& t) { return t[0] == fan[0][0]; }));
}

TEST_CASE("a polygon with a corner that is not finite, or missing, is left to what is told of it", "[quick][io]") {
  const TempDir dir;
  const SceneCounts nan = counts_of(dir.file("a.obj", std::string(kOutline) + kL + "v nan 0 0\nf 2 3 4 5 7 1\n"));
  CHECK((nan.triangles == 6 && nan.non_finite == 2 && nan.bad_faces == 0));
  const SceneCounts missing = counts_of(dir.file("b.obj", std::string(kOutline) + kL + "f 2 3 4 5 9 1\n"));
  CHECK((missing.triangles == 4 && missing.bad_faces == 1));
}
