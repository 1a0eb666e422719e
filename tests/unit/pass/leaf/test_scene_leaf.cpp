#include <cmath>
#include <random>
#include <set>

#include "lib/core/vec3.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/pass/leaf/scene_leaf.h"
#include "lib/store/result_key.h"
#include "lib/tileset/tile_tree.h"
#include "tests/catch.h"
#include "tests/support/textured_scene.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Triangles of all sizes in a box from 0 to 16; places in images are their x and y.
TexturedScene random_scene(int count) {
  std::mt19937 rand(7);
  const auto unit = [&] { return double(rand() % 100000) / 100000; };
  TexturedScene scene;
  for (int i = 0; i < count; ++i) {
    const double size = i % 10 == 0 ? 16 : 1;
    TriangleD t;
    TriangleTexture texture;
    texture.material = 0;
    const Vec3d at{unit() * 16, unit() * 16, unit() * 16};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t a = 0; a < 3; ++a) t[k][a] = std::min(16.0, at[a] + size * unit());
      texture.uv[k] = {float(t[k][0]), float(t[k][1])};
    }
    scene.triangles.push_back(t);
    scene.textures.push_back(texture);
  }
  return scene;
}

TriangleD corners_of(const SceneLeaf& leaf, const LeafPart& part, std::size_t f) {
  TriangleD t;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i)
      t[k][i] = leaf.origin[i] + leaf.unit * part.vertices[part.triangles[f][k]].at[i];
  return t;
}

double area_of(const SceneLeaf& leaf) {
  double area = 0;
  for (const LeafPart& part : leaf.parts)
    for (std::size_t f = 0; f < part.triangles.size(); ++f) area += bp::area_of(corners_of(leaf, part, f));
  return area;
}

const Bounds3d kBox{{0, 0, 0}, {16, 16, 16}};

}  // namespace

TEST_CASE("the leaves of a box's octants together are the scene", "[quick][leaf]") {
  const TexturedScene scene = random_scene(200);
  const auto looks = looks_of(scene, one_material());
  const double unit = leaf_unit(0.25, 64);
  double whole = 0, cut = 0;
  for (const TriangleD& t : scene.triangles) whole += area_of(t);
  for (int k = 0; k < 8; ++k) {
    const Bounds3d box = octant_of(kBox, k);
    const SceneLeaf leaf = cut_leaf(*looks, box, unit);
    cut += area_of(leaf);
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(leaf.bounds.min[i] >= box.min[i]);
      CHECK(leaf.bounds.max[i] <= box.max[i]);
    }
  }
  CHECK(cut == Approx(whole).epsilon(1e-5));
  CHECK(area_of(cut_leaf(*looks, kBox, unit)) == Approx(whole).epsilon(1e-5));
}

TEST_CASE("leaves on both sides of a face have the same vertices there", "[quick][leaf]") {
  const auto looks = looks_of(random_scene(2000), one_material());
  const double unit = leaf_unit(0.25, 64);
  const auto on_face = [&](int k) {
    const SceneLeaf leaf = cut_leaf(*looks, octant_of(kBox, k), unit);
    std::set<std::array<double, 2>> points;
    for (const LeafPart& part : leaf.parts)
      for (const LeafVertex& v : part.vertices)
        if (leaf.origin[0] + unit * v.at[0] == 8)
          points.insert({leaf.origin[1] + unit * v.at[1], leaf.origin[2] + unit * v.at[2]});
    return points;
  };
  CHECK(on_face(0).size() > 20);
  CHECK(on_face(0) == on_face(1));
  CHECK(on_face(6) == on_face(7));
}

TEST_CASE("images lie on a leaf's pieces as on the scene", "[quick][leaf]") {
  const auto looks = looks_of(random_scene(100), one_material());
  const SceneLeaf leaf = cut_leaf(*looks, octant_of(kBox, 3), leaf_unit(0.25, 64));
  REQUIRE(leaf.parts.size() == 1);
  for (const LeafVertex& v : leaf.parts[0].vertices) {
    CHECK(double(v.uv[0]) == Approx(leaf.origin[0] + leaf.unit * v.at[0]).margin(1e-4));
    CHECK(double(v.uv[1]) == Approx(leaf.origin[1] + leaf.unit * v.at[1]).margin(1e-4));
  }
}

TEST_CASE("a leaf depends on the triangles nearby, and not on their order", "[quick][leaf]") {
  TexturedScene scene = random_scene(100);
  const Bounds3d box{{0, 0, 0}, {2, 2, 2}};
  const auto cut = [&] { return cut_leaf(*looks_of(scene, one_material()), box, leaf_unit(0.25, 64)); };
  const auto key = [&] {
    KeyHash hash("leaf");
    add_leaf_to(hash, *looks_of(scene, one_material()), box);
    return hash.key();
  };
  const SceneLeaf before = cut();
  const ResultKey key_before = key();
  std::reverse(scene.triangles.begin(), scene.triangles.end());
  std::reverse(scene.textures.begin(), scene.textures.end());
  scene.add({14, 14, 14}, {1, 0, 0}, {0, 1, 0}, 0);  // far away
  const SceneLeaf after = cut();
  CHECK(key() == key_before);
  REQUIRE(before.parts.size() == after.parts.size());
  for (std::size_t i = 0; i < before.parts.size(); ++i) {
    CHECK(before.parts[i].vertices == after.parts[i].vertices);
    CHECK(before.parts[i].triangles == after.parts[i].triangles);
  }
  scene.add({1, 1, 1}, {1, 0, 0}, {0, 1, 0}, 0);
  CHECK(key() != key_before);
  const ResultKey without_normal = key();
  scene.textures.back().normals[2] = pack_normal({0, 0.5, 1});  // of one corner only
  CHECK(key() != without_normal);
}

TEST_CASE("a flat side has one normal, and edges of less than 30 degrees are smooth", "[quick][leaf]") {
  const auto normals = [](double rise) {
    TexturedScene scene;
    scene.add({4, 4, 4}, {4, 0, 0}, {0, 4, 0}, 0);
    scene.add({8, 4, 4}, {4, 0, rise}, {0, 4, 0}, 0);
    std::set<std::array<float, 3>> all;
    for (const LeafPart& part : cut_leaf(*looks_of(scene, one_material()), kBox, leaf_unit(0.25, 64)).parts)
      for (const LeafVertex& v : part.vertices) all.insert(v.normal);
    return all.size();
  };
  CHECK(normals(0) == 1);
  CHECK(normals(4) == 2);  // a crease of 45 degrees
  CHECK(normals(1) >= 3);  // of 14
}

TEST_CASE("a cell of many triangles is cut into octants", "[quick][leaf]") {
  TexturedScene scene;
  scene.add({15, 15, 15}, {0.5, 0, 0}, {0, 0.5, 0}, 0);
  for (int i = 0; i < 66000; ++i) {
    const double x = double(i % 40) / 20, y = double(i / 40 % 40) / 20, z = double(i / 1600) / 20;
    scene.triangles.push_back({Vec3d{x, y, z}, {x + 0.01, y, z}, {x, y + 0.01, z}});
    scene.textures.push_back({});
  }
  const auto looks = looks_of(scene, one_material());
  const std::vector<LeafBox> boxes = leaf_boxes(*looks, kBox);
  REQUIRE(boxes.size() > 2);
  std::uint64_t triangles = 0;
  for (const LeafBox& b : boxes) {
    Bounds3d box = kBox;
    for (const char digit : b.path) box = octant_of(box, digit - '0');
    CHECK(box == b.box);
    CHECK(b.triangles > 0);
    CHECK(b.triangles <= kMostLeafTriangles);
    triangles += cut_leaf(*looks, box, leaf_unit(0.25, 64)).triangles();
  }
  CHECK(triangles >= scene.triangles.size());
}
