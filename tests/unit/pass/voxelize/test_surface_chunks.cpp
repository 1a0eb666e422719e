#include <algorithm>
#include <atomic>
#include <random>
#include <set>

#include "io/store/scratch.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/pass/voxelize/detail/surface_chunks.h"
#include "lib/pass/voxelize/voxelize_pass.h"
#include "lib/voxel/voxelize.h"
#include "tests/catch.h"
#include "tests/support/memory_results.h"
#include "tests/support/memory_scene.h"
#include "tests/support/memory_shelf.h"

using namespace bp;
using test::Triangles;

namespace {

/// Small triangles along a winding path, as a modeller would write them: neighbours in the file are neighbours in
/// space.
Triangles strand(unsigned seed, int n) {
  std::mt19937 random(seed);
  const auto pick = [&](double r) { return std::uniform_real_distribution<double>(-r, r)(random); };
  Triangles t;
  Vec3d at{0, 0, 0};
  for (int i = 0; i < n; ++i) {
    for (double& c : at) c = std::clamp(c + pick(1), -60.0, 60.0);
    TriangleD triangle;
    for (Vec3d& p : triangle) p = {at[0] + pick(1), at[1] + pick(1), at[2] + pick(1)};
    t.push_back(triangle);
  }
  test::add_sphere(t, {-30, 10, 20}, 15, 12);                     // something to fill
  t.push_back({{{-62, -62, -62}, {62, -62, 62}, {62, 62, 62}}});  // the bounds, whatever else changes
  return t;
}

std::vector<ChunkCutter::Chunk> cut(const Triangles& triangles, std::size_t batch) {
  ChunkCutter cutter;
  for (std::size_t i = 0; i < triangles.size(); i += batch) {
    const auto part = std::span(triangles).subspan(i, std::min(batch, triangles.size() - i));
    cutter.add(part, ChunkCutter::places(part));
  }
  return cutter.finish();
}

struct Chunked {
  VoxelizeCounts counts;
  StreamHeader header;
  BitBox bits;
};

Chunked run_chunked(const Triangles& scene, VoxelizeOptions o, ResultStore* results) {
  o.context.make_shelf = [] { return std::make_unique<test::MemoryShelf>(); };
  o.context.make_scratch = [] { return make_scratch(1000, "."); };
  if (!o.voxel_size) o.voxel_size = [](const Bounds3d&) { return 0.75; };
  o.context.results = results;
  test::MemorySource source(scene);
  test::MemorySink sink;
  Chunked r;
  r.counts = voxelize_stream(
      source,
      [&](const StreamHeader& h, const VoxelizeCounts&) -> BrickSink& {
        r.header = sink.header = h;
        return sink;
      },
      o);
  r.bits = sink.bits();
  return r;
}

/// A few triangles move, come or go, somewhere.
void edit(Triangles& scene, std::mt19937& random) {
  const std::size_t at = random() % (scene.size() - 50), n = 1 + random() % 40;
  const auto first = scene.begin() + std::ptrdiff_t(at);
  switch (random() % 3) {
    case 0:
      for (std::size_t i = 0; i < n; ++i) {
        for (Vec3d& p : scene[at + i]) p[1] *= 0.5;
      }
      break;
    case 1:
      scene.erase(first, first + std::ptrdiff_t(n));
      break;
    default:
      scene.insert(first, {{{double(n), 1, 2}, {3, double(n), 5}, {6, 7, -double(n)}}});
  }
}

/// The frame and the bricks of a scene, with voxels of a half.
std::pair<GridFrame, BrickBox> grid_around(const Triangles& scene) {
  Bounds3d bounds;
  for (const TriangleD& t : scene)
    for (const Vec3d& p : t) bounds.add(p);
  const GridFrame frame = make_frame(bounds, 0.5);
  return {frame, bricks_of(voxel_bounds(frame, bounds))};
}

}  // namespace

TEST_CASE("chunks do not depend on how the triangles arrive", "[quick][pass]") {
  const Triangles scene = strand(1, 200000);
  const auto whole = cut(scene, scene.size());
  std::uint64_t sum = 0;
  for (const auto& c : whole) {
    CHECK(c.content == ChunkCutter::content_of(std::span(scene).subspan(sum, c.triangles)));
    sum += c.triangles;
    CHECK(c.triangles <= ChunkCutter::kMost);
    CHECK((c.triangles >= ChunkCutter::kLeast || &c == &whole.back()));
  }
  CHECK(sum == scene.size());
  CHECK(whole.size() > 5);
  for (const std::size_t batch : {1000, 16384, 70000}) {
    const auto again = cut(scene, batch);
    REQUIRE(again.size() == whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i) CHECK(again[i].content == whole[i].content);
  }
  const Triangles same(150000, scene.front());  // no place, or every triangle one
  for (const auto& c : cut(same, 16384)) CHECK(c.triangles <= ChunkCutter::kMost);
}

TEST_CASE("a change of the triangles changes the chunks around it and no others", "[quick][pass]") {
  const Triangles scene = strand(2, 300000);
  std::set<ResultKey> before;
  for (const auto& c : cut(scene, 16384)) before.insert(c.content);
  std::mt19937 random(5);
  for (int round = 0; round < 6; ++round) {
    Triangles changed = scene;
    edit(changed, random);
    int fresh = 0;
    for (const auto& c : cut(changed, 16384)) fresh += before.count(c.content) == 0;
    CHECK(fresh >= 1);
    CHECK(fresh <= 3);
  }
}

TEST_CASE("the voxels of a chunk are those of its triangles, also on their way over a shelf", "[quick][pass]") {
  const Triangles scene = strand(3, 20000);
  const auto [frame, grid] = grid_around(scene);
  BitBox expected(voxels_of(grid));
  std::vector<FixedTriangle> fixed;
  for (const TriangleD& t : scene) fixed.push_back(to_fixed(frame, t));
  voxelize_surface(fixed, expected);
  const std::uint64_t memory = GENERATE(std::uint64_t(0), std::uint64_t(1) << 30);
  test::MemoryShelf shelf;
  BrickSum sum(grid, memory, shelf);
  std::atomic<int> refused{0};
  parallel_for(8, [&, &frame = frame, &grid = grid](std::int64_t i) {
    const auto n = scene.size() / 8 + 1, begin = std::min(scene.size(), std::size_t(i) * n);
    const auto part = std::span(scene).subspan(begin, std::min(n, scene.size() - begin));
    refused += !sum.add(*chunk_voxels(part, frame, grid));
  });
  CHECK(refused == 0);
  CHECK(shelf.coords().empty() == (memory > 0));
  CHECK_FALSE(sum.coords().empty());
  BitBox found(voxels_of(grid));
  sum.take(found);
  CHECK((found == expected));
}

TEST_CASE("bytes that are no chunk of this grid are refused whole", "[quick][pass]") {
  const Triangles scene = strand(4, 5000);
  const auto [frame, grid] = grid_around(scene);
  const std::string bytes = chunk_voxels(scene, frame, grid).value();
  test::MemoryShelf shelf;
  BrickSum sum(grid, 1 << 30, shelf);
  CHECK_FALSE(sum.add(bytes.substr(0, bytes.size() - 1)));
  CHECK_FALSE(sum.add(bytes + "x"));
  std::string moved = bytes;
  moved[3] = 0x7f;  // the first brick lies far to the right
  CHECK_FALSE(sum.add(moved));
  CHECK(sum.coords().empty());
}

TEST_CASE("a scene from kept chunks has the voxels of one from nothing, after any edits", "[quick][pass]") {
  VoxelizeOptions o;
  o.fill = GENERATE(FillMode::flood, FillMode::none, FillMode::winding);
  o.context.memory.bytes =
      GENERATE(std::uint64_t(1) << 30, std::uint64_t(100000));  // the latter: read twice, over the shelf
  CAPTURE(int(o.fill), o.context.memory.bytes);
  Triangles scene = strand(6, 60000);
  std::mt19937 random(7);
  test::MemoryResults results;
  for (int round = 0; round < 4; ++round) {
    CAPTURE(round);
    const Chunked clean = run_chunked(scene, o, nullptr), cached = run_chunked(scene, o, &results);
    CHECK((cached.bits == clean.bits));
    CHECK((cached.header == clean.header));
    CHECK(cached.counts.input_hash == clean.counts.input_hash);
    CHECK(cached.counts.surface_voxels == clean.counts.surface_voxels);
    CHECK((cached.counts.chunks > 0) == (o.fill != FillMode::winding));
    if (cached.counts.chunks > 0 && round > 0) {
      CHECK(cached.counts.chunks_kept < cached.counts.chunks);
      CHECK(cached.counts.chunks_kept > 0);
    }
    const Chunked again = run_chunked(scene, o, &results);
    CHECK((again.bits == clean.bits));
    CHECK(again.counts.chunks_kept == again.counts.chunks);
    edit(scene, random);
  }
}

TEST_CASE("triangles too large for a chunk are voxelized in every build", "[quick][pass]") {
  Triangles scene;
  for (int i = 0; i < 120; ++i) scene.push_back({{{-60, i - 60.0, -60}, {60, 60.0 - i, -60}, {i - 60.0, 0, 60}}});
  const Triangles small = strand(11, 40000);
  scene.insert(scene.end(), small.begin(), small.end());
  VoxelizeOptions o;
  o.voxel_size = [](const Bounds3d&) { return 0.25; };
  o.context.memory.bytes = GENERATE(std::uint64_t(1) << 30, std::uint64_t(100000));
  test::MemoryResults results;
  const Chunked clean = run_chunked(scene, o, nullptr);
  CHECK((run_chunked(scene, o, &results).bits == clean.bits));
  const Chunked again = run_chunked(scene, o, &results);
  CHECK((again.bits == clean.bits));
  CHECK(again.counts.chunks_kept == again.counts.chunks - 1);
  for (const auto& [key, bytes] : results.results) CHECK(bytes.size() <= kChunkBytes);
}

TEST_CASE("chunks of other voxels, of another frame, or damaged ones are not taken", "[quick][pass]") {
  const Triangles scene = strand(8, 30000);
  test::MemoryResults results;
  VoxelizeOptions o;
  (void)run_chunked(scene, o, &results);
  CHECK(run_chunked(scene, o, &results).counts.chunks_kept > 0);
  VoxelizeOptions finer = o;
  finer.voxel_size = [](const Bounds3d&) { return 0.5; };
  const Chunked smaller =
      run_chunked(scene, finer, &results);  // its triangles were met, and not kept: they are read again
  CHECK(smaller.counts.chunks_kept == 0);
  CHECK(smaller.counts.read_twice);
  CHECK((smaller.bits == run_chunked(scene, finer, nullptr).bits));
  Triangles more = scene;
  more.push_back({{{-500, 0, 0}, {-499, 0, 0}, {-499, 1, 0}}});  // the origin moves
  CHECK(run_chunked(more, o, &results).counts.chunks_kept == 0);
  for (auto& [key, bytes] : results.results) bytes.resize(bytes.size() / 2);
  const Chunked damaged = run_chunked(scene, o, &results);
  CHECK(damaged.counts.chunks_kept == 0);
  CHECK((damaged.bits == run_chunked(scene, o, nullptr).bits));
  CHECK(run_chunked(scene, o, &results).counts.chunks_kept == damaged.counts.chunks);
}

namespace {

/// A store in which another job has put all of its results as soon as the first voxels are put.
class SharedResults final : public ResultStore {
 public:
  explicit SharedResults(const test::MemoryResults& other) : other_(other) {}
  bool get(const ResultKey& key, std::string& out) override { return mine_.get(key, out); }
  void put(const ResultKey& key, std::string_view bytes) override {
    mine_.put(key, bytes);
    if (bytes.empty()) return;  // a mark
    ++made;
    for (const auto& [other_key, other_bytes] : other_.results) mine_.put(other_key, other_bytes);
  }
  std::atomic<int> made{0};

 private:
  const test::MemoryResults& other_;
  test::MemoryResults mine_;
};

}  // namespace

TEST_CASE("jobs at work at the same time share the chunks of their scene", "[quick][pass]") {
  const Triangles scene = strand(12, 100000);
  VoxelizeOptions o;
  // One chunk at work at a time; the latter: read twice.
  o.context.memory.bytes = GENERATE(std::uint64_t(1) << 26, std::uint64_t(100000));
  test::MemoryResults other;
  const Chunked clean = run_chunked(scene, o, nullptr);
  REQUIRE(run_chunked(scene, o, &other).counts.chunks > 4);
  for (const std::uint64_t turn : {1, 2}) {
    SharedResults shared(other);
    o.context.turn = turn;
    const Chunked found = run_chunked(scene, o, &shared);
    CHECK((found.bits == clean.bits));
    CHECK(found.counts.surface_voxels == clean.counts.surface_voxels);
    CHECK(found.counts.input_hash == clean.counts.input_hash);
    CHECK(shared.made == 1);
    CHECK(found.counts.chunks_kept == found.counts.chunks - 1);
  }
}

namespace {

/// A scene that gives other triangles in each reading, as many.
class Changing final : public TriangleSource {
 public:
  bool read(std::vector<TriangleD>& out) override { return now_.read(out); }
  void rewind() override { now_ = test::MemorySource(strand(++seed_, 20000)); }
  [[nodiscard]] const SceneCounts& counts() const override { return now_.counts(); }
  [[nodiscard]] std::string name() const override { return "changing"; }

 private:
  unsigned seed_ = 9;
  test::MemorySource now_{strand(9, 20000)};
};

}  // namespace

TEST_CASE("a scene that changes between two readings leaves no chunk behind", "[quick][pass]") {
  Changing source;
  test::MemoryResults results;
  test::MemorySink sink;
  VoxelizeOptions o;
  o.context.make_shelf = [] { return std::make_unique<test::MemoryShelf>(); };
  o.context.make_scratch = [] { return make_scratch(1000, "."); };
  o.voxel_size = [](const Bounds3d&) { return 0.75; };
  o.context.memory.bytes = 100000;
  o.context.results = &results;
  const auto open = [&](const StreamHeader& h, const VoxelizeCounts&) -> BrickSink& {
    sink.header = h;
    return sink;
  };
  CHECK_THROWS_AS(voxelize_stream(source, open, o), Error);
  CHECK(results.results.empty());
}
