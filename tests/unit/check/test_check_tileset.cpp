#include <cmath>

#include "lib/check/check_tileset.h"
#include "tests/catch.h"

using namespace bp;

namespace {

TileBox cube(const Vec3d& centre, double half) {
  return {centre, {Vec3d{half, 0, 0}, Vec3d{0, half, 0}, Vec3d{0, 0, half}}};
}

Transform moved(const Vec3d& by) {
  Transform m = kNoTransform;
  for (std::size_t i = 0; i < 3; ++i) m[12 + i] = by[i];
  return m;
}

/// Root with a content, and two children with contents, one of them moved.
Tileset good() {
  Tileset t;
  t.geometric_error = 100;
  t.root.volume.box = cube({0, 0, 0}, 10);
  t.root.transform = moved({1e6, 5e6, 3});
  t.root.geometric_error = 8;
  t.root.refine = "REPLACE";
  t.root.uri = "root.glb";
  Tile child;
  child.volume.box = cube({-5, 0, 0}, 5);
  child.geometric_error = 2;
  child.uri = "a.glb";
  t.root.children.push_back(child);
  child.transform = moved({10, 0, 0});
  child.geometric_error = 0;
  child.uri = "b.glb";
  t.root.children.push_back(child);
  return t;
}

TileContent content_of(std::vector<Vec3d> vertices) {
  TileContent content;
  content.found = true;
  content.vertices = std::move(vertices);
  return content;
}

std::vector<TileContent> contents() {
  return {content_of({{10, 10, -10}, {0, 0, 0}}), content_of({{-10, 5, 5}}), content_of({{-0.5, -5, 5}})};
}

/// Returns the findings; undecided ones begin with "? ".
std::vector<std::string> findings(const Tileset& t, const std::vector<TileContent>& c) {
  std::size_t next = 0;
  std::vector<std::string> lines;
  for (const TileFinding& found : check_tileset(t, [&](const Tile&) { return c.at(next++); }))
    lines.push_back((found.answer == Answer::undecided ? "? " : "") + found.text);
  return lines;
}

/// Returns the only finding.
std::string finding(const Tileset& t, const std::vector<TileContent>& c = contents()) {
  const std::vector<std::string> all = findings(t, c);
  return all.size() == 1 ? all[0] : std::to_string(all.size()) + " findings";
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a sound tileset has no findings", "[quick][check][tileset]") {
  CHECK(findings(good(), contents()).empty());
}

TEST_CASE("each thing that may be wrong with a tileset is found where it is", "[quick][check][tileset]") {
  Tileset t = good();
  t.version = "1.0";
  CHECK(findings(t, contents()).empty());
  t.version = "2.0";
  CHECK(says(finding(t), "? asset.version"));
  t = good();
  t.not_understood = {"root: wobble"};
  CHECK(finding(t) == "? root: wobble");
  t = good();
  t.geometric_error = 7;
  CHECK(says(finding(t), "tileset: geometricError 7 is below the root's 8"));
  t = good();
  t.root.children[1].geometric_error = 9;
  CHECK(says(finding(t), "root.children[1]: geometricError 9 is above its parent's 8"));
  t = good();
  t.root.refine.clear();
  CHECK(says(finding(t), "refine"));
  t = good();
  t.root.children[0].refine = "replace";
  CHECK(says(finding(t), "root.children[0]: refine is \"replace\""));
  t = good();
  t.root.children[0].geometric_error = -1;
  CHECK(says(finding(t), "no length"));
  t = good();
  t.root.children[1].transform = moved({10.001, 0, 0});
  CHECK(says(finding(t), "root.children[1]: its volume reaches out of its parent's"));
  std::vector<TileContent> c = contents();
  c[2].vertices.push_back({-0.5, -5.001, 5});
  CHECK(says(finding(good(), c), "root.children[1]: 1 of 2 vertices of b.glb lie outside"));
  c = contents();
  c[1] = {};
  c[1].complaint = "a.glb: no such file";
  CHECK(says(finding(good(), c), "root.children[0]: content a.glb: a.glb: no such file"));
  c[1].answer = Answer::undecided;
  CHECK(says(finding(good(), c), "? root.children[0]: content a.glb"));
  c = contents();
  c[1].not_understood = {"wobble"};
  CHECK(finding(good(), c) == "? root.children[0]: a.glb: wobble");
  t = good();
  t.placement.emplace().off = 0.0009;
  CHECK(findings(t, contents()).empty());
  t.placement->off = 0.0011;
  CHECK(says(finding(t), "root: its transform is 0.0011 m off the place"));
  t.placement->off = NAN;
  CHECK(says(finding(t), "root: its transform is nan m off the place"));
  t = good();
  t.root.uri.clear();
  t.root.children.resize(1);
  t.root.children[0].uri.clear();
  CHECK(says(finding(t, {}), "tileset: has no content"));
}

TEST_CASE("errors count as long as the transforms make them", "[quick][check][tileset]") {
  Tileset t = good();
  t.root.children.pop_back();
  t.root.children[0].geometric_error = 15;
  const double half = 0.5;
  t.root.children[0].transform = {half, 0, 0, 0, 0, half, 0, 0, 0, 0, half, 0, 0, 0, 0, 1};
  CHECK(findings(t, contents()).empty());
  t.root.children[0].geometric_error = 17;
  CHECK(says(finding(t), "root.children[0]: geometricError 8.5 is above its parent's 8"));
}

TEST_CASE("volumes hold what they hold, to the last bit", "[quick][check][tileset]") {
  const auto holds = [](const Tile& tile, const Vec3d& p) {
    Tileset t = good();
    t.root.children.clear();
    t.root.volume = tile.volume;
    return findings(t, {content_of({p})}).empty();
  };
  Tile tile;
  const double third = 1.0 / 3;
  tile.volume.box = TileBox{{third, 0, 0}, {Vec3d{third, third, 0}, Vec3d{-third, third, 0}, Vec3d{0, 0, 7}}};
  CHECK(holds(tile, {third, 2 * third, -7}));  // a corner, exactly
  CHECK(!holds(tile, {third, std::nextafter(2 * third, 1), -7}));
  CHECK(!holds(tile, {third, 0, std::nextafter(7, 8)}));
  CHECK(!holds(tile, {third, 0, 1e200}));
  tile.volume.box = TileBox{{0, 0, 0}, {Vec3d{2, 0, 0}, Vec3d{0, 0, 0}, Vec3d{0, 0, 0}}};  // a segment
  CHECK(holds(tile, {-2, 0, 0}));
  CHECK(!holds(tile, {std::nextafter(2, 3), 0, 0}));
  CHECK(!holds(tile, {1, 0, 1e-50}));
  tile.volume = {};
  tile.volume.sphere = TileSphere{{1, 1, 1}, 13};
  CHECK(holds(tile, {4, 5, 13}));  // 3, 4, 12: the surface
  CHECK(!holds(tile, {4, 5, std::nextafter(13, 14)}));
  tile.volume.box = cube({1, 1, 1}, 2);
  CHECK(!holds(tile, {4, 5, 13}));
}

TEST_CASE("a child's volume lies in its parent's, whatever their kinds", "[quick][check][tileset]") {
  const auto holds = [](const TileVolume& outer, const TileVolume& inner, double x) {
    Tileset t = good();
    t.root.children.pop_back();
    t.root.volume = outer;
    t.root.children[0].volume = inner;
    t.root.children[0].transform = moved({x, 0, 0});
    return findings(t, {content_of({Vec3d{}}), content_of({Vec3d{}})}).empty();
  };
  const double more = std::nextafter(2.0, 3.0);
  const TileVolume box{cube({}, 5), {}}, ball{{}, TileSphere{{}, 5}}, small_box{cube({}, 3), {}},
      small_ball{{}, TileSphere{{}, 3}};
  CHECK(holds(box, small_box, 2));
  CHECK(!holds(box, small_box, more));
  CHECK(holds(box, small_ball, -2));
  CHECK(!holds(box, small_ball, -more));
  CHECK(holds(ball, small_ball, 2));
  CHECK(!holds(ball, small_ball, more));
  CHECK(!holds(ball, small_box, 0));  // its corners are 5.2 away
  CHECK(holds(ball, {cube({}, 2), {}}, 1));
  CHECK(holds({cube({}, 6), {}}, ball, 0));
  CHECK(!holds({cube({}, 4.5), {}}, ball, 0));
}

TEST_CASE("spheres of tiles that transforms make no spheres are not decided", "[quick][check][tileset]") {
  Tileset t = good();
  t.root.children.clear();
  t.root.volume = {{}, TileSphere{{}, 100}};
  const std::vector<TileContent> c{content_of({{1, 2, 3}})};
  CHECK(findings(t, c).empty());
  t.root.transform = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 7, 8, 9, 1};
  t.geometric_error = 16;
  CHECK(findings(t, c).empty());
  t.root.transform[10] = 3;
  t.geometric_error = 24;
  CHECK(says(finding(t, c), "? root: has a sphere"));
}

TEST_CASE("a file cannot call any content a piece of the scene", "[quick][check][tileset]") {
  Tileset t = good();
  t.root.cell = Bounds3d{{0, 0, 0}, {16, 8, 8}};
  Tile& leaf = t.root.children[1];
  leaf.is_leaf = true;
  leaf.cell = Bounds3d{{0, 0, 0}, {8, 8, 8}};
  leaf.geometric_error = 0x1p-18;
  CHECK(findings(t, contents()).empty());
  leaf.geometric_error = 0x1.1p-18;
  CHECK(says(finding(t), "root.children[1]: extras.leaf is true, but its geometricError"));
  CHECK(says(finding(t), "is more than rounding"));
  leaf.geometric_error = 0;
  t.root.geometric_error = t.root.children[0].geometric_error = 0;
  CHECK(says(finding(t), "root.children[1]: extras.leaf is true, but its geometricError 0 is not below"));
  t.root.geometric_error = 1;
  t.root.uri.clear();  // draws nothing
  std::vector<TileContent> c = contents();
  c.erase(c.begin());
  CHECK(says(finding(t, c), "but no proven tile lies above it"));
  t.root.uri = "root.glb";
  t.root.is_leaf = true;
  CHECK(findings(t, contents()).size() == 2);
  t.root.is_leaf = false;
  Tile below = leaf;
  below.is_leaf = false;
  below.uri.clear();
  leaf.children.push_back(below);
  leaf.children[0].transform = kNoTransform;
  CHECK(says(finding(t), "but it has children"));
}

TEST_CASE("boxes may be turned, skewed or flat", "[quick][check][tileset]") {
  Tileset t = good();
  t.root.children.clear();
  std::vector<TileContent> c{content_of({{3, 3, 0}, {-3, 3, 1}})};
  t.root.volume.box = TileBox{{0, 3, 0}, {Vec3d{3, 3, 0}, Vec3d{-3, 3, 0}, Vec3d{0, 0, 1}}};  // a diamond
  CHECK(findings(t, c).empty());
  c[0].vertices.push_back({3.1, 0, 0});
  CHECK(findings(t, c).size() == 1);
  c[0].vertices = {{3, 3, 0}};
  t.root.volume.box->axes[2] = {0, 0, 0};
  CHECK(findings(t, c).empty());
  c[0].vertices = {{3, 3, 0.5}};
  CHECK(findings(t, c).size() == 1);
}

TEST_CASE("transforms compose from the root down", "[quick][check][tileset]") {
  const Tileset t = good();
  std::vector<std::string> paths;
  for_each_tile(t, [&](const Tile& tile, const std::string& path, const Transform& m) {
    paths.push_back(path);
    if (tile.uri == "b.glb") CHECK(transformed(m, {-5, 0, 1}) == Vec3d{1e6 + 5, 5e6, 4});
  });
  CHECK(paths == std::vector<std::string>{"root", "root.children[0]", "root.children[1]"});
  const Transform turn{0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // x to y
  CHECK(transformed(product(moved({1, 0, 0}), turn), {2, 0, 0}) == Vec3d{1, 2, 0});
}

TEST_CASE("the box around bounds holds them", "[quick][check][tileset]") {
  Bounds3d bounds;
  bounds.add({-1, 2, 3});
  bounds.add({0.1, 2, 7});
  const TileBox box = box_of(bounds);
  CHECK(box.corners()[0][1] == 2);
  CHECK(box.corners()[7][2] >= 7);
  CHECK(box.corners()[0][2] <= 3);
}
