#include "lib/live/design.h"
#include "lib/live/live_closing.h"
#include "lib/pass/close/close_pass.h"
#include "lib/pass/measure/shape_rules.h"
#include "lib/volume/boundary_runs.h"
#include "lib/volume/reduce.h"
#include "tests/catch.h"
#include "tests/reference/random_closing.h"
#include "tests/support/voxelized.h"

using namespace bp;
using reference::Random;

namespace {

/// Two plates with a gap, a comb, and a box that is nearly closed: it becomes a cavity at larger scales.
test::Triangles scene() {
  test::Triangles all;
  test::add_box(all, {0, 0, 0}, {10, 1, 6});
  test::add_box(all, {0, 2, 0}, {10, 2.5, 6});
  for (int i = 0; i < 6; ++i) test::add_box(all, {i * 1.5, 2.6, 0}, {i * 1.5 + 0.6, 4.5, 3});
  test::add_box(all, {1, 2.6, 3.5}, {1.2, 5, 6});
  test::add_box(all, {4, 2.6, 3.5}, {4.2, 5, 6});
  test::add_box(all, {1, 2.6, 3.5}, {4.2, 5, 3.7});
  test::add_box(all, {1, 2.6, 5.8}, {4.2, 5, 6});
  test::add_box(all, {1, 4.8, 3.5}, {4.2, 5, 5.2});
  return all;
}

LiveScene live_scene(const test::Triangles& triangles, double voxel) {
  test::Voxelized v = test::voxelized(triangles, voxel);
  LiveScene out;
  out.header = v.header;
  out.solid = std::move(v.shelf);
  out.context.make_shelf = test::memory_shelves();
  out.context.memory.bytes = std::uint64_t(1) << 30;
  out.triangles = [triangles](const auto& take) {
    for (const TriangleD& t : triangles) take(t);
  };
  return out;
}

RuleContext context_of(const StreamHeader& header) {
  RuleContext c;
  c.diagonal = header.bounds.diagonal();
  c.voxel = header.frame.voxel;
  c.may_orient = true;
  return c;
}

/// Returns the voxels that bpscale and bpclose make with a file of rules: through the JSON of a stream's header.
std::unique_ptr<BrickShelf> by_the_pipe(const std::string& rules, const LiveScene& scene, BrickShelf& solid) {
  CloseOptions options;
  options.context.make_shelf = test::memory_shelves();
  options.context.memory.bytes = std::uint64_t(1) << 30;
  const ScalePlan plan = parse_scale_rules(rules, "rules.json", context_of(scene.header));
  const ScalePlan found = measured(plan, scene.header, solid, {0, options.context});
  const ScaleField field = parse_scale_field(to_json(found.field), "stream");
  Backends backends = test::plain_backends(1);
  ClosingParams params = scene.params;
  OrientationField cubes;
  if (!plan.orientation.empty())
    cubes = make_orientation(parse_orientation(plan.orientation, "rules.json"), scene.header, plan.field.base,
                             scene.triangles);
  if (!cubes.empty()) params.orientation = &cubes;
  return close_shelf(scene.header, solid, backends, field, params, options);
}

std::map<BrickCoord, BrickBits> bricks(const BrickShelf& shelf) {
  std::map<BrickCoord, BrickBits> all;
  for (const BrickCoord c : shelf.coords()) (void)shelf.get(c, all[c]);
  return all;
}

std::string random_rule(Random& random) {
  const auto number = [&](int lo, int hi) { return fmt::format("{}", random.between(lo * 64, hi * 64) / 64.0); };
  const auto point = [&] { return fmt::format("[{},{},{}]", number(-1, 11), number(-1, 6), number(-1, 7)); };
  std::string at = point();
  if (random.one_in(2)) {
    at = "[" + at;
    for (int i = random.between(1, 4); i > 0; --i) at += "," + point();
    at += "]";
  }
  const char* const mode = std::array{"set", "increase", "decrease", "erase"}[std::size_t(random.between(0, 3))];
  const std::string support = random.one_in(4) ? fmt::format(R"(,"support":{})", number(0, 2)) : "";
  return fmt::format(R"({{"at":{},"radius":{},"scale":{},"mode":"{}"{}}})", at, number(0, 3), number(0, 2), mode,
                     support);
}

std::string random_orientation(Random& random) {
  if (random.one_in(3)) return random.one_in(2) ? "null" : R"("auto")";
  std::string frames;
  for (int i = random.between(1, 3); i > 0; --i) {
    frames += fmt::format(R"({}{{"at":[{},{},{}],"frame":[{},{},{},{}]}})", frames.empty() ? "" : ",",
                          random.between(-1, 11), random.between(-1, 6), random.between(-1, 7), random.between(1, 4),
                          random.between(-3, 3), random.between(-3, 3), random.between(-3, 3));
  }
  return "[" + frames + "]";
}

void random_edit(Design& design, Random& random) {
  const int what = random.between(0, 11);
  if (what < 5) {
    design.add(random_rule(random));
  } else if (what == 5) {
    design.set_base(fmt::format("{}", random.between(1, 96) / 64.0), random.one_in(2));
  } else if (what == 6 && design.rules() > 0) {
    design.remove(std::size_t(random.between(0, int(design.rules()) - 1)));
  } else if (what == 7) {
    design.redo();
  } else if (what >= 10) {
    design.set_orientation(random_orientation(random), random.one_in(3));
  } else {
    design.undo();
  }
}

/// The pieces that a page holds. It takes those that changed.
struct Page {
  std::map<BrickCoord, SurfacePiece> pieces;
  std::uint64_t generation = 0;
  std::size_t changed = 0;  ///< pieces of the last answer
  GridFrame frame;

  void follow(const LiveClosing& live) {
    const LiveSurface::Change change = live.surface().since(generation);
    if (change.whole) pieces.clear();
    for (const BrickCoord c : change.bricks) pieces[c] = change.piece(c);
    generation = change.generation;
    changed = change.bricks.size();
    frame = change.frame;
  }
};

/// Compares the pieces that a page took one after the other with pieces that are made at once.
void check_pieces(const Page& page, const BrickShelf& drawn, const GridFrame& frame, const ScaleField& field) {
  CHECK(page.frame == frame);
  std::size_t faces = 0, expected = 0;
  for (const auto& [brick, piece] : page.pieces) faces += piece.faces.size();
  for (const BrickCoord c : drawn.coords()) {
    const VoxelBox box = voxels_of(c).grown(1);
    const SurfacePiece made = piece_of(drawn, c, field.sample(frame, box));
    expected += made.faces.size();
    if (made.faces.empty()) continue;
    REQUIRE(page.pieces.contains(c));
    const SurfacePiece& was = page.pieces.at(c);
    REQUIRE(was.faces == made.faces);
    REQUIRE(was.vertices.size() == made.vertices.size());
    for (std::size_t i = 0; i < made.vertices.size(); ++i) {
      REQUIRE(was.vertices[i].position == made.vertices[i].position);
      REQUIRE(was.vertices[i].normal == made.vertices[i].normal);
      REQUIRE(was.vertices[i].scale == made.vertices[i].scale);
    }
  }
  CHECK(faces == expected);
}

/// Half of the designs are drawn in coarser voxels now and then.
void random_design(std::uint64_t seed, int edits) {
  CAPTURE(seed);
  Random random(seed);
  LiveScene live_of = live_scene(scene(), 0.0625);
  live_of.params.element = random.one_in(3) ? StructuringElement::ball : StructuringElement::cube;
  if (random.one_in(2))
    live_of.most_faces = boundary_size(*live_of.solid).faces * std::uint64_t(random.between(5, 11)) / 10;
  BrickShelf& solid = *live_of.solid;
  const std::string begin = random.one_in(3) ? R"({"base": 0.25, "rules": [{"gap": 0.5}]})" : R"({"base": 0.4})";
  Design design(begin, "rules.json", context_of(live_of.header), live_of.header.frame);
  Backends backends = test::plain_backends(2);
  LiveClosing live(std::move(live_of), backends, [] {});
  Page page;
  for (int i = 0; i < edits; ++i) {
    live.request(design.plan(), design.revision());
    if (random.one_in(3)) {  // a request that is replaced leaves no trace
      random_edit(design, random);
      live.request(design.plan(), design.revision());
    }
    live.wait();
    const LiveClosing::Status status = live.status();
    REQUIRE(status.error.empty());
    REQUIRE(status.shown == design.revision());
    if (random.one_in(2)) page.follow(live);
    REQUIRE(bricks(*live.closing()) == bricks(*by_the_pipe(design.json(), live.scene(), solid)));
    random_edit(design, random);
  }
  live.request(design.plan(), design.revision());
  live.wait();
  page.follow(live);
  CloseOptions options;
  options.context.make_shelf = test::memory_shelves();
  const ScaleField field = measured(design.plan(), live.scene().header, solid, {0, options.context}).field;
  const GridFrame frame = live.scene().header.frame;
  if (live.status().drawn_voxel == frame.voxel) return check_pieces(page, *live.closing(), frame, field);
  test::MemoryShelf coarse;
  reduce(*live.closing(), frame, coarse);
  check_pieces(page, coarse, reduced(frame), field);
}

}  // namespace

TEST_CASE("the closing shown is that of the pipe after strokes, undo and redo", "[quick][live]") {
  for (const std::uint64_t seed : {1, 2, 3}) random_design(seed, 8);
}

TEST_CASE("the closing shown is that of the pipe after a hundred random designs", "[property][live]") {
  for (std::uint64_t seed = 100; seed < 120; ++seed) random_design(seed, 10);
}

TEST_CASE("a frame turns the cubes of the closing, and undo turns them back", "[quick][live]") {
  LiveScene live_of = live_scene(scene(), 0.125);
  Design design(R"({"base": 0.5})", "rules.json", context_of(live_of.header), live_of.header.frame);
  Backends backends = test::plain_backends(2);
  LiveClosing live(std::move(live_of), backends, [] {});
  const auto closed = [&] {
    live.request(design.plan(), design.revision());
    live.wait();
    REQUIRE(live.status().error.empty());
    return bricks(*live.closing());
  };
  const auto upright = closed();
  design.set_orientation(R"([{"at": [5,2,3], "frame": [0.92,0,0,0.38]}])");
  CHECK(closed() != upright);
  design.undo();
  CHECK(closed() == upright);
}

TEST_CASE("the scene is read again for its orientation only where cells change", "[quick][live]") {
  LiveScene live_of = live_scene(scene(), 0.125);
  int reads = 0;
  live_of.triangles = [&, read = live_of.triangles](const auto& take) {
    ++reads;
    read(take);
  };
  Design design(R"({"base": 1.1, "orientation": "auto"})", "rules.json", context_of(live_of.header),
                live_of.header.frame);
  Backends backends = test::plain_backends(2);
  LiveClosing live(std::move(live_of), backends, [] {});
  const auto close_with = [&](const char* base) {
    design.set_base(base);
    live.request(design.plan(), design.revision());
    live.wait();
    REQUIRE(live.status().error.empty());
  };
  close_with("1.2");  // 9.6 voxels: cells of 16
  close_with("1.3");
  CHECK(reads == 1);
  close_with("2.2");  // 17.6 voxels: cells of 32
  CHECK(reads == 2);
}

TEST_CASE("a rule that cannot be closed by is an error, and the next one is not", "[quick][live]") {
  LiveScene live_of = live_scene(scene(), 0.25);
  live_of.context.memory.bytes = 1000;  // not even a tile fits
  Backends backends = test::plain_backends(1);
  LiveClosing live(std::move(live_of), backends, [] {});
  ScalePlan plan;
  plan.field.base = 1;
  live.request(plan, 1);
  live.wait();
  CHECK_FALSE(live.status().error.empty());
  CHECK_FALSE(live.status().busy());
  CHECK(live.surface().since(0).bricks.empty());
}

TEST_CASE("a stroke changes the pieces near it, and no other", "[quick][live]") {
  test::Triangles far = scene();
  for (TriangleD t : scene()) {
    for (Vec3d& p : t) p[0] += 40;
    far.push_back(t);
  }
  Backends backends = test::plain_backends(2);
  LiveScene live_of = live_scene(far, 0.0625);
  Design design(R"({"base": 0.4})", "rules.json", context_of(live_of.header), live_of.header.frame);
  LiveClosing live(std::move(live_of), backends, [] {});
  live.request(design.plan(), design.revision());
  live.wait();
  Page page;
  page.follow(live);
  const std::size_t all = page.changed;
  design.add(R"({"at": [2,2,1], "radius": 0.5, "scale": 0.1, "mode": "decrease"})");
  live.request(design.plan(), design.revision());
  live.wait();
  const LiveSurface::Change change = live.surface().since(page.generation);
  CHECK_FALSE(change.whole);
  CHECK_FALSE(change.bricks.empty());
  CHECK(change.bricks.size() * 2 < all);
  for (const BrickCoord c : change.bricks) CHECK(c.x < 6);
}

TEST_CASE("voxels with too many faces are drawn as coarser ones, and again as they are", "[quick][live]") {
  LiveScene live_of = live_scene(scene(), 0.0625);
  const double voxel = live_of.header.frame.voxel;
  live_of.most_faces = boundary_size(*live_of.solid).faces * 9 / 10;
  Design design(R"({"base": 0.06})", "rules.json", context_of(live_of.header), live_of.header.frame);
  Backends backends = test::plain_backends(2);
  LiveClosing live(std::move(live_of), backends, [] {});
  Page page;
  const auto drawn = [&](const char* base) {
    design.set_base(base);
    live.request(design.plan(), design.revision());
    live.wait();
    REQUIRE(live.status().error.empty());
    page.follow(live);
    return live.status().drawn_voxel / voxel;
  };
  CHECK(drawn("0.01") == 2);
  CHECK(page.frame.voxel == 2 * voxel);
  const std::uint64_t before = page.generation;
  CHECK(drawn("1.5") == 1);
  CHECK(page.frame.voxel == voxel);
  const LiveSurface::Change late = live.surface().since(before - 1);  // of a page that has seen neither
  CHECK(late.whole);
  CHECK(late.bricks.size() == page.changed);
}
