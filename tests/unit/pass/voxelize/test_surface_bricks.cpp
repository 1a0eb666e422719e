#include <algorithm>
#include <random>

#include "lib/core/parallel.h"
#include "lib/pass/voxelize/detail/surface_bricks.h"
#include "lib/pass/voxelize/voxelize_pass.h"
#include "lib/store/memory_scratch.h"
#include "lib/voxel/voxelize.h"
#include "tests/catch.h"
#include "tests/support/memory_scene.h"
#include "tests/support/voxelized.h"

using namespace bp;
using test::Triangles;

namespace {

constexpr double kReach = 200;  // voxels: some bricks along each axis

/// A triangle of about this size, in one of the ways that are hard to decide.
TriangleD hard_triangle(std::mt19937_64& rng, double size) {
  const auto pick = [&](double r) { return std::uniform_real_distribution<double>(-r, r)(rng); };
  const auto snap = [&](double x) { return std::floor(x) + double(int(rng() % 5) - 2) / double(kFixedOne); };
  const Vec3d middle{pick(kReach), pick(kReach), pick(kReach)};
  TriangleD t;
  for (Vec3d& p : t)
    for (std::size_t i = 0; i < 3; ++i) p[i] = middle[i] + pick(size);
  const std::size_t axis = rng() % 3;
  switch (rng() % 9) {
    case 0:  // flat
      t[1][axis] = t[2][axis] = t[0][axis];
      break;
    case 1:  // flat, on the border of voxels or a unit or two beside it
      t[0][axis] = t[1][axis] = t[2][axis] = snap(middle[axis]);
      break;
    case 2:  // corners at corners of voxels
      for (Vec3d& p : t)
        for (double& c : p) c = snap(c);
      break;
    case 3:  // on the border of bricks
      for (Vec3d& p : t) p[axis] += std::round(middle[axis] / kBrickEdge) * kBrickEdge - middle[axis];
      break;
    case 4:  // a segment
      t[1] = t[0];
      break;
    case 5:  // a point
      t[1] = t[2] = t[0];
      break;
    case 6:  // a needle
      for (std::size_t i = 0; i < 3; ++i) t[2][i] = t[1][i] + pick(1e-4);
      break;
    default:
      break;
  }
  for (Vec3d& p : t)
    for (double& c : p) c = std::clamp(c, -kReach - 50, kReach + 50);
  return t;
}

Triangles hard_scene(std::uint64_t seed, double size, int n) {
  std::mt19937_64 rng(seed);
  Triangles scene;
  for (int i = 0; i < n; ++i) scene.push_back(hard_triangle(rng, size));
  return scene;
}

GridFrame frame_of(double voxel) {
  return make_frame({{-kReach - 50, -kReach - 50, -kReach - 50}, {kReach + 50, kReach + 50, kReach + 50}}, voxel);
}

BitBox plainly_voxelized(const Triangles& scene, const GridFrame& frame, const VoxelBox& box) {
  BitBox bits(box);
  const FixedFrame to_fixed(frame);
  for (const TriangleD& t : scene) {
    const FixedTriangle fixed = to_fixed(t);
    voxelize_surface({&fixed, 1}, bits);
  }
  return bits;
}

/// A scene that tells its bounds beforehand.
class TellingSource final : public TriangleSource {
 public:
  TellingSource(Triangles triangles, const Bounds3d& told) : scene_(std::move(triangles)), told_(told) {}
  bool read(std::vector<TriangleD>& out) override { return scene_.read(out); }
  void rewind() override { scene_.rewind(); }
  [[nodiscard]] const SceneCounts& counts() const override { return scene_.counts(); }
  [[nodiscard]] std::string name() const override { return scene_.name(); }
  [[nodiscard]] std::optional<Bounds3d> bounds() override { return told_; }
  [[nodiscard]] int rewinds() const { return scene_.rewinds; }

 private:
  test::MemorySource scene_;
  Bounds3d told_;
};

}  // namespace

TEST_CASE("bricks that all threads add to hold the voxels of the triangles, whatever there is room for",
          "[quick][pass]") {
  const double size = GENERATE(0.001, 0.3, 0.9, 2.5, 9.0, 30.0, 90.0);
  const Triangles scene = hard_scene(std::uint64_t(size * 1000), size, size < 20 ? 4000 : 400);
  const GridFrame frame = frame_of(1);
  const VoxelBox box = voxels_of(bricks_of({{-2, -2, -2}, {504, 504, 504}}));
  const BitBox expected = plainly_voxelized(scene, frame, box);
  for (const int threads : {1, 2, 4}) {
    for (const std::uint64_t bricks : {0, 20, 100000}) {
      CAPTURE(size, threads, bricks);
      const ThreadLimit limit(threads);
      SurfaceBricks shared(bricks * sizeof(BrickBits));
      BitBox found(box);
      std::mutex mutex;
      std::size_t left = 0;
      parallel_ranges(std::int64_t(scene.size()), 100, [&](std::int64_t begin, std::int64_t end) {
        std::vector<FixedTriangle> rest;
        shared.add(std::span(scene).subspan(std::size_t(begin), std::size_t(end - begin)), frame, kFixedSlack, rest);
        const std::lock_guard lock(mutex);
        voxelize_surface(rest, found);
        left += rest.size();
      });
      CHECK(shared.memory_bytes() <= bricks * sizeof(BrickBits));
      const std::vector<BrickCoord> coords = shared.coords();
      shared.take(found);
      CHECK((found == expected));
      CHECK(shared.coords().empty());
      if (bricks == 0) CHECK(left == scene.size());
      if (bricks == 0) CHECK(coords.empty());
      if (bricks > 20 && size < 30) CHECK(left == 0);
    }
  }
}

TEST_CASE("a scene whose bounds are told is read once, and has the same voxels", "[quick][pass]") {
  Triangles scene = hard_scene(5, GENERATE(0.7, 4.0, 120.0), 3000);
  test::add_sphere(scene, {10, 20, 30}, 60, 30);
  Bounds3d right;
  for (const TriangleD& t : scene)
    for (const Vec3d& p : t) right.add(p);
  Bounds3d small = right, large = right, elsewhere = right, endless = right;
  small.max[0] -= 30;
  large.min[1] -= 1000;
  elsewhere.min[2] = elsewhere.max[2] + 1e30, elsewhere.max[2] = 1e31;
  endless.max[1] = std::numeric_limits<double>::infinity();
  VoxelizeOptions o;
  o.fill = GENERATE(FillMode::flood, FillMode::winding);
  o.voxel_by_bounds = true;
  o.voxel_size = [](const Bounds3d& b) { return voxel_size_of(b, 300); };
  o.context.make_shelf = test::memory_shelves();
  struct Found {
    StreamHeader header;
    BitBox bits;
    VoxelizeCounts counts;
  };
  const auto run = [&](TriangleSource& source) {
    test::MemorySink sink;
    const auto open = [&](const StreamHeader& h, const VoxelizeCounts&) -> BrickSink& {
      sink.header = h;
      return sink;
    };
    Found found;
    found.counts = voxelize_stream(source, open, o);
    found.header = sink.header, found.bits = sink.bits();
    return found;
  };
  o.context.memory.bytes = std::uint64_t(1) << 30;
  o.context.make_scratch = [] { return std::make_unique<MemoryScratch>(); };
  test::MemorySource plain(scene);
  const Found expected = run(plain);
  for (const std::uint64_t memory : {std::uint64_t(1) << 30, std::uint64_t(300000), std::uint64_t(20000)}) {
    o.context.memory.bytes = memory;
    for (const Bounds3d& told : {right, small, large, elsewhere, endless, Bounds3d{}}) {
      TellingSource source(scene, told);
      const Found found = run(source);
      CHECK((found.bits == expected.bits));
      CHECK((found.header == expected.header));
      CHECK(found.counts.input_hash == expected.counts.input_hash);
      CHECK(found.counts.surface_voxels == expected.counts.surface_voxels);
      CHECK(found.counts.tiles_touched == expected.counts.tiles_touched);
      CHECK(found.counts.area == expected.counts.area);
      if (told == right) CHECK(source.rewinds() == 0);
      if (told == right) CHECK_FALSE(found.counts.read_twice);
      if (told == small) CHECK(source.rewinds() == 1);
    }
  }
}
