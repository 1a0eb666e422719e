#include <algorithm>
#include <cmath>
#include <set>

#include "lib/core/vec3.h"
#include "lib/geometry/surface_distance.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/pass/leaf/detail/missing_length.h"
#include "lib/pass/leaf/scene_tiles.h"
#include "lib/tileset/tile_tree.h"
#include "tests/catch.h"
#include "tests/support/textured_scene.h"

using namespace bp;
using namespace bp::test;

namespace {

/// A hilly ground of `n` x `n` squares of side 1, and small boards that float over it.
TexturedScene ground(int n, int boards) {
  TexturedScene scene;
  const auto add = [&](const TriangleD& t) {
    scene.triangles.push_back(t);
    scene.textures.emplace_back().material = 0;
  };
  const auto at = [](int x, int y) { return Vec3d{double(x), double(y), 2 * std::sin(x * 0.4) * std::cos(y * 0.3)}; };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      add({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      add({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  for (int i = 0; i < boards; ++i) {
    const Vec3d a{1.25 + i % (n - 2), 1.25 + (i / (n - 2)) % (n - 2), 5};
    add({a, a + Vec3d{0.1, 0, 0}, a + Vec3d{0, 0.1, 0}});
  }
  return scene;
}

/// A tile, those below it, and its box.
struct Branch {
  SceneTile tile;
  Bounds3d box;
  std::vector<Branch> below;
};

Branch branch_of(const SceneLooks& looks, const LeafTree& tree, double unit, std::uint64_t most) {
  Branch branch{{}, tree.box.box, {}};
  if (tree.octants.empty()) {
    branch.tile = leaf_tile(looks, tree.box.box, unit);
    return branch;
  }
  std::vector<SceneTile> below;
  for (const LeafTree& octant : tree.octants) {
    branch.below.push_back(branch_of(looks, octant, unit, most));
    below.push_back(branch.below.back().tile);
  }
  branch.tile = tile_above(below, tree.box.box, most, [&](std::uint32_t m) { return looks.key_of(m); });
  return branch;
}

template <class F>
void for_each(const Branch& branch, const F& f) {
  f(branch);
  for (const Branch& below : branch.below) for_each(below, f);
}

/// Returns the vertices of a tile, with their normals, on the plane in which its box meets another one.
std::set<std::pair<Vec3d, std::array<float, 3>>> vertices_at(const SceneTile& tile, std::size_t axis, double face) {
  std::set<std::pair<Vec3d, std::array<float, 3>>> all;
  for (const LeafPart& part : tile.leaf.parts) {
    for (const LeafVertex& v : part.vertices) {
      Vec3d p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = tile.leaf.origin[i] + tile.leaf.unit * v.at[i];
      if (p[axis] == face) all.emplace(p, v.normal);
    }
  }
  return all;
}

constexpr std::uint64_t kMost = 600;

}  // namespace

TEST_CASE("the cube of a scene holds it, and its octants have whole middles", "[quick][leaf]") {
  for (const Bounds3d& scene :
       {Bounds3d{{0, 0, 0}, {1, 2, 3}}, Bounds3d{{6e6, -3e5, 0.1}, {6e6 + 5000, -3e5, 70}},
        Bounds3d{{1e-3, 1e-3, 1e-3}, {1.1e-3, 1.1e-3, 1.1e-3}}, Bounds3d{{5, 5, 5}, {5, 5, 5}}}) {
    const TileCube cube = tile_cube(scene);
    CHECK(cube.box.contains(scene));
    CHECK((cube.box.max[0] - cube.box.min[0]) / cube.unit <= std::ldexp(1.0, 25));
    Bounds3d box = cube.box;
    for (int depth = 0; depth < 12; ++depth) box = octant_of(box, depth % 8);
    const Vec3d middle = middle_of(box);
    for (const double x : middle) CHECK(x / cube.unit == std::nearbyint(x / cube.unit));
  }
}

TEST_CASE("tiles of any levels have the same vertices and normals where they meet", "[quick][leaf]") {
  const TexturedScene scene = ground(60, 0);
  const auto looks = looks_of(scene, one_material());
  const TileCube cube = tile_cube(bounds_of(scene.triangles));
  const Branch root = branch_of(*looks, leaf_tree(*looks, cube.box, kMost), cube.unit, kMost);
  REQUIRE(root.below.size() >= 4);
  REQUIRE(!root.below.front().below.empty());
  // A coarse tile beside the fine ones of its neighbour.
  std::size_t met = 0;
  for (const Branch& a : root.below) {
    for (const Branch& b : root.below) {
      if (a.box.max[0] != b.box.min[0] || a.box.min[1] != b.box.min[1] || a.box.min[2] != b.box.min[2]) continue;
      const double face = a.box.max[0];
      auto fine = vertices_at({}, 0, face);
      for (const Branch& below : b.below) fine.merge(vertices_at(below.tile, 0, face));
      const auto coarse = vertices_at(a.tile, 0, face);
      CHECK(coarse.size() > 10);
      CHECK(coarse == fine);
      ++met;
    }
  }
  CHECK(met > 0);
}

TEST_CASE("separate pieces across a face keep their points there", "[quick][leaf]") {
  TexturedScene scene = ground(40, 0);
  scene.triangles.clear();
  scene.textures.clear();
  for (int i = 0; i < 40; ++i) {
    for (int k = 0; k < 40; ++k) {  // triangles that touch nothing
      const Vec3d a{i + 0.37 * (k % 3), double(k), 0.01 * ((i * 7 + k * 3) % 10)};
      scene.triangles.push_back({a, a + Vec3d{0.8, 0.1, 0}, a + Vec3d{0.2, 0.8, 0.1}});
      scene.textures.emplace_back().material = 0;
    }
  }
  const auto looks = looks_of(scene, one_material());
  const TileCube cube = tile_cube(bounds_of(scene.triangles));
  constexpr std::uint64_t kFew = 150;
  const Branch root = branch_of(*looks, leaf_tree(*looks, cube.box, kFew), cube.unit, kFew);
  std::size_t met = 0;
  for (const Branch& a : root.below) {
    for (const Branch& b : root.below) {
      if (a.box.max[0] != b.box.min[0] || a.box.min[1] != b.box.min[1] || a.box.min[2] != b.box.min[2]) continue;
      CHECK(a.tile.leaf.triangles() < 400);  // of about 800
      CHECK(vertices_at(a.tile, 0, a.box.max[0]).size() > 10);
      CHECK((vertices_at(a.tile, 0, a.box.max[0]) == vertices_at(b.tile, 0, a.box.max[0])));
      ++met;
    }
  }
  CHECK(met > 0);
}

TEST_CASE("a ground at a round height is reduced as any other", "[quick][leaf]") {
  TexturedScene scene;
  for (int i = 0; i < 64; ++i)
    for (int k = 0; k < 64; ++k) scene.add({double(i - 32), double(k - 32), 0}, {1, 0, 0}, {0, 1, 0}, 0);
  const auto looks = looks_of(scene, one_material());
  const TileCube cube = tile_cube(bounds_of(scene.triangles));
  const LeafTree tree = leaf_tree(*looks, cube.box, kMost);
  CHECK(tree.octants.size() == 4);  // and not eight: none lies in a face
  std::uint64_t below = 0;
  for (const LeafTree& octant : tree.octants) below += octant.box.triangles;
  CHECK(below < scene.triangles.size() * 11 / 10);
}

TEST_CASE("what is missing in a picture counts by its size, and by its distance from what is left", "[quick][leaf]") {
  const std::vector<TriangleD> floor{{{{0, 0, 0}, {100, 0, 0}, {0, 100, 0}}}};
  const TriangleBvh left(floor);
  const auto plate = [](double side, double height) {
    return std::vector<TriangleD>{{{{1, 1, height}, {1 + side, 1, height}, {1 + side, 1 + side, height}}},
                                  {{{1, 1, height}, {1 + side, 1 + side, height}, {1, 1 + side, height}}}};
  };
  CHECK(missing_length({}, left) == 0);
  const double far = missing_length(plate(10, 50), left), near = missing_length(plate(10, 0.5), left);
  CHECK(far >= 5);
  CHECK(far <= 10.1);  // half of a square of side 14, at most, by a step of 1.4
  CHECK(near >= 0.35);
  CHECK(near <= 0.5);
  // Many small plates in a cube count as one large thing.
  std::vector<TriangleD> leaves;
  for (int i = 0; i < 1000; ++i) {
    for (TriangleD t : plate(0.4, 40)) {
      for (Vec3d& p : t) p = p + Vec3d{double(i % 10), double(i / 10 % 10), double(i / 100)};
      leaves.push_back(t);
    }
  }
  CHECK(missing_length(plate(0.4, 40), left) < 0.5);
  CHECK(missing_length(leaves, left) > 3);
}

TEST_CASE("tiles keep to their number of triangles and to their error", "[quick][leaf]") {
  const TexturedScene scene = ground(60, 0);
  const auto looks = looks_of(scene, one_material());
  const TileCube cube = tile_cube(bounds_of(scene.triangles));
  const Branch root = branch_of(*looks, leaf_tree(*looks, cube.box, kMost), cube.unit, kMost);
  for_each(root, [&](const Branch& branch) {
    CHECK(branch.tile.leaf.triangles() <= kMost * 5 / 4);  // cutting adds some
    if (!branch.below.empty()) CHECK(branch.tile.leaf.triangles() <= kMost);
    for (const Branch& below : branch.below) CHECK(branch.tile.error_world >= below.tile.error_world);
  });
  const std::vector<TriangleD> all = scene.triangles, coarsest = world_triangles(root.tile.leaf);
  const double there = surface_distance(coarsest, TriangleBvh(all)).at_least;
  const double back = surface_distance(all, TriangleBvh(coarsest)).at_least;
  CHECK(std::max(there, back) > 0.01);
  CHECK(std::max(there, back) <= root.tile.error_world);
}

TEST_CASE("parts vanish from tiles where they are small, and their width is the error", "[quick][leaf]") {
  const TexturedScene scene = ground(20, 300);
  const auto looks = looks_of(scene, one_material());
  const TileCube cube = tile_cube(bounds_of(scene.triangles));
  const SceneTile all = leaf_tile(*looks, cube.box, cube.unit);
  REQUIRE(all.leaf.triangles() == 1100);
  const SceneTile tiles[] = {all};
  const SceneTile coarse = tile_above(tiles, cube.box, 700, [&](std::uint32_t m) { return looks->key_of(m); });
  CHECK(coarse.leaf.triangles() <= 700);
  std::size_t boards = 0;
  for (const TriangleD& t : world_triangles(coarse.leaf)) boards += t[0][2] > 4;
  CHECK(boards < 300);              // they cost least
  CHECK(coarse.error_world < 0.5);  // and not the three units to the ground
}

TEST_CASE("joined leaves are what was cut", "[quick][leaf]") {
  const TexturedScene scene = ground(48, 5);
  const auto looks = looks_of(scene, one_material());
  const TileCube cube = tile_cube(bounds_of(scene.triangles));
  std::vector<SceneTile> below;
  std::uint64_t cut = 0;
  for (int k = 0; k < 8; ++k) {
    below.push_back(leaf_tile(*looks, octant_of(cube.box, k), cube.unit));
    cut += below.back().leaf.triangles();
  }
  const SceneTile joined = tile_above(below, cube.box, 10000, [&](std::uint32_t m) { return looks->key_of(m); });
  CHECK(joined.leaf.triangles() == cut);
  CHECK(joined.error_world == below.front().error_world);
  REQUIRE(joined.leaf.parts.size() == 1);
  // Vertices on the faces between octants are there once: those of the grid, of the boards, and where edges were cut.
  const auto& vertices = joined.leaf.parts.front().vertices;
  std::set<std::array<std::int32_t, 3>> places;
  for (const LeafVertex& v : vertices) places.insert(v.at);
  CHECK(places.size() == vertices.size());
}
