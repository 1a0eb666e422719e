#include <map>
#include <set>

#include "lib/check/check_proxy.h"
#include "lib/check/detail/surface.h"
#include "lib/check/tile_cover.h"
#include "lib/core/parallel.h"
#include "lib/levels/tiles/tile_pyramid.h"
#include "lib/levels/voxel_choice.h"
#include "lib/pass/mesh/surface_around.h"
#include "tests/catch.h"
#include "tests/support/each_member.h"
#include "tests/support/voxelized.h"

namespace bp::test {

namespace {

constexpr std::int32_t kEdge = 128;
const Cells kTileCells{kEdge};

/// Boxes along a diagonal, some of them across the borders of cells, and a plate through all.
Triangles scene() {
  Triangles all;
  for (int i = 0; i < 8; ++i) add_box(all, {20.0 * i, 12.0 * i, 3}, {20.0 * i + 13, 12.0 * i + 9, 30.0 + i});
  add_box(all, {0, 0, 0}, {160, 100, 2});
  return all;
}

struct Made {
  LatticeMesh mesh;
  TileMeasures measures;
};
using Level = std::map<CellCoord, Made>;

TilePyramid pyramid(const Triangles& scene, Backends& backends, const Cells& cells = kTileCells) {
  Voxelized solid = voxelized(scene, 1, cells.edge_vox);
  PyramidOptions options;
  options.cells = cells;
  options.context.make_shelf = memory_shelves();
  return TilePyramid(solid.header, std::move(solid.shelf), backends, options);
}

/// Makes the tiles of the present level, several at the same time.
Level make(TilePyramid& pyramid, TileParams params, double scale = 0) {
  params.scale_world = scale > 0 ? scale : 2 * pyramid.header().frame.voxel;
  pyramid.add_level(params);
  const TileJobs jobs(pyramid.tasks(), pyramid.context());
  std::vector<std::optional<Made>> tiles(jobs.count());
  parallel_for(std::int64_t(jobs.count()), [&](std::int64_t i) {
    TileMeasures measures;
    std::optional<LatticeMesh> mesh = jobs.make(std::size_t(i), pyramid.context(), measures);
    if (mesh) tiles[std::size_t(i)] = Made{*std::move(mesh), measures};
  });
  Level level;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (tiles[i]) level[jobs.cell(i)] = *std::move(tiles[i]);
  }
  pyramid.drop_tasks();
  return level;
}

void enclose(const TriangleBvh& scene, TileParams& params) {
  params.scene = &scene;
  params.enclose = Enclose::scene;
}

double volume_of(const Level& level) {
  double volume = 0;
  for (const auto& [cell, made] : level) volume += made.measures.volume;
  return volume;
}

/// With a slit in its roof, and a post in it, 26 below the roof; and a plate over several cells.
Triangles room(double x, double slit) {
  Triangles all;
  add_box(all, {0, 0, 0}, {300, 60, 4});
  add_box(all, {x, 0, 0}, {x + 4, 60, 60});
  add_box(all, {x + 56, 0, 0}, {x + 60, 60, 60});
  add_box(all, {x, 0, 0}, {x + 60, 4, 60});
  add_box(all, {x, 56, 0}, {x + 60, 60, 60});
  add_box(all, {x, 0, 56}, {x + 28, 60, 60});
  add_box(all, {x + 28 + slit, 0, 56}, {x + 60, 60, 60});
  add_box(all, {x + 28, 28, 0}, {x + 32, 32, 30});
  return all;
}

constexpr double kAcross = 94;  ///< x of a room that a border of cells halves

std::size_t tiles_around(const Level& level, const Vec3d& p) {
  return std::size_t(std::count_if(level.begin(), level.end(), [&](const auto& tile) {
    CheckReport ignored;
    const WeldedMesh mesh = weld(indexed(tile.second.mesh), 0, ignored);
    return Surface(mesh).winding(p) > 0;
  }));
}

double largest_error(const Level& level) {
  double largest = 0;
  for (const auto& [cell, made] : level) largest = std::max(largest, made.measures.error_world);
  return largest;
}

bool in_one_cell(const TilePyramid& levels, const Cells& cells) {
  return cells_spanned(cells, levels.header().bricks).count() == 1;
}

Backends cpu_backends() {
  Backends all;
  for (int i = 0; i < 2; ++i) all.push_back(std::make_unique<CpuBackend>());
  return all;
}

}  // namespace

TEST_CASE("the tiles of all levels cover the scene together", "[quick][pass][lod]") {
  Backends backends = cpu_backends();
  const Cells cells{GENERATE(kBrickEdge, kEdge)};
  const Triangles triangles = scene();
  const TriangleBvh tree(triangles);
  TilePyramid levels = pyramid(triangles, backends, cells);
  REQUIRE_FALSE(in_one_cell(levels, cells));
  std::vector<CoverTile> tiles(1);
  std::vector<IndexedMesh> contents(1);
  std::map<CellCoord, std::size_t> below;
  TileParams params;
  params.faces = GENERATE(0, 100);
  if (GENERATE(false, true)) enclose(tree, params);
  for (int level = 0; !in_one_cell(levels, cells); ++level, levels.reduce()) {
    std::map<CellCoord, std::size_t> numbers;
    for (const auto& [cell, made] : make(levels, params)) {
      numbers[cell] = tiles.size();
      tiles.push_back({std::to_string(level) + " " + std::to_string(cell.x),
                       "",
                       made.mesh.triangles.size(),
                       bounds_of(cells.box(cell), levels.header().frame),
                       {}});
      contents.push_back(indexed(made.mesh));
      CHECK(made.measures.faces == made.mesh.triangles.size());
    }
    for (const auto& [cell, number] : below) tiles[numbers.at(parent_of(cell))].children.push_back(number);
    below = numbers;
    REQUIRE(level < 4);
  }
  tiles[0].cell = bounds_of(cells.box({}), levels.header().frame);
  for (const auto& [cell, number] : below) tiles[0].children.push_back(number);
  MemorySource source(scene());
  CHECK(check_cover(
            tiles, [&](std::size_t i) { return contents[i]; }, source)
            .findings.empty());
  CHECK(tiles.size() > 5);
}

TEST_CASE("tiles do not depend on threads or on memory", "[quick][pass][lod]") {
  Backends backends = cpu_backends();
  const Triangles triangles = scene();
  const TriangleBvh tree(triangles);
  TileParams params;
  if (GENERATE(false, true)) enclose(tree, params);
  TilePyramid levels = pyramid(triangles, backends);
  const Level level = make(levels, params);
  const ThreadLimit one(1);
  PyramidOptions options;
  Voxelized solid = voxelized(scene(), 1, kEdge);
  options.cells = kTileCells;
  options.context.make_shelf = memory_shelves();
  options.context.memory.bytes = std::uint64_t(16) << 20;  // one tile at a time
  TilePyramid again(solid.header, std::move(solid.shelf), backends, options);
  const Level other = make(again, params);
  REQUIRE(level.size() == other.size());
  for (const auto& [cell, made] : level) {
    CHECK(made.mesh.vertices == other.at(cell).mesh.vertices);
    CHECK(made.mesh.triangles == other.at(cell).mesh.triangles);
    CHECK(made.measures.error_world == other.at(cell).measures.error_world);
  }
}

TEST_CASE("tiles that enclose triangles are tighter, and nearer to the scene", "[quick][pass][lod]") {
  Backends backends = cpu_backends();
  Triangles roof;  // slanted: its voxels are steps
  for (const double x : {20.0, 100.0}) {
    add_box(roof, {x, 20, 3}, {x + 60, 80, 20});
    const Vec3d a{x, 20, 20}, b{x + 60, 20, 20}, c{x + 60, 80, 20}, d{x, 80, 20}, e{x, 50, 47.3}, f{x + 60, 50, 47.3};
    for (const TriangleD& t : {TriangleD{a, b, f}, TriangleD{a, f, e}, TriangleD{c, d, e}, TriangleD{c, e, f},
                               TriangleD{a, e, d}, TriangleD{b, c, f}})
      roof.push_back(t);
  }
  TilePyramid levels = pyramid(roof, backends);
  const Level voxels = make(levels, {});
  const TriangleBvh tree(roof);
  TileParams params;
  enclose(tree, params);
  TilePyramid again = pyramid(roof, backends);
  const Level triangles = make(again, params);
  CHECK(volume_of(triangles) < 0.97 * volume_of(voxels));
  CHECK(largest_error(triangles) < largest_error(voxels));
}

// Where a cell cuts a filled solid, its walls are no triangles of the scene.
TEST_CASE("a tile that encloses triangles is not hollowed out from where its cell ends", "[quick][pass][lod]") {
  Backends backends = cpu_backends();
  Triangles block;
  add_box(block, {10, 10, 10}, {200, 110, 110});
  const TriangleBvh tree(block);
  TileParams params;
  enclose(tree, params);
  params.faces = 400;
  TilePyramid levels = pyramid(block, backends);
  const Level level = make(levels, params);
  REQUIRE(level.size() > 1);
  for (const double x : {20.0, 100.0, 115.0, 140.0, 190.0}) CHECK(tiles_around(level, {x, 60, 60}) >= 1);
  CHECK(volume_of(level) > 190.0 * 100 * 100);
}

TEST_CASE("a tile far from a change stays the same", "[quick][pass][lod]") {
  Backends backends = cpu_backends();
  Triangles changed = scene();
  for (std::size_t i = 0; i < 12; ++i)  // the first box
    for (Vec3d& p : changed[i]) p[2] = std::min(p[2], 20.0);
  TilePyramid levels = pyramid(scene(), backends), other = pyramid(changed, backends);
  const Level a = make(levels, {}), b = make(other, {});
  REQUIRE(a.size() == b.size());
  std::size_t same = 0;
  for (const auto& [cell, made] : a) {
    Bounds3d reach = bounds_of(kTileCells.box(cell), levels.header().frame);
    for (std::size_t i = 0; i < 3; ++i) reach.min[i] -= 8, reach.max[i] += 8;  // closing and rim
    if (overlap(reach, Bounds3d{{0, 0, 3}, {13, 9, 30}})) continue;
    CHECK(made.mesh.vertices == b.at(cell).mesh.vertices);
    ++same;
  }
  CHECK(4 * same > a.size());
}

TEST_CASE("a tile's key depends on all that decides the tile", "[quick][pass][lod][cache]") {
  struct Keys final : ResultStore {  // nothing is kept
    bool get(const ResultKey& key, std::string&) override {
      const std::lock_guard lock(mutex);
      asked.insert(key);
      return false;
    }
    void put(const ResultKey&, std::string_view) override {}
    std::mutex mutex;
    std::set<ResultKey> asked;
  };
  Triangles scene;
  add_box(scene, {3, 3, 3}, {40, 30, 20});
  Backends backends = cpu_backends();
  const TriangleBvh* triangles = nullptr;
  ResultKey inputs;
  const auto keys = [&](const TileShape& shape, double scale = 2, const Cells& cells = kTileCells) {
    Keys store;
    TileParams params;
    params.scene = triangles;
    static_cast<TileShape&>(params) = shape;
    params.scale_world = scale;
    Voxelized solid = voxelized(scene, 1, cells.edge_vox);
    PyramidOptions options;
    options.cells = cells;
    options.closing.element = shape.element;
    options.context.make_shelf = memory_shelves();
    options.context.results = &store;
    TilePyramid from(solid.header, std::move(solid.shelf), backends, options);
    from.add_level(params);
    store.asked.clear();  // of closings
    TileJobs jobs(from.tasks(), from.context());
    std::optional<KeptTile> none;
    for (std::size_t i = 0; i < jobs.count(); ++i) CHECK_FALSE(jobs.get(i, inputs, none));
    CHECK_FALSE(store.asked.empty());
    return store.asked;
  };
  TileShape shape;
  std::vector<std::set<ResultKey>> all{keys(shape)};
  const std::set<ResultKey> again = keys(shape);
  CHECK(again == all.front());
  for_each_field(shape, [&](auto& member) {
    if (static_cast<void*>(&member) == &shape.scale_world) return;  // the parameter of keys() is it
    change_each_member(member, [&] { all.push_back(keys(shape)); });
  });
  all.push_back(keys(shape, 3));
  all.push_back(keys(shape, 2, Cells{2 * kEdge}));
  const TriangleBvh tree(scene);
  Triangles moved = scene;  // within a voxel
  moved[0][0][0] += 0.125;
  const TriangleBvh tree_of_moved(moved);
  for (const TriangleBvh* some : {&tree, &tree_of_moved}) {
    triangles = some;
    all.push_back(keys(shape));
  }
  triangles = nullptr;
  inputs.words[1] = 1;
  all.push_back(keys(shape));
  inputs = {};
  scene[0][0][0] += 2;
  all.push_back(keys(shape));
  std::size_t sum = 0;
  std::set<ResultKey> distinct;
  for (const std::set<ResultKey>& some : all) {
    sum += some.size();
    distinct.insert(some.begin(), some.end());
  }
  CHECK(all.size() == 1 + (kFieldCount<TileShape> - 1) + 6);
  CHECK(distinct.size() == sum);
}

TEST_CASE("a tile without a voxel of the scene is made of the closing alone", "[quick][pass][lod]") {
  Triangles scene;  // two plates whose gap is closed, with a border of cells within the gap
  add_box(scene, {0, 0, 0}, {300, 20, 4});
  add_box(scene, {0, 0, 180}, {300, 20, 184});
  add_box(scene, {0, 0, 0}, {4, 20, 184});
  add_box(scene, {296, 0, 0}, {300, 20, 184});
  Backends backends = cpu_backends();
  TilePyramid levels = pyramid(scene, backends);
  const TriangleBvh tree(scene);
  TileParams params;
  if (GENERATE(false, true)) enclose(tree, params);
  const Level level = make(levels, params, 110);
  for (const auto& [cell, made] : level) {
    CAPTURE(cell.x, cell.y, cell.z);
    CHECK(check_proxy(indexed(made.mesh), nullptr).holds());
    CHECK(made.measures.error_world < 200);
  }
}

TEST_CASE("a room that a tile closes is no error of it", "[quick][pass][lod]") {
  Backends backends = cpu_backends();
  TileParams params;
  params.mode = GENERATE(MeshMode::bounding, MeshMode::fit);
  const bool closed = GENERATE(true, false);
  CAPTURE(closed);
  TilePyramid levels = pyramid(room(0, closed ? 3 : 12), backends);
  const Level level = make(levels, params);
  for (const double x : {14.0, 44.0}) CHECK(tiles_around(level, {x, 30, 30}) == (closed ? 1 : 0));
  CHECK(largest_error(level) < 10);  // the post is 26 below the roof
}

TEST_CASE("a room that two tiles close is filled in both, and its contents are no error of them",
          "[quick][pass][lod]") {
  Backends backends = cpu_backends();
  TileParams params;
  params.mode = GENERATE(MeshMode::bounding, MeshMode::fit);
  TilePyramid levels = pyramid(room(kAcross, 3), backends);
  const Level level = make(levels, params);
  for (const double x : {14.0, 44.0}) CHECK(tiles_around(level, {kAcross + x, 30, 30}) == 1);
  CHECK(largest_error(level) < 20);  // the wall between them is about 16 from the room's walls, floor, roof and post
}

TEST_CASE("the wall between two tiles that close a room counts in their errors, though both may hide it",
          "[quick][pass][lod]") {
  Backends backends = cpu_backends();
  TilePyramid levels = pyramid(room(kAcross, 3), backends);
  CHECK(largest_error(make(levels, {})) > 10);  // a viewer may draw another level beside a tile
}

TEST_CASE("a tile leaves out what only the cell below closes", "[quick][pass][lod]") {
  // At a scale of whole voxels flat sides grow by a voxel: for one of these heights, into the next cell.
  const double height = GENERATE(124.5, 125.5, 126.5);
  Triangles all;
  add_box(all, {0, 0, 0}, {300, 120, height});
  add_box(all, {40, 40, 0}, {50, 50, 180});
  Backends backends = cpu_backends();
  TilePyramid levels = pyramid(all, backends);
  TileParams params;
  params.error_world = 4;
  const Level level = make(levels, params);
  std::int32_t top = INT32_MIN;
  for (const auto& [cell, made] : level) top = std::max(top, cell.z);
  std::size_t above = 0;
  for (const auto& [cell, made] : level) {
    if (cell.z < top) continue;
    ++above;
    CAPTURE(height, cell.x, cell.y, cell.z);
    CHECK(made.measures.max.x - made.measures.min.x < 30 * kLatticePerVoxel);
    CHECK(made.measures.error_world < 4);
  }
  CHECK(above == 1);
}

TEST_CASE("fitted tiles keep their budget", "[quick][pass][lod]") {
  Backends backends = cpu_backends();
  TilePyramid levels = pyramid(scene(), backends);
  TileParams params;
  params.mode = MeshMode::fit;
  params.faces = 150;
  const Triangles triangles = scene();
  const TriangleBvh tree(triangles);
  params.scene = GENERATE(false, true) ? &tree : nullptr;
  for (const auto& [cell, made] : make(levels, params)) {
    CHECK(made.mesh.triangles.size() <= 150);
    CHECK(check_proxy(indexed(made.mesh), nullptr).holds());
  }
}

}  // namespace bp::test
