#include <algorithm>
#include <atomic>

#include "lib/check/tile_cover.h"
#include "tests/catch.h"
#include "tests/support/memory_scene.h"

namespace bp::test {

namespace {

IndexedMesh box_mesh(const Vec3d& lo, const Vec3d& hi) {
  Triangles soup;
  add_box(soup, lo, hi);
  IndexedMesh mesh;
  for (const TriangleD& t : soup) {
    const auto n = std::uint32_t(mesh.vertices.size());
    for (const Vec3d& p : t) mesh.vertices.push_back(p);
    mesh.triangles.push_back({n, n + 1, n + 2});
  }
  return mesh;
}

Bounds3d bounds(const Vec3d& lo, const Vec3d& hi) {
  return {lo, hi};
}

/// A tile with its content.
struct MeshTile {
  std::string place, uri;
  std::optional<IndexedMesh> content;
  std::optional<Bounds3d> cell;
  std::vector<std::size_t> children;
  std::optional<double> leaf_error = {};
};

/// A root of edge 16 around a bar along x, and two children that each hold half of it.
std::vector<MeshTile> good() {
  return {{"root", "r", box_mesh({1, 1, 1}, {15, 4, 4}), bounds({0, 0, 0}, {16, 16, 16}), {1, 2}},
          {"root.0", "a", box_mesh({1, 1, 1}, {8.5, 4, 4}), bounds({0, 0, 0}, {8, 8, 8}), {}},
          {"root.1", "b", box_mesh({7.5, 1, 1}, {15, 4, 4}), bounds({8, 0, 0}, {16, 8, 8}), {}}};
}

Triangles bar() {
  Triangles scene;
  add_box(scene, {2, 2, 2}, {14, 3, 3});
  return scene;
}

std::vector<std::string> texts(const CoverReport& report) {
  std::vector<std::string> lines;
  for (const TileFinding& f : report.findings) lines.push_back(f.text);
  return lines;
}

/// Returns the findings of `count` parts, sorted. No part knows the contents of the others' tiles.
std::vector<std::string> findings_of_parts(const std::vector<CoverTile>& tiles, const CoverContents& content,
                                           TriangleSource& scene, std::uint64_t count) {
  std::vector<std::string> lines;
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::vector<bool> mine = tiles_of({k, count}, tiles);
    std::vector<CoverTile> known = tiles;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      if (tiles[i].triangles && !mine[i]) known[i].triangles = 0;
    }
    const auto read = [&](std::size_t i) { return mine[i] ? content(i) : throw std::logic_error("another part's"); };
    for (std::string& line : texts(check_cover(known, read, scene, 1 << 20, {k, count})))
      lines.push_back(std::move(line));
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

/// Returns the findings, the same for contents checked together, one after the other, or in parts.
std::vector<std::string> findings(const std::vector<MeshTile>& tiles, const Triangles& scene = bar()) {
  std::vector<CoverTile> cover;
  for (const MeshTile& t : tiles) {
    cover.push_back({t.place, t.uri, {}, t.cell, t.children, t.leaf_error});
    if (t.content) cover.back().triangles = t.content->triangles.size();
  }
  std::atomic<int> reads{0};
  const auto read = [&](std::size_t i) { return ++reads, *tiles[i].content; };
  MemorySource source(scene, 5);
  std::vector<std::string> together = texts(check_cover(cover, read, source));
  const int contents = reads;
  CHECK(texts(check_cover(cover, read, source, 1)) == together);
  CHECK(reads == 2 * contents);
  for (std::uint64_t count = 2; count <= cover.size() + 1; ++count)
    CHECK(findings_of_parts(cover, read, source, count) == findings_of_parts(cover, read, source, 1));
  return together;
}

std::string only(const std::vector<std::string>& all) {
  return all.size() == 1 ? all[0] : std::to_string(all.size()) + " findings";
}

}  // namespace

TEST_CASE("tiles that overlap where their cells meet cover a scene together", "[quick][check][tileset]") {
  CHECK(findings(good()).empty());
  std::vector<MeshTile> tiles = good();
  tiles[0].content.reset();  // drawn by its children only
  CHECK(findings(tiles).empty());
  for (MeshTile& tile : tiles) tile.cell.reset();
  tiles[0].children = {1};
  tiles[1].content = box_mesh({1, 1, 1}, {15, 4, 4});
  CHECK(findings(tiles).empty());  // each for the whole scene
}

TEST_CASE("a tile that ends where its cell does leaves the scene uncovered", "[quick][check][tileset]") {
  std::vector<MeshTile> tiles = good();
  tiles[1].content = box_mesh({1, 1, 1}, {8, 4, 4});  // the scene touches its wall
  CHECK_THAT(only(findings(tiles)), ContainsSubstring("root.0: a is touched by 8 triangles"));
  tiles[1].content = box_mesh({1, 1, 1}, {6, 4, 4});
  CHECK_THAT(only(findings(tiles)), ContainsSubstring("root.0: a is touched by 8 triangles"));
  tiles[1].content = box_mesh({1, 5, 1}, {8.5, 6, 4});
  CHECK_THAT(only(findings(tiles)), ContainsSubstring("root.0: a leaves outside 10 triangles"));
}

TEST_CASE("a triangle without a corner in the cell is placed by what is in the cell", "[quick][check][tileset]") {
  Triangles scene{{Vec3d{2, 2, 2}, Vec3d{14, 2, 2}, Vec3d{14, 3, 2}}};
  std::vector<MeshTile> tiles = good();
  tiles[0].cell = bounds({-8, 0, 0}, {24, 32, 32});
  tiles[0].content.reset();
  tiles[1].cell = bounds({-8, 0, 0}, {8, 16, 16});
  tiles[2].cell = bounds({8, 0, 0}, {24, 16, 16});
  tiles[2].children = {3};
  tiles.push_back(tiles[2]);
  tiles[3].children.clear();
  CHECK(findings(tiles, scene).empty());
  scene[0] = {Vec3d{2, 2, 2}, Vec3d{14, 2, 2}, Vec3d{20, 2, 3}};  // leaves b
  CHECK(findings(tiles, scene).size() == 2);
  tiles = good();
  tiles[0] = {"root", "r", {}, bounds({0, 0, 0}, {32, 32, 32}), {1}};
  tiles[1] = {"root.0", "a", {}, bounds({0, 0, 0}, {16, 16, 16}), {2}};
  tiles[2] = {"root.0.0", "b", box_mesh({7.5, 1, 1}, {16.5, 4, 4}), bounds({8, 0, 0}, {16, 8, 8}), {}};
  tiles.push_back({"root.0.1", "c", box_mesh({-1, 1, 1}, {8.5, 4, 4}), bounds({0, 0, 0}, {8, 8, 8}), {}});
  tiles.push_back({"root.1", "d", box_mesh({15.5, 1, 1}, {31, 4, 4}), bounds({16, 0, 0}, {32, 16, 16}), {}});
  tiles[1].children = {2, 3};
  tiles[0].children = {1, 4};
  scene[0] = {Vec3d{2, 2, 2}, Vec3d{30, 2, 2}, Vec3d{30, 3, 2}};  // no corner in the cell of b
  CHECK(findings(tiles, scene).empty());
  tiles[2].content = box_mesh({7.5, 5, 1}, {16.5, 6, 4});
  CHECK_THAT(only(findings(tiles, scene)), ContainsSubstring("root.0.0: b leaves outside 1 triangle of the scene"));
}

TEST_CASE("tiles far from the origin are decided", "[quick][check][tileset]") {
  const Vec3d far{0x1p+27, -0x1p+25, 0x1p+26};  // doubles step by 3e-8 there, which is 2e-9 of a cell
  const auto moved = [&](const Vec3d& p) { return Vec3d{p[0] + far[0], p[1] + far[1], p[2] + far[2]}; };
  const auto cell = [&](const Vec3d& lo, const Vec3d& hi) { return bounds(moved(lo), moved(hi)); };
  const auto box = [&](const Vec3d& lo, const Vec3d& hi) { return box_mesh(moved(lo), moved(hi)); };
  std::vector<MeshTile> tiles{{"root", "r", {}, cell({0, 0, 0}, {32, 32, 32}), {1, 4}},
                              {"root.0", "a", {}, cell({0, 0, 0}, {16, 16, 16}), {2, 3}},
                              {"root.0.0", "b", box({7.5, 1, 1}, {16.5, 4, 4}), cell({8, 0, 0}, {16, 8, 8}), {}},
                              {"root.0.1", "c", box({-1, 1, 1}, {8.5, 4, 4}), cell({0, 0, 0}, {8, 8, 8}), {}},
                              {"root.1", "d", box({15.5, 1, 1}, {31, 4, 4}), cell({16, 0, 0}, {32, 16, 16}), {}}};
  const Triangles scene{{moved({2, 2, 2}), moved({30, 2, 2}), moved({30, 3, 2})}};  // no corner in the cell of b
  CHECK(findings(tiles, scene).empty());
  tiles[2].content = box({7.5, 5, 1}, {16.5, 6, 4});
  CHECK_THAT(only(findings(tiles, scene)), ContainsSubstring("root.0.0: b leaves outside 1 triangle of the scene"));
}

TEST_CASE("a face that meets a triangle beyond the cell does no harm, a near one does", "[quick][check][tileset]") {
  const Triangles scene{{Vec3d{2, 2, 2}, Vec3d{14, 2, 2}, Vec3d{14, 3, 2}}};
  std::vector<MeshTile> tiles = good();
  const double wall = GENERATE(8.001, 8.5, 7.999);
  tiles[1].content = box_mesh({1, 1, 1}, {wall, 4, 4});
  CHECK(findings(tiles, scene).empty() == (wall > 8));
}

TEST_CASE("a face that meets a triangle beyond an edge of the cell does no harm", "[quick][check][tileset]") {
  std::vector<MeshTile> tiles = good();
  tiles[0].content.reset();
  tiles[0].children = {1, 2, 3, 4};
  tiles[2].content = box_mesh({7.5, 1, 1}, {15, 8.5, 4});
  tiles.push_back({"root.2", "c", box_mesh({1, 7.5, 1}, {8.5, 15, 4}), bounds({0, 8, 0}, {8, 16, 8}), {}});
  tiles.push_back({"root.3", "d", box_mesh({7.5, 7.5, 1}, {15, 15, 4}), bounds({8, 8, 0}, {16, 16, 8}), {}});
  const Triangles floor{{Vec3d{2, 2, 2.5}, Vec3d{14, 2, 2.5}, Vec3d{2, 14, 2.5}},
                        {Vec3d{14, 14, 2.5}, Vec3d{14, 2, 2.5}, Vec3d{2, 14, 2.5}}};
  const double beyond = GENERATE(0.4, 0.001, -0.001);
  // Ends at the plane x + y = 16 + beyond: the bounds of its section with the floor hold the cell's edge.
  IndexedMesh& a = *(tiles[1].content = box_mesh({1, 1, 1}, {9, 7 + beyond, 4}));
  for (Vec3d& p : a.vertices) {
    if (p[1] > 1 && p[0] == 1) p[1] = 15 + beyond;
  }
  CHECK(findings(tiles, floor).empty() == (beyond > 0));
}

TEST_CASE("missing and misplaced tiles are found", "[quick][check][tileset]") {
  std::vector<MeshTile> tiles = good();
  tiles[0].children = {1};
  CHECK_THAT(only(findings(tiles)), ContainsSubstring("root: r has no child for 10 triangles"));
  tiles = good();
  tiles[2].cell->max[0] = 15;
  CHECK_THAT(findings(tiles)[0], ContainsSubstring("root.1: its cell is neither"));
  tiles = good();
  tiles.push_back(tiles[2]);
  tiles[0].children = {1, 2, 3};
  CHECK_THAT(findings(tiles)[0], ContainsSubstring("root.1: another child of its parent has the same cell"));
  tiles = good();
  tiles[2].content.reset();
  CHECK_THAT(only(findings(tiles)), ContainsSubstring("root.1: b draws nothing for 10 triangles"));
  tiles = good();
  std::swap(tiles[1].content->triangles[0][0], tiles[1].content->triangles[0][1]);
  CHECK_THAT(findings(tiles)[0], ContainsSubstring("root.0: a is no closed"));
  Triangles scene = bar();
  add_box(scene, {-3, 2, 2}, {-2, 3, 3});
  CHECK_THAT(only(findings(good(), scene)), ContainsSubstring("root: 12 triangles of the scene leave its cell"));
}

TEST_CASE("a leaf must show the scene in its cell, and nothing else", "[quick][check][tileset]") {
  Triangles scene;
  add_box(scene, {2, 2, 2}, {6, 3, 3});
  const auto with_leaf = [&](const Triangles& shown) {
    std::vector<MeshTile> tiles{{"root", "r", box_mesh({1, 1, 1}, {15, 4, 4}), bounds({0, 0, 0}, {16, 16, 16}), {1}},
                                {"root.0", "a", IndexedMesh(), bounds({0, 0, 0}, {16, 16, 16}), {}}};
    tiles[1].leaf_error = 1e-5;
    for (const TriangleD& t : shown) {
      const auto n = std::uint32_t(tiles[1].content->vertices.size());
      for (const Vec3d& p : t) tiles[1].content->vertices.push_back(p);
      tiles[1].content->triangles.push_back({n, n + 1, n + 2});
    }
    return tiles;
  };
  CHECK(findings(with_leaf(scene), scene).empty());
  Triangles moved = scene;
  for (Vec3d& p : moved[0]) p[2] += 5e-6;
  CHECK(findings(with_leaf(moved), scene).empty());
  for (Vec3d& p : moved[0]) p = {p[0] + 0.01, p[1] + 0.01, p[2] + 0.01};
  const std::vector<std::string> astray = findings(with_leaf(moved), scene);
  REQUIRE(astray.size() == 2);
  CHECK_THAT(astray[0], ContainsSubstring("root.0: a does not show 1 triangle of"));
  CHECK_THAT(astray[1], ContainsSubstring("root.0: a shows 1 triangle that the scene does not have"));
  Triangles more = scene;
  more.push_back({Vec3d{2, 5, 5}, {3, 5, 5}, {3, 6, 5}});
  CHECK_THAT(only(findings(with_leaf(more), scene)),
             ContainsSubstring("root.0: a shows 1 triangle that the scene does not have"));
  Triangles turned = scene;
  std::swap(turned[0][1], turned[0][2]);
  CHECK(findings(with_leaf(turned), scene).size() == 2);
  Triangles both = scene;  // seen from both sides
  both.push_back(turned[0]);
  CHECK(findings(with_leaf(both), both).empty());
  CHECK_THAT(only(findings(with_leaf(scene), both)), ContainsSubstring("root.0: a does not show 1 triangle of"));
}

TEST_CASE("a leaf without content stands where the scene has nothing", "[quick][check][tileset]") {
  Triangles scene;
  add_box(scene, {2, 2, 2}, {7, 3, 3});
  scene.push_back({Vec3d{7, 2, 2}, {8, 2, 2}, {8, 3, 2}});  // ends in the face of the other cell
  IndexedMesh shown;
  for (const TriangleD& t : scene) {
    const auto n = std::uint32_t(shown.vertices.size());
    shown.vertices.insert(shown.vertices.end(), t.begin(), t.end());
    shown.triangles.push_back({n, n + 1, n + 2});
  }
  const Bounds3d a = bounds({0, 0, 0}, {8, 8, 8}), b = bounds({8, 0, 0}, {16, 8, 8});
  std::vector<MeshTile> tiles{{"root", "r", {}, bounds({0, 0, 0}, {16, 16, 16}), {1, 2}},
                              {"root.0", "a", box_mesh({1, 1, 1}, {9, 4, 4}), a, {3}},
                              {"root.1", "b", box_mesh({7, 1, 1}, {9, 4, 4}), b, {4}},
                              {"root.0.0", "c", shown, a, {}, 1e-5},
                              {"root.1.0", "", {}, b, {}, 1e-5}};
  CHECK(findings(tiles, scene).empty());
  tiles[4].leaf_error.reset();
  CHECK_THAT(only(findings(tiles, scene)), ContainsSubstring("root.1.0:  draws nothing for"));
  tiles[4].leaf_error = 1;
  CHECK_THAT(findings(tiles, scene)[0], ContainsSubstring("root.1.0:  is compared to within 1; rounding"));
  tiles[4].leaf_error = 1e-5;
  Triangles more = scene;
  more.push_back({Vec3d{8.2, 2, 2}, {8.4, 2, 2}, {8.2, 2.2, 2}});
  CHECK_THAT(only(findings(tiles, more)), ContainsSubstring("root.1.0:  draws nothing for 1 triangle of the scene"));
}

TEST_CASE("what rounding of a leaf is does not depend on its cell", "[quick][check][tileset]") {
  const Triangles scene{{Vec3d{1, 1, 1}, {9, 1, 1}, {1, 9, 1}}, {Vec3d{1, 1, 5}, {9, 1, 5}, {1, 9, 5}}};
  const double error = GENERATE(60.0, 1e-3, 1e-6);
  IndexedMesh other;
  other.vertices = {{3, 1, 20}, {4, 1, 20}, {3, 2, 20}};
  other.triangles = {{0, 1, 2}};
  const double far = 0x1p27;
  const Bounds3d cell = bounds({-far, -far, -far}, {far, far, far});
  const std::vector<MeshTile> tiles{{"root", "r", box_mesh({-50, -50, -50}, {50, 50, 50}), cell, {1}},
                                    {"root.0", "a", other, cell, {}, error}};
  CHECK_THAT(only(findings(tiles, scene)),  // 1e-6: in doubles of such a cell
             ContainsSubstring("root.0: a is compared to within"));
}

TEST_CASE("a leaf with too large an error is refused before it is read", "[quick][check][tileset]") {
  MemorySource scene(bar(), 5);
  const std::vector<CoverTile> tiles{{"root", "r", 12, bounds({0, 0, 0}, {16, 16, 16}), {1}},
                                     {"root.0", "a", 1, bounds({0, 0, 0}, {16, 16, 16}), {}, 0.1}};
  const auto content = [](std::size_t i) {
    CHECK(i == 0);
    return box_mesh({1, 1, 1}, {15, 4, 4});
  };
  const CoverReport report = check_cover(tiles, content, scene);
  REQUIRE(report.findings.size() == 1);
  CHECK_THAT(report.findings[0].text, ContainsSubstring("root.0: a is compared to within 0.1; rounding"));
}

TEST_CASE("a thin triangle of the scene must be near the leaf", "[quick][check][tileset]") {
  const double error = 1e-5;
  const TriangleD wide{Vec3d{1, 1, 1}, {9, 1, 1}, {1, 9, 1}};
  const auto found = [&](const TriangleD& thin) {
    IndexedMesh leaf;
    leaf.vertices.assign(wide.begin(), wide.end());
    leaf.triangles = {{0, 1, 2}};
    return findings({{"root", "r", box_mesh({0, 0, 0}, {15, 15, 15}), bounds({0, 0, 0}, {16, 16, 16}), {1}},
                     {"root.0", "a", leaf, bounds({0, 0, 0}, {16, 16, 16}), {}, error}},
                    {wide, thin});
  };
  CHECK(found({Vec3d{1, 1, 1}, {9, 1, 1}, {5, 1 - error, 1}}).empty());
  CHECK(found({Vec3d{1, 1, 1}, {9, 1, 1}, {5, 1, 1 + error}}).empty());
  CHECK_THAT(only(found({Vec3d{1, 1, 3}, {9, 1, 3}, {5, 1 - error, 3}})),
             ContainsSubstring("root.0: a cannot be decided for 1 triangle of the scene"));
  CHECK(found({Vec3d{1, 1, 3}, {9, 1, 3}, {5, 1, 3}}).empty());  // draws nothing
}

TEST_CASE("a triangle that rounding flattens may be missing, a wider one may not", "[quick][check][tileset]") {
  const TriangleD wide{Vec3d{1, 1, 1}, {9, 1, 1}, {1, 9, 1}};
  const auto report = [&](double height, double error) {
    MemorySource scene({wide, {Vec3d{1, 1, 3}, {9, 1, 3}, {5, 1 - height, 3}}}, 5);
    const auto content = [&](std::size_t i) {
      IndexedMesh leaf;
      leaf.vertices.assign(wide.begin(), wide.end());
      leaf.triangles = {{0, 1, 2}};
      return i == 0 ? box_mesh({0, 0, 0}, {15, 15, 15}) : leaf;
    };
    return check_cover({{"root", "r", 12, bounds({0, 0, 0}, {16, 16, 16}), {1}},
                        {"root.0", "a", 1, bounds({0, 0, 0}, {16, 16, 16}), {}, error}},
                       content, scene);
  };
  CHECK(report(1e-6, 1e-6).findings.empty());
  CHECK(report(1e-6, 1e-6).flat == 1);
  REQUIRE(report(3e-6, 1e-6).findings.size() == 1);
  CHECK(report(3e-6, 1e-6).findings[0].answer == Answer::undecided);
  CHECK(report(1e-5, 2e-5).findings.size() == 1);  // of what the file calls rounding, the scene is too small
}

TEST_CASE("an octant that a triangle just touches needs no leaf", "[quick][check][tileset]") {
  const double beyond = GENERATE(0.0, 1e-6, 1e-3);
  const Triangles scene{{Vec3d{8 + beyond, 1, 1}, {8 + beyond, 7, 1}, {1, 1, 1}}};
  IndexedMesh leaf;
  leaf.vertices = {{8, 1, 1}, {8, 7, 1}, {1, 1, 1}};
  leaf.triangles = {{0, 1, 2}};
  std::vector<MeshTile> tiles{{"root", "r", box_mesh({0, 0, 0}, {15, 15, 15}), bounds({0, 0, 0}, {16, 16, 16}), {1}},
                              {"root.0", "a", leaf, bounds({0, 0, 0}, {8, 8, 8}), {}, 1e-5}};
  const std::vector<std::string> found = findings(tiles, scene);
  CHECK(found.empty() == (beyond < 1e-5));
  tiles[1].leaf_error.reset();  // a proxy
  tiles[1].content = box_mesh({0.5, 0.5, 0.5}, {10, 8, 2});
  CHECK_THAT(only(findings(tiles, scene)), ContainsSubstring("root: r has no child for 1 triangle of the scene"));
}

TEST_CASE("a leaf may cut the scene's triangles, and leaves no hole in them", "[quick][check][tileset]") {
  const TriangleD whole{Vec3d{1, 1, 1}, {15, 1, 3}, {1, 15, 5}};
  const auto at = [&](double a, double b) {
    Vec3d p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = whole[0][i] + a * (whole[1][i] - whole[0][i]) + b * (whole[2][i] - whole[0][i]);
    return p;
  };
  constexpr int kSteps = 60;
  std::vector<MeshTile> tiles{{"root", "r", box_mesh({0, 0, 0}, {16, 16, 16}), bounds({0, 0, 0}, {16, 16, 16}), {1}},
                              {"root.0", "a", IndexedMesh(), bounds({0, 0, 0}, {16, 16, 16}), {}}};
  tiles[1].leaf_error = 1e-6;
  IndexedMesh& leaf = *tiles[1].content;
  const auto add = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const auto n = std::uint32_t(leaf.vertices.size());
    leaf.vertices.insert(leaf.vertices.end(), {a, b, c});
    leaf.triangles.push_back({n, n + 1, n + 2});
  };
  for (int i = 0; i < kSteps; ++i) {
    for (int k = 0; i + k < kSteps; ++k) {
      const double a = double(i) / kSteps, b = double(k) / kSteps, d = 1.0 / kSteps;
      add(at(a, b), at(a + d, b), at(a, b + d));
      if (i + k + 1 < kSteps) add(at(a + d, b), at(a + d, b + d), at(a, b + d));
    }
  }
  CHECK(findings(tiles, {whole}).empty());
  leaf.triangles[GENERATE(57, 123, 301)] = leaf.triangles[3];  // one is there twice, and another is missing
  CHECK_THAT(only(findings(tiles, {whole})), ContainsSubstring("root.0: a does not show 1 triangle of"));
}

TEST_CASE("a triangle just beyond a face belongs to the neighbour's leaf", "[quick][check][tileset]") {
  const double x = GENERATE(0.0, 0x1p-60, -0x1p-60);  // gone relative to a corner of the cell
  const Triangles scene{{Vec3d{x, 1, 1}, {x, 6, 1}, {x, 1, 6}}};
  IndexedMesh leaf;
  leaf.vertices.assign(scene[0].begin(), scene[0].end());
  leaf.triangles = {{0, 1, 2}};
  std::vector<MeshTile> tiles{
      {"root", "r", box_mesh({-7, 0.5, 0.5}, {7, 7, 7}), bounds({-8, 0, 0}, {8, 16, 16}), {1, 2}},
      {"root.0", "a", x <= 0 ? leaf : IndexedMesh(), bounds({-8, 0, 0}, {0, 8, 8}), {}, 1e-6},
      {"root.1", "b", x >= 0 ? leaf : IndexedMesh(), bounds({0, 0, 0}, {8, 8, 8}), {}, 1e-6}};
  CHECK(findings(tiles, scene).empty());
  tiles[x <= 0 ? 1 : 2].content = IndexedMesh();
  CHECK(findings(tiles, scene).size() == 1);
}

}  // namespace bp::test
