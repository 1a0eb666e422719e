#include <cmath>
#include <random>

#include "io/store/scratch.h"
#include "lib/core/parallel.h"
#include "lib/pass/voxelize/voxelize_pass.h"
#include "tests/catch.h"
#include "tests/reference/flood.h"
#include "tests/reference/winding.h"
#include "tests/support/memory_scene.h"
#include "tests/support/memory_shelf.h"

using namespace bp;
using test::Triangles;

namespace {

struct Result {
  StreamHeader header;
  VoxelizeCounts counts;
  BitBox bits;
  int rewinds = 0;
};

VoxelizeOptions default_options() {
  VoxelizeOptions o;
  o.context.make_shelf = [] { return std::make_unique<test::MemoryShelf>(); };
  o.context.make_scratch = [] { return make_scratch(1000, "."); };
  return o;
}

Result run(const Triangles& scene, VoxelizeOptions o, double voxel) {
  if (!o.voxel_size) o.voxel_size = [voxel](const Bounds3d&) { return voxel; };
  test::MemorySource source(scene);
  test::MemorySink sink;
  Result r;
  r.counts = voxelize_stream(
      source,
      [&](const StreamHeader& h, const VoxelizeCounts&) -> BrickSink& {
        sink.header = h;
        return sink;
      },
      o);
  r.header = sink.header;
  r.bits = sink.bits();
  r.rewinds = source.rewinds;
  return r;
}

/// Surface over one box, and the plain flood: the definition.
BitBox expected_flood(const Triangles& scene, const StreamHeader& h) {
  BitBox bits(voxels_of(h.bricks));
  std::vector<FixedTriangle> fixed;
  for (const TriangleD& t : scene) fixed.push_back(to_fixed(h.frame, t));
  voxelize_surface(fixed, bits);
  return reference::fill_enclosed(bits, bits.box());
}

Triangles soup(unsigned seed, int n, double size, double reach, const Vec3d& offset = {0, 0, 0}) {
  std::mt19937 rng(seed);
  const auto pick = [&](double r) { return std::uniform_real_distribution<double>(-r, r)(rng); };
  Triangles t;
  for (int i = 0; i < n; ++i) {
    const Vec3d c{offset[0] + pick(reach), offset[1] + pick(reach), offset[2] + pick(reach)};
    TriangleD tri;
    for (auto& p : tri) p = {c[0] + pick(size), c[1] + pick(size), c[2] + pick(size)};
    t.push_back(tri);
  }
  return t;
}

Triangles bodies() {
  Triangles t = soup(3, 300, 4, 40);
  test::add_sphere(t, {10, 5, -3}, 30, 20);
  test::add_sphere(t, {-30, 10, 20}, 15, 12);
  test::add_box(t, {-55, -45, -20}, {-20, 50, 20});
  return t;
}

}  // namespace

TEST_CASE("the flood-filled scene equals its definition", "[quick][pass]") {
  const Triangles scene = bodies();
  const Result r = run(scene, default_options(), 1.0);
  CHECK(r.bits == expected_flood(scene, r.header));
  CHECK(r.counts.solid_voxels == r.bits.count());
  CHECK(r.counts.surface_voxels < r.counts.solid_voxels);
  CHECK(r.counts.scene.triangles == scene.size());
  CHECK(r.rewinds == 0);
  CHECK(r.counts.input_hash.size() == 32);
  CHECK(r.header.frame.voxel == 1.0);
  CHECK(r.header.slab_axis == longest_axis(r.header.bricks));
  CHECK(r.header.bounds.min[1] <= -45);
}

TEST_CASE("tile size, memory and threads change no voxel", "[quick][pass]") {
  const FillMode fill = GENERATE(FillMode::flood, FillMode::winding, FillMode::none);
  Triangles scene = bodies();
  VoxelizeOptions o = default_options();
  o.fill = fill;
  const Result whole = run(scene, o, 0.8);
  for (const std::int32_t tile : {64, 128, 192}) {
    for (const std::uint64_t memory : {std::uint64_t(1) << 30, std::uint64_t(20000)}) {
      for (const int threads : {1, 4}) {
        o.tile_vox = tile;
        o.context.memory.bytes = memory;
        const ThreadLimit limit(threads);
        CAPTURE(tile, memory, threads);
        const Result r = run(scene, o, 0.8);
        CHECK(r.bits == whole.bits);
        CHECK(r.header == whole.header);
        CHECK(r.rewinds == (memory < 30000 ? 1 : 0));
        CHECK((r.counts.scratch_bytes > 0) == (memory < 30000 || fill == FillMode::winding));
      }
    }
  }
}

TEST_CASE("many triangles in one tile are voxelized before the scene ends", "[quick][pass]") {
  const FillMode fill = GENERATE(FillMode::flood, FillMode::winding);
  Triangles scene = soup(9, 12000, 0.7, 25);  // 430 kB of records in one tile of 32 kB
  test::add_sphere(scene, {3, 2, 1}, 20, 40);
  VoxelizeOptions o = default_options();
  o.fill = fill;
  const Result whole = run(scene, o, 1.0);
  o.tile_vox = 64;
  o.context.memory.bytes = 200000;
  CHECK(run(scene, o, 1.0).bits == whole.bits);
}

TEST_CASE("every point of the scene lies strictly inside the occupied voxels", "[quick][pass]") {
  const double offset = GENERATE(0.0, 6.80176e6);
  const Triangles scene = soup(17, 400, 6, 30, {offset, -offset / 7, offset / 3});
  VoxelizeOptions o = default_options();
  o.fill = FillMode::none;
  const Result r = run(scene, o, 0.37);
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const TriangleD& t : scene) {
    for (int i = 0; i < 30; ++i) {
      double u = unit(rng), v = unit(rng);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      if (i < 3) u = i == 1, v = i == 2;  // the corners
      Vec3d p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = t[0][k] + u * (t[1][k] - t[0][k]) + v * (t[2][k] - t[0][k]);
      const Vec3d q = r.header.frame.to_voxels(p);
      for (int corner = 0; corner < 8; ++corner) {  // a small cube around the point
        VoxelCoord c;
        for (int k = 0; k < 3; ++k)
          c[k] = std::int32_t(std::floor(q[std::size_t(k)] + ((corner >> k) & 1 ? 1e-6 : -1e-6)));
        REQUIRE(r.bits.test(c));
      }
    }
  }
}

TEST_CASE("a scene far from the origin has the voxels of the same scene near it", "[quick][pass]") {
  Triangles near;
  test::add_sphere(near, {0, 0, 0}, 20, 10, 1.0 / 256);
  test::add_box(near, {-25, -5, -5}, {25, 5, 5.5});
  Triangles far = near;
  for (auto& t : far)
    for (auto& p : t) p = {p[0] + 4096000, p[1] - 8192000, p[2] + 1024};  // whole voxels
  const Result a = run(near, default_options(), 0.5), b = run(far, default_options(), 0.5);
  REQUIRE(a.header.frame.voxel == b.header.frame.voxel);
  CHECK(a.header.bricks == b.header.bricks);
  CHECK(a.bits == b.bits);
}

TEST_CASE("flat, linear, tiny and point-like scenes have voxels", "[quick][pass]") {
  const auto at_resolution = [](const Triangles& scene, std::int64_t n) {
    VoxelizeOptions o = default_options();
    o.voxel_size = [n](const Bounds3d& b) { return voxel_size_of(b, n); };
    return run(scene, o, 0);
  };
  const Result flat = at_resolution({{Vec3d{0, 0, 2}, Vec3d{10, 0, 2}, Vec3d{0, 7, 2}}}, 100);
  CHECK(flat.counts.solid_voxels > 100 * 70 / 2);
  CHECK(flat.header.frame.voxel >= 0.1);
  const Result line = at_resolution({{Vec3d{0, 0, 0}, Vec3d{5, 0, 0}, Vec3d{9, 0, 0}}}, 50);
  CHECK(line.counts.solid_voxels >= 50 * 4);
  const Vec3d p{1e6, -2e6, 1e-3};
  const Result point = at_resolution({{p, p, p}}, 256);
  CHECK(point.counts.solid_voxels >= 1);
  CHECK(point.counts.solid_voxels <= 8);
  const Result origin = at_resolution({{Vec3d{}, Vec3d{}, Vec3d{}}}, 256);
  CHECK(origin.counts.solid_voxels == 8);
  const Result tiny = at_resolution({{Vec3d{1, 1, 1}, Vec3d{1 + 1e-9, 1, 1}, Vec3d{1, 1 + 1e-9, 1}}}, 64);
  CHECK(tiny.counts.solid_voxels > 64);
}

TEST_CASE("a triangle across the whole grid and tiles without triangles", "[quick][pass]") {
  Triangles scene;
  test::add_box(scene, {0, 0, 0}, {3, 3, 3});
  test::add_box(scene, {75, 20, 80}, {78, 23, 83});
  SECTION("two small bodies far apart") {}
  SECTION("and a slanted floor under them") {
    scene.push_back({Vec3d{-10, -10, -10}, {80, 10, 30}, {20, 30, 80}});
  }
  VoxelizeOptions o = default_options();
  o.tile_vox = 64;
  const Result r = run(scene, o, 1.0);
  CHECK(r.counts.tiles_touched < r.counts.tiles);
  CHECK(r.bits == expected_flood(scene, r.header));
}

TEST_CASE("a large hollow body is filled through tiles that hold no triangle", "[quick][pass]") {
  const FillMode fill = GENERATE(FillMode::flood, FillMode::winding);
  Triangles scene;
  test::add_box(scene, {1, 1, 1}, {200, 200, 200});
  VoxelizeOptions o = default_options();
  o.tile_vox = 64;
  o.fill = fill;
  const Result r = run(scene, o, 1.0);
  CHECK(r.counts.solid_voxels == 201 * 201 * 201);  // closed cubes: one more on each side
  CHECK(r.bits.count() == 201 * 201 * 201);
  CHECK(r.counts.full_bricks > 1);
  CHECK(r.counts.open_columns == 0);
}

TEST_CASE("sheets thinner than a voxel, and sheets on voxel borders, stay connected", "[quick][pass]") {
  Triangles scene;
  const double z = GENERATE(0.0, 0.5, 0.999999);
  test::add_box(scene, {0, 0, z}, {100, 50, z + 0.001});
  const Result r = run(scene, default_options(), 1.0);
  CHECK(r.bits == expected_flood(scene, r.header));
  for (std::int32_t y = 0; y < 50; ++y)
    for (std::int32_t x = 0; x < 100; ++x) REQUIRE(r.bits.test({x, y, std::int32_t(std::floor(z - std::floor(z)))}));
}

TEST_CASE("winding fills overlapping, nested and inverted bodies; open ones fall back to the flood", "[quick][pass]") {
  VoxelizeOptions o = default_options();
  o.fill = FillMode::winding;
  o.tile_vox = 64;
  Triangles scene;
  test::add_sphere(scene, {0, 0, 0}, 45, 12);
  test::add_sphere(scene, {30, 10, 0}, 40, 10);
  const std::size_t inverted = scene.size();
  test::add_sphere(scene, {-60, 0, 40}, 30, 10);
  test::turn_inside_out(scene, inverted);
  const Result closed = run(scene, o, 1.0);
  CHECK(closed.counts.open_columns == 0);
  int inside = 0;
  for (std::int32_t z = 0; z < 90; z += 11)
    for (std::int32_t y = 0; y < 90; y += 7)
      for (std::int32_t x = 0; x < 150; ++x) {
        const Vec3d p = closed.header.frame.world({64 * x + 32, 64 * y + 32, 64 * z + 32});
        const double n = reference::winding_number(scene, p);
        if (std::abs(n - std::round(n)) > 1e-3) continue;
        if (std::abs(n) > 0.5) REQUIRE(closed.bits.test({x, y, z}));
        inside += std::abs(n) > 0.5;
      }
  CHECK(inside > 1000);

  SECTION("a body whose lid is missing, closed by another body, is filled in its columns all the same") {
    Triangles cup;
    test::add_box(cup, {100, 0, 0}, {140, 40, 40});
    cup.erase(cup.end() - 2, cup.end());              // no top
    test::add_box(cup, {95, -5, 40}, {145, 45, 44});  // a slab lies on it
    Triangles both = scene;
    both.insert(both.end(), cup.begin(), cup.end());
    const Result r = run(both, o, 1.0);
    CHECK(r.counts.open_columns >= 39 * 39);
    CHECK(r.counts.open_columns <= 41 * 41);
    const Vec3d middle = r.header.frame.to_voxels({120, 20, 20});
    CHECK(r.bits.test({std::int32_t(middle[0]), std::int32_t(middle[1]), std::int32_t(middle[2])}));
  }
}

TEST_CASE("winding leaves a cavity open that the flood would fill", "[quick][pass]") {
  Triangles scene;
  test::add_sphere(scene, {0, 0, 0}, 40, 12);
  const std::size_t inner = scene.size();
  test::add_sphere(scene, {0, 0, 0}, 20, 10);
  test::turn_inside_out(scene, inner);
  VoxelizeOptions o = default_options();
  const Result flood = run(scene, o, 1.0);
  o.fill = FillMode::winding;
  const Result winding = run(scene, o, 1.0);
  const Vec3d c = flood.header.frame.to_voxels({0, 0, 0});
  const VoxelCoord centre{std::int32_t(c[0]), std::int32_t(c[1]), std::int32_t(c[2])};
  CHECK(flood.bits.test(centre));
  CHECK_FALSE(winding.bits.test(centre));
}

TEST_CASE("what cannot be voxelized is refused with a reason", "[quick][pass]") {
  const auto code = [](const Triangles& scene, VoxelizeOptions o, double voxel) {
    try {
      run(scene, std::move(o), voxel);
    } catch (const Error& e) {
      return int(e.code());
    }
    return -1;
  };
  Triangles one;
  test::add_box(one, {0, 0, 0}, {1, 1, 1});
  CHECK(code({}, default_options(), 1) == int(ErrorCode::bad_input));
  CHECK(code(one, default_options(), 0) == int(ErrorCode::bad_argument));
  CHECK(code(one, default_options(), NAN) == int(ErrorCode::bad_argument));
  CHECK(code(one, default_options(), 1e-7) == int(ErrorCode::bad_argument));   // too many tiles
  CHECK(code(one, default_options(), 1e-12) == int(ErrorCode::bad_argument));  // over 2^31 voxels
  VoxelizeOptions odd = default_options();
  odd.tile_vox = 100;
  CHECK(code(one, odd, 0.1) == int(ErrorCode::bad_argument));
}

TEST_CASE("a source that changes between two readings is reported", "[quick][pass]") {
  class Fickle final : public TriangleSource {
   public:
    Fickle(int batches, double height) : batches_(batches), height_(height) {}
    bool read(std::vector<TriangleD>& out) override {
      out.clear();
      if (left_-- <= 0) return false;
      out.assign(100, TriangleD{Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, now_}});
      counts_.triangles += 100;
      return true;
    }
    void rewind() override {
      left_ = batches_;
      now_ = height_;
      counts_ = {};
    }
    [[nodiscard]] const SceneCounts& counts() const override { return counts_; }
    [[nodiscard]] std::string name() const override { return "fickle"; }

   private:
    int batches_, left_ = 5;
    double height_, now_ = 1;
    SceneCounts counts_;
  };
  const auto [batches, height] = GENERATE(std::pair(4, 1.0), std::pair(5, 0.9));  // fewer; as many, but others
  Fickle source(batches, height);
  test::MemorySink sink;
  VoxelizeOptions o = default_options();
  o.context.memory.bytes = 1000;
  o.voxel_size = [](const Bounds3d&) { return 0.1; };
  CHECK_THROWS_AS(voxelize_stream(
                      source,
                      [&](const StreamHeader& h, const VoxelizeCounts&) -> BrickSink& {
                        sink.header = h;
                        return sink;
                      },
                      o),
                  Error);
}
