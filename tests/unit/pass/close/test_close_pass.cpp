#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>

#include "io/stream/brick_shelf.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/device/cpu/cpu_backend.h"
#include "lib/grid/shelf_stream.h"
#include "lib/pass/close/close_pass.h"
#include "tests/catch.h"
#include "tests/reference/flood.h"
#include "tests/reference/random_closing.h"

using namespace bp;
using reference::Random;

namespace {

/// A stream in memory: every non-empty brick of `solid`, in slab order.
class BitSource final : public BrickSource {
 public:
  BitSource(const BitBox& solid, int slab_axis) {
    header_.bricks = bricks_of(solid.box());
    header_.slab_axis = slab_axis;
    auto shelf = make_shelf(std::uint64_t(64) << 20, std::filesystem::temp_directory_path().string());
    BitBox whole(voxels_of(header_.bricks));
    copy_voxels(solid, whole);
    store_voxels(whole, *shelf);
    for (const BrickCoord c : shelf->coords()) {
      Brick brick;
      brick.coord = c;
      brick.fill = shelf->get(c, brick.bits);
      bricks_.push_back(brick);
    }
    std::sort(bricks_.begin(), bricks_.end(),
              [&](const Brick& a, const Brick& b) { return slab_order(slab_axis, a, b); });
  }
  [[nodiscard]] const StreamHeader& header() const override { return header_; }
  bool read(Brick& out) override {
    if (next_ == bricks_.size()) return false;
    out = bricks_[next_++];
    return true;
  }
  /// Adds a closing layer of other content, as a closed stream would have.
  void add_closing_layer() {
    header_.has_closing = true;
    std::vector<Brick> both;
    for (Brick b : bricks_) {
      both.push_back(b);
      b.layer = Layer::closing;
      b.fill = BrickFill::full;
      b.bits.fill(~std::uint64_t(0));
      both.push_back(b);
    }
    bricks_ = both;
  }
  [[nodiscard]] std::size_t left() const { return bricks_.size() - next_; }

 private:
  StreamHeader header_;
  std::vector<Brick> bricks_;
  std::size_t next_ = 0;
};

/// Collects both layers; checks the order.
class BitSink final : public BrickSink {
 public:
  BitSink(const BrickBox& bricks, int slab_axis) : solid(voxels_of(bricks)), closing(solid), axis_(slab_axis) {}
  void write(const Brick& brick) override {
    REQUIRE(brick.fill == classify(brick.bits));
    REQUIRE(brick.fill != BrickFill::empty);
    if (count_++ > 0) REQUIRE(slab_order(axis_, last_, brick));
    last_ = brick;
    if (first_left < 0 && source != nullptr) first_left = std::int64_t(source->left());
    BitBox& to = brick.layer == Layer::solid ? solid : closing;
    const VoxelCoord first = first_voxel(brick.coord);
    REQUIRE(to.box().contains(first));
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y)
        to.row(first.y + y, first.z + z)[(first.x - to.box().min.x) / 64] = brick.bits[std::size_t(z * kBrickEdge + y)];
    }
  }
  void finish() override {}
  BitBox solid, closing;
  const BitSource* source = nullptr;
  std::int64_t first_left = -1;  ///< bricks that the source still held when the first one was written

 private:
  Brick last_;
  int axis_;
  std::size_t count_ = 0;
};

struct Case {
  BitBox solid;
  ScaleField field;
  StructuringElement element = StructuringElement::cube;
  int slab_axis = 2;
};

struct Result {
  CloseCounts counts;
  BitBox solid, closing;
  std::int64_t first_left = -1;
};

struct Setup {
  std::int32_t tile_vox = 0;
  bool keep_cavities = false;
  int backends = 2;
  std::uint64_t shelf_bytes = std::uint64_t(64) << 20, memory_bytes = std::uint64_t(512) << 20;
  bool closed_input = false;
};

Result run(const Case& c, const Setup& setup) {
  BitSource source(c.solid, c.slab_axis);
  if (setup.closed_input) source.add_closing_layer();
  BitSink sink(closing_bricks(source.header(), c.field), c.slab_axis);
  sink.source = &source;
  Backends backends;
  for (int i = 0; i < setup.backends; ++i) backends.push_back(std::make_unique<CpuBackend>());
  CloseOptions options;
  options.tile_vox = setup.tile_vox;
  options.keep_cavities = setup.keep_cavities;
  options.context.memory.bytes = setup.memory_bytes;
  options.context.make_shelf = make_shelf_factory(setup.shelf_bytes, std::filesystem::temp_directory_path().string());
  Result r;
  r.counts = close_stream(source, sink, backends, c.field, {c.element}, options);
  CHECK(source.left() == 0);
  r.solid = std::move(sink.solid);
  r.closing = std::move(sink.closing);
  r.first_left = sink.first_left;
  return r;
}

/// The closing of the whole grid in one piece.
BitBox expected(const Case& c, bool keep_cavities) {
  StreamHeader header;
  header.bricks = bricks_of(c.solid.box());
  const VoxelBox grid = voxels_of(closing_bricks(header, c.field));
  const Scale largest = c.field.upper_bound(header.frame);
  const Halo halo{largest / kScaleOne + 2, largest / kScaleOne + 1};
  ClosingScratch scratch;
  BitBox closed;
  close_tile(c.solid, c.field.sample(header.frame, grid.grown(halo.total_vox())), halo, {c.element}, grid, closed,
             scratch);
  if (keep_cavities) return closed;
  BitBox near(c.solid.box().grown(halo.dilation_vox + 1));  // beyond, nothing is closed: all is outside
  copy_voxels(closed, near);
  copy_voxels(reference::fill_enclosed(near, near.box()), closed);
  return closed;
}

Case random_case(std::uint64_t seed) {
  Random random(seed);
  const VoxelBox box{{random.between(-70, 0), random.between(-70, 0), random.between(-70, 0)},
                     {random.between(30, 110), random.between(30, 110), random.between(30, 110)}};
  Case c;
  c.solid.reset(box);
  for (std::int32_t i = 0; i < 4; ++i) {  // shapes and noise in parts of the box, so that tiles differ
    VoxelBox part = reference::random_box(random, 60);
    part = intersect(part, box);
    if (part.empty()) continue;
    const BitBox bits = reference::random_solid(random, part);
    for (std::int32_t z = part.min.z; z < part.max.z; ++z) {
      for (std::int32_t y = part.min.y; y < part.max.y; ++y) {
        for (std::int32_t x = part.min.x; x < part.max.x; ++x) {
          if (bits.test({x, y, z})) c.solid.set({x, y, z});
        }
      }
    }
  }
  c.field = reference::random_field(random, box, 12);
  c.element = random.one_in(2) ? StructuringElement::cube : StructuringElement::ball;
  c.slab_axis = random.between(0, 2);
  return c;
}

/// A hollow box around a hollow box: the inner cavity spans whole tiles of 64.
Case hollow() {
  Case c;
  const VoxelBox outer{{0, 0, 0}, {192, 192, 192}};
  c.solid.reset(outer);
  for (std::int32_t z = outer.min.z; z < outer.max.z; ++z) {
    for (std::int32_t y = outer.min.y; y < outer.max.y; ++y) {
      for (std::int32_t x = outer.min.x; x < outer.max.x; ++x) {
        const VoxelBox inner = outer.grown(-2), room = outer.grown(-8);
        const VoxelCoord p{x, y, z};
        if (!inner.contains(p) || (room.contains(p) && !room.grown(-2).contains(p))) c.solid.set(p);
      }
    }
  }
  c.field.base = 2;
  return c;
}

/// A closing that goes on from an earlier one, or not.
struct GoneOn {
  EarlierClosing closing;
  CloseCounts counts;
};

GoneOn go_on(const Case& c, std::int32_t tile_vox, const EarlierClosing* earlier) {
  BitSource source(c.solid, c.slab_axis);
  Backends backends;
  for (int i = 0; i < 2; ++i) backends.push_back(std::make_unique<CpuBackend>());
  CloseOptions options;
  options.tile_vox = tile_vox;
  options.context.make_shelf = make_shelf_factory(std::uint64_t(64) << 20, std::filesystem::temp_directory_path());
  options.earlier = earlier;
  const std::shared_ptr<BrickShelf> voxels = options.context.make_shelf(), filled = options.context.make_shelf();
  options.filled = filled.get();
  ShelfSink sink(nullptr, voxels.get());
  const CloseCounts counts = close_stream(source, sink, backends, c.field, {c.element}, options);
  return {{c.field, voxels, filled}, counts};
}

std::map<BrickCoord, BrickBits> bricks(const BrickShelf& shelf) {
  std::map<BrickCoord, BrickBits> all;
  for (const BrickCoord c : shelf.coords()) (void)shelf.get(c, all[c]);
  return all;
}

}  // namespace

TEST_CASE("a closing that goes on from an earlier one has the same voxels", "[quick][pass]") {
  std::uint64_t all = 0, closed = 0, cavities = 0;
  for (std::uint64_t seed = 200; seed < 208; ++seed) {
    CAPTURE(seed);
    Case c = seed % 4 == 0 ? hollow() : random_case(seed);
    Random random(seed);
    GoneOn last = go_on(c, 64, nullptr);
    for (int step = 0; step < 5; ++step) {
      const auto near = [&] { return double(random.between(-70, 110)); };
      if (random.one_in(4)) c.field.base = random.between(0, 160) / 16.0;
      if (random.one_in(3) && !c.field.rules.empty()) c.field.rules.erase(c.field.rules.begin());
      if (random.one_in(2))
        c.field.rules.push_back(stroke_rule(ScaleMode(random.between(1, 2)), {near(), near(), near()},
                                            random.between(1, 8), random.between(0, 160) / 16.0, c.field.base));
      const GoneOn whole = go_on(c, 64, nullptr), next = go_on(c, random.one_in(2) ? 64 : 128, &last.closing);
      CHECK(bricks(*next.closing.voxels) == bricks(*whole.closing.voxels));
      CHECK(bricks(*next.closing.filled) == bricks(*whole.closing.filled));
      all += whole.counts.tiles_closed;
      closed += next.counts.tiles_closed;
      cavities += next.counts.cavity_voxels;
      last = go_on(c, 128, &last.closing);
    }
  }
  CHECK(closed * 3 < all * 2);
  CHECK(cavities > 0);
}

TEST_CASE("a closed stream is the closing of the whole grid", "[quick][pass]") {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Case c = random_case(seed);
    const Setup setup{seed % 2 == 0 ? 64 : 128, seed % 3 == 0};
    CAPTURE(seed, setup.tile_vox, setup.keep_cavities);
    const Result r = run(c, setup);
    CHECK(r.closing == expected(c, setup.keep_cavities));
    CHECK(r.solid.count() == c.solid.count());
    CHECK(r.counts.tile_vox == setup.tile_vox);
  }
}

TEST_CASE("tile size, threads and memory change no voxel of a closed stream", "[property][pass]") {
  for (std::uint64_t seed = 100; seed < 130; ++seed) {
    const Case c = random_case(seed);
    const bool keep = seed % 4 == 0;
    CAPTURE(seed, keep);
    const BitBox closed = expected(c, keep);
    for (const std::int32_t tile : {0, 64, 128, 192, 320, 1024}) {
      Setup setup{tile, keep, int(seed % 5) + 1};
      if (seed % 2 == 0) setup.shelf_bytes = 40000;  // spills
      const Result r = run(c, setup);
      CHECK(r.closing == closed);
      CHECK(r.solid.count() == c.solid.count());
    }
  }
}

TEST_CASE("cavities that span whole tiles are filled, unless they are kept", "[quick][pass]") {
  const Case c = hollow();
  const Result filled = run(c, {64});
  const Result kept = run(c, {64, true});
  CHECK(kept.counts.cavity_voxels == 0);
  CHECK(filled.counts.cavity_voxels == filled.closing.count() - kept.closing.count());
  CHECK(filled.closing == expected(c, false));
  CHECK(kept.closing == expected(c, true));
  CHECK(filled.closing.count() >= std::uint64_t(192 * 192 * 192));
}

TEST_CASE("kept cavities let the closing leave while the input still arrives", "[quick][pass]") {
  Case c;
  c.solid.reset({{0, 0, 0}, {64, 64, 64 * 30}});
  for (std::int32_t z = 5; z < 64 * 30; z += 10) c.solid.set({z % 64, 3, z});
  c.field.base = 4;
  CHECK(run(c, {64, true}).first_left > 10);
  CHECK(run(c, {64, false}).first_left == 0);
}

TEST_CASE("a closing layer in the input is made anew from the solid layer", "[quick][pass]") {
  const Case c = random_case(1);
  Setup again{64};
  again.closed_input = true;
  const Result first = run(c, {64}), second = run(c, again);
  CHECK(second.closing == first.closing);
  CHECK(second.solid == first.solid);
  CHECK(first.counts.ignored_bricks == 0);
  CHECK(second.counts.ignored_bricks == first.counts.solid_bricks);
}

TEST_CASE("a stream without bricks closes to nothing", "[quick][pass]") {
  Case c;
  c.solid.reset({{0, 0, 0}, {64, 64, 64}});
  c.field.base = 20;
  const Result r = run(c, {});
  CHECK(r.closing.count() == 0);
  CHECK(r.counts.tiles_closed == 0);
}

TEST_CASE("tiles with nothing in reach are not visited", "[quick][pass]") {
  Case c;
  c.solid.reset({{0, 0, 0}, {64 * 12, 64, 64 * 12}});
  c.solid.set({5, 5, 5});
  c.field.base = 8;
  const Result r = run(c, {64});
  CHECK(r.counts.tiles_closed == 27);  // the brick's own tile and its neighbours, which 8 voxels from the brick reach
  CHECK(r.counts.tiles == 14 * 3 * 14);
}

TEST_CASE("the bricks of a closing surround all that the dilation reaches", "[quick][pass]") {
  StreamHeader header;
  header.bricks = {{0, 0, 0}, {2, 3, 4}};
  ScaleField field;
  field.base = 62.5;
  CHECK(closing_bricks(header, field) == BrickBox{{-1, -1, -1}, {3, 4, 5}});
  field.base = 64;
  CHECK(closing_bricks(header, field) == BrickBox{{-2, -2, -2}, {4, 5, 6}});
  header.bricks.max.x = std::numeric_limits<std::int32_t>::max() / kBrickEdge;
  CHECK_THROWS_AS(closing_bricks(header, field), Error);
  field.base = -1;
  CHECK_THROWS_AS(closing_bricks(header, field), Error);
  field.base = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(closing_bricks(header, field), Error);
}

TEST_CASE("a closing that does not fit in memory says so before it begins", "[quick][pass]") {
  const Case c = random_case(2);
  Setup small{64};
  small.memory_bytes = 1 << 20;
  CHECK_THROWS_AS(run(c, small), Error);
  CHECK_THROWS_AS(run(c, {100}), Error);
  CHECK_THROWS_AS(run(c, {-64}), Error);
}
