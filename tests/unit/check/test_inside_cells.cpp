// Cells that lie inside a surface decide what the exact tests of each triangle decide.
#include <random>

#include "lib/check/detail/cells/inside_cells.h"
#include "lib/check/detail/enclosure.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/exact/triangle_intersection.h"
#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr std::uint64_t kPlenty = std::uint64_t(64) << 20;

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  unsigned operator()(unsigned sides) { return unsigned(engine_() % sides); }

 private:
  std::mt19937 engine_;
};

struct Solid {
  IndexedMesh mesh;
  Vec3d middle{};
  double size = 1;
};

/// Closed and oriented, perhaps with thin parts, with hollows, or with parts that overlap. Its corners lie on a lattice
/// of powers of two or anywhere, near the origin or far from it.
Solid random_solid(Dice& dice) {
  Solid solid;
  const double unit = std::exp2(double(dice(9)) - 4);
  solid.size = 16 * unit;
  for (double& x : solid.middle) x = dice(3) == 0 ? 6e6 + double(dice(1000)) : unit * double(dice(40));
  const bool round = dice(2) == 0;
  const auto place = [&](double x) { return round ? std::round(x / unit) * unit : x; };
  for (unsigned parts = 1 + dice(4); parts > 0; --parts) {
    Vec3d low, high;
    for (std::size_t i = 0; i < 3; ++i) {
      const double at = solid.middle[i] + dice(-solid.size, solid.size);
      low[i] = place(at), high[i] = place(at + dice(0.0, solid.size));
      if (dice(6) == 0) high[i] = low[i] + unit / 64;  // thin
      if (high[i] <= low[i]) high[i] = low[i] + unit;
    }
    IndexedMesh part = box(low, high);
    if (dice(2) == 0) part = sphere(int(dice(3)), solid.size * dice(0.2, 1.0), low);
    if (dice(4) == 0) {
      for (Vec3d& p : part.vertices) p[0] += (p[1] - low[1]) / 3, p[2] -= (p[0] - low[0]) / 7;  // sheared
    }
    solid.mesh = join(std::move(solid.mesh), dice(5) == 0 ? inverted(part) : part);
  }
  return solid;
}

/// Boxes have any size, and many are small; corners on lattices and on corners of the solid are frequent.
TriangleD random_triangle(const Solid& solid, Dice& dice) {
  const double size = solid.size * std::exp2(-double(dice(12)));
  const double unit = solid.size / std::exp2(double(dice(12)));
  const auto corner = [&] { return solid.mesh.vertices[dice(unsigned(solid.mesh.vertices.size()))]; };
  Vec3d at = corner();
  if (dice(4) != 0) {  // between two corners of one part, as a rule
    const Vec3d to = corner();
    for (std::size_t i = 0; i < 3; ++i) at[i] += dice(0.0, 1.0) * (to[i] - at[i]);
  }
  TriangleD t;
  for (Vec3d& p : t) {
    for (std::size_t i = 0; i < 3; ++i) p[i] = at[i] + (dice(8) == 0 ? 0 : dice(-size, size));
    if (dice(3) == 0) {
      for (double& x : p) x = std::round(x / unit) * unit;
    }
  }
  return t;
}

struct Prepared {
  WeldedMesh mesh;
  std::optional<Surface> surface;
  explicit Prepared(const IndexedMesh& proxy) {
    CheckReport report;
    mesh = weld(proxy, 1, report);
    check_topology(mesh, 1, report);
    surface.emplace(mesh);
  }
};

bool is_enclosed(const Surface& surface, const TriangleD& t) {
  return surface.touched_by(t) == Surface::kNone && surface.winding(t[0]) >= 1;
}

/// A box is asked about with all that it holds: nothing crosses its sides, it holds no corner, and a corner of it is
/// inside.
bool is_enclosed(const Surface& surface, const IndexedMesh& proxy, const Bounds3d& b) {
  for (const TriangleD& side : triangles_of(box(b.min, b.max))) {
    if (!is_enclosed(surface, side)) return false;
  }
  return std::none_of(proxy.vertices.begin(), proxy.vertices.end(), [&](const Vec3d& p) {
    return b.contains(Bounds3d{p, p});
  });
}

/// Asks until all blocks that the box meets were looked at.
bool hold_at_last(const InsideCells& cells, const Bounds3d& box) {
  for (int visit = 0; visit < 300; ++visit) {
    if (cells.hold(box)) return true;
  }
  return false;
}

void check_same(const Finding& a, const Finding& b) {
  REQUIRE(a.count == b.count);
  REQUIRE(a.examples.size() == b.examples.size());
  for (std::size_t i = 0; i < a.examples.size(); ++i) {
    CHECK(a.examples[i].index == b.examples[i].index);
    CHECK(a.examples[i].other == b.examples[i].other);
    CHECK(a.examples[i].position == b.examples[i].position);
  }
}

}  // namespace

TEST_CASE("a triangle whose box lies in cells inside is enclosed by the exact tests", "[quick][check][cells]") {
  std::size_t held = 0, enclosed = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    Dice dice(seed);
    const Solid solid = random_solid(dice);
    const Prepared proxy(solid.mesh);
    const InsideCells cells(*proxy.surface, kPlenty);
    for (int i = 0; i < 400; ++i) {
      const TriangleD t = random_triangle(solid, dice);
      const bool exact = is_enclosed(*proxy.surface, t);
      enclosed += exact ? 1 : 0;
      if (!hold_at_last(cells, bounds_of(t))) continue;
      ++held;
      REQUIRE(exact);
    }
  }
  CHECK(held > enclosed / 2);  // large triangles near the surface are left
}

TEST_CASE("no corner or edge of a surface pokes into a box that cells hold", "[quick][check][cells]") {
  std::size_t held = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Dice dice(1000 + seed);
    const Solid solid = random_solid(dice);
    const Prepared proxy(solid.mesh);
    const InsideCells cells(*proxy.surface, kPlenty);
    for (int i = 0; i < 200; ++i) {
      Bounds3d b = bounds_of(random_triangle(solid, dice));
      for (std::size_t k = 0; k < 3; ++k) {
        if (!(b.min[k] < b.max[k])) b.max[k] = std::nextafter(b.min[k], HUGE_VAL);
      }
      if (!hold_at_last(cells, b)) continue;
      ++held;
      REQUIRE(is_enclosed(*proxy.surface, solid.mesh, b));
    }
  }
  CHECK(held > 1000);
}

TEST_CASE("cells hold all but a thin shell of a solid", "[quick][check][cells]") {
  const IndexedMesh solid = sphere(4, 10);
  const Prepared proxy(solid);
  const InsideCells cells(*proxy.surface, kPlenty);
  Dice dice(1);
  int held = 0;
  for (int i = 0; i < 200000; ++i) {
    const Vec3d p{dice(-5.5, 5.5), dice(-5.5, 5.5), dice(-5.5, 5.5)};
    held += cells.hold({p, p + Vec3d{0.01, 0.01, 0.01}}) ? 1 : 0;
  }
  CHECK(held > 170000);  // each block is looked at when the third box meets it
  for (const double near : {0.9, 0.95, 0.97}) {
    const double x = near * 10 / std::sqrt(3.0);
    CHECK(hold_at_last(cells, {{x, x, x}, {x, x, x}}));
  }
}

TEST_CASE("cells hold nothing of coordinates that are not numbers, or lie anywhere else", "[quick][check][cells]") {
  const IndexedMesh solid = cube(8);
  const Prepared proxy(solid);
  const InsideCells cells(*proxy.surface, kPlenty);
  const Bounds3d good{{-1, -1, -1}, {1, 1, 1}};
  REQUIRE(hold_at_last(cells, good));
  for (const double bad : {double(NAN), HUGE_VAL, -HUGE_VAL, 1e300, -1e300, 8.0, -8.0, 9.0}) {
    Bounds3d b = good;
    b.max[1] = bad;
    if (!(bad <= -1)) CHECK_FALSE(cells.hold(b));
    b = good;
    b.min[2] = bad;
    if (!(bad >= 1)) CHECK_FALSE(cells.hold(b));
  }
  CHECK_FALSE(cells.hold({}));
  CHECK_FALSE(hold_at_last(cells, {{-1e-320, -5e-324, 0}, {0, 5e-324, 1e-310}}));  // not known
  CHECK(hold_at_last(cells, {{0, 0, 0}, {0, 5e-324, 1e-310}}));
  const InsideCells none(*proxy.surface, 1000);  // of memory
  CHECK_FALSE(hold_at_last(none, good));
}

TEST_CASE("the report on a scene does not depend on cells", "[quick][check][cells]") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Dice dice(2000 + seed);
    const Solid solid = random_solid(dice);
    const Prepared proxy(solid.mesh);
    std::vector<TriangleD> scene;
    for (int i = 0; i < 3000; ++i) scene.push_back(random_triangle(solid, dice));
    scene.insert(scene.end(), scene.begin(), scene.end());  // blocks are known by now
    const EnclosureQuestion question{true, 0, 5};
    const auto report = [&](const InsideCells* cells) {
      VectorSource source(scene, 1 + dice(5000));
      SceneMemory memory(100, scene.size());
      return check_enclosure(proxy.mesh, *proxy.surface, cells, source, question, memory);
    };
    const EnclosureReport naive = report(nullptr);
    const ThreadLimit threads(1 + int(dice(8)));
    const InsideCells cells(*proxy.surface, kPlenty);
    const EnclosureReport fast = report(&cells);
    check_same(naive.touching, fast.touching);
    check_same(naive.outside, fast.outside);
    CHECK(naive.triangles == fast.triangles);
    CHECK(naive.bounds == fast.bounds);
    CHECK(naive.volume == fast.volume);
  }
}

TEST_CASE("one triangle in ten thousand that pokes through a wall is found beside cells", "[quick][check][cells]") {
  const IndexedMesh solid = join(cube(8), inverted(cube(2)));  // a hollow in the middle
  Dice dice(3);
  std::vector<TriangleD> scene;
  while (scene.size() < 10000) {
    const Vec3d p{dice(-7.9, 7.9), dice(-7.9, 7.9), dice(-7.9, 7.9)};
    if (std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) < 2.1) continue;
    scene.push_back(TriangleD{p, p + Vec3d{0.01, 0, 0}, p + Vec3d{0, 0.01, 0}});
  }
  REQUIRE(check(solid, scene).holds());
  const double over = std::nextafter(8.0, 9.0), under = std::nextafter(8.0, 7.0);
  for (const double x : {over, 8.0, -over, -8.0, 2.0, std::nextafter(2.0, 1.0)}) {
    std::vector<TriangleD> broken = scene;
    broken[9000][1] = {x, x > 2 || x < -2 ? 0.5 : 0.25, 0.5};
    broken[9000][0] = {x > 0 ? 5.0 : -5.0, 0.5, 0.5}, broken[9000][2] = {x > 0 ? 5.0 : -5.0, 0.5, 0.625};
    const CheckReport report = check(solid, broken);
    CAPTURE(x);
    CHECK(report.touching.count == 1);
    REQUIRE(report.touching.examples.size() == 1);
    CHECK(report.touching.examples[0].index == 9000);
  }
  scene[9000] = {{{5, 0.5, 0.5}, {under, 0.5, 0.5}, {5, 0.5, 0.625}}};
  CHECK(check(solid, scene).holds());
  scene[9000] = {{{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}}};  // in the hollow
  CHECK(check(solid, scene).outside.count == 1);
}
