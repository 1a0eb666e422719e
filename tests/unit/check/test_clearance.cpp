// Scenes and proxies whose coordinates were rounded when they were read.
#include "lib/check/detail/gap.h"
#include "lib/check/tile_cover.h"
#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

namespace {

/// A scene whose reader says how it rounded, once all was read.
class RoundedSource final : public VectorSource {
 public:
  RoundedSource(std::vector<TriangleD> triangles, Rounding rounding)
      : VectorSource(std::move(triangles)), rounding_(rounding) {}
  bool read(std::vector<TriangleD>& out) override {
    const bool more = VectorSource::read(out);
    counts_ = VectorSource::counts();
    if (!more) counts_.rounding = rounding_;
    return more;
  }
  [[nodiscard]] const SceneCounts& counts() const override { return counts_; }

 private:
  Rounding rounding_;
  SceneCounts counts_;
};

CheckReport check_rounded(const IndexedMesh& proxy, const IndexedMesh& scene, Rounding rounding,
                          const CheckOptions& options = {}) {
  RoundedSource source(triangles_of(scene), rounding);
  return check_proxy(proxy, &source, options);
}

}  // namespace

TEST_CASE("a proxy holds around a rounded scene only if it keeps clear of it", "[quick][check][rounding]") {
  const IndexedMesh scene = cube(1);
  CHECK(check_rounded(cube(1.01), scene, {}).answer() == Answer::proven);
  CHECK(check_rounded(cube(1.01), scene, {0, 0.005, 0.005}).answer() == Answer::proven);
  const CheckReport open = check_rounded(cube(1.01), scene, {0, 0.006, 0.006});
  CHECK(open.answer() == Answer::undecided);
  CHECK(open.within_rounding.count == 12);
  CHECK(check_rounded(cube(1.01), scene, {0.005, 0, 0}).answer() == Answer::proven);
  CHECK(check_rounded(cube(1.01), scene, {0.006, 0, 0}).answer() == Answer::undecided);
  CHECK(check_rounded(cube(0.99), scene, {0, 0.1, 0.1}).answer() == Answer::undecided);  // wrong as read, by less
  CHECK(check_rounded(cube(0.5), scene, {0, 0.1, 0.1}).answer() == Answer::refuted);
}

TEST_CASE("a stray triangle far away changes nothing near the origin", "[quick][check][rounding]") {
  const Rounding single{0x1p-20, 0, 0};
  IndexedMesh scene = join(cube(1), cube(1, {1e6, 0, 0}));
  const IndexedMesh near = cube(1.01), loose = cube(11, {1e6, 0, 0}), tight = cube(1.01, {1e6, 0, 0});
  CHECK(check_rounded(join(near, loose), scene, single).answer() == Answer::proven);
  const CheckReport open = check_rounded(join(near, tight), scene, single);
  CHECK(open.answer() == Answer::undecided);
  CHECK(open.within_rounding.count == 12);
}

TEST_CASE("a rounded proxy must keep clear of an exact scene", "[quick][check][rounding]") {
  IndexedMesh proxy = cube(1.01);
  proxy.rounding.offset = 0.005;
  CHECK(check_rounded(proxy, cube(1), {}).answer() == Answer::proven);
  proxy.rounding.offset = 0.006;
  CHECK(check_rounded(proxy, cube(1), {}).answer() == Answer::undecided);
}

TEST_CASE("a margin is kept only if it is kept by as much as coordinates may be off", "[quick][check][rounding]") {
  CheckOptions options;
  options.margin_world = 0.5;
  CHECK(check_rounded(cube(1.52), cube(1), {0, 0.01, 0.01}, options).answer() == Answer::proven);
  const CheckReport open = check_rounded(cube(1.51), cube(1), {0, 0.01, 0.01}, options);
  CHECK(open.keeps_margin() == Answer::undecided);
  CHECK(open.enclosure() == Answer::proven);
}

TEST_CASE("an inner proxy and convex parts keep clear, too", "[quick][check][rounding]") {
  CheckOptions inside, convex;
  inside.inside = convex.convex = true;
  CHECK(check_rounded(cube(0.99), cube(1), {0, 0.005, 0.005}, inside).answer() == Answer::proven);
  CHECK(check_rounded(cube(0.99), cube(1), {0, 0.006, 0.006}, inside).answer() == Answer::undecided);
  const IndexedMesh parts = join(box({-1.1, -1.1, -1.1}, {0.5, 1.1, 1.1}), box({-0.5, -1.1, -1.1}, {1.1, 1.1, 1.1}));
  CHECK(check_rounded(parts, cube(1), {}, convex).answer() == Answer::proven);
  CHECK(check_rounded(parts, cube(1), {0, 0.001, 0.001}, convex).answer() == Answer::proven);
  CHECK(check_rounded(parts, cube(1), {0, 0.055, 0.055}, convex).answer() == Answer::proven);  // less than they leave
  CHECK(check_rounded(parts, cube(1), {0, 0.06, 0.06}, convex).answer() == Answer::undecided);
  CHECK(check_rounded(parts, cube(1), {0, 0.2, 0.2}, convex).answer() == Answer::undecided);
}

TEST_CASE("tiles keep clear of what a rounded scene has in their cells", "[quick][check][rounding]") {
  const auto answer = [](const std::optional<Bounds3d>& cell, double offset) {
    CoverTile root;
    root.place = "root", root.uri = "a.glb";
    root.triangles = 12;
    root.cell = cell;
    RoundedSource scene(triangles_of(cube(1)), {0, offset, offset});
    const CoverReport report = check_cover(
        {root}, [](std::size_t) { return cube(1.01); }, scene);
    return report.findings.empty() ? Answer::proven : report.findings[0].answer;
  };
  const Bounds3d cell{{-2, -2, -2}, {2, 2, 2}};
  CHECK(answer(cell, 0) == Answer::proven);
  CHECK(answer(cell, 1e-10) == Answer::proven);
  CHECK(answer(cell, 0.005) == Answer::proven);  // more than cells are grown by
  CHECK(answer(cell, 0.006) == Answer::undecided);
  const Bounds3d tight{{-1, -1, -1}, {1, 1, 1}};  // the scene may leave it
  CHECK(answer(tight, 0) == Answer::proven);
  CHECK(answer(tight, 1e-6) == Answer::undecided);
  CHECK(answer({}, 0.005) == Answer::proven);
  CHECK(answer({}, 0.006) == Answer::undecided);
}

TEST_CASE("a triangle that lies in the next cell, but for rounding, counts there, too", "[quick][check][rounding]") {
  // The octant of the second child begins where the scene ends, and its content ends nearer to it than it may be off.
  const auto findings = [](double offset, bool with_neighbour) {
    std::vector<CoverTile> tiles(with_neighbour ? 3 : 2);
    tiles[0].place = "root", tiles[0].cell = {{{-2, -2, -2}, {2, 2, 2}}};
    tiles[1].place = "a", tiles[1].uri = "a.glb", tiles[1].triangles = 12, tiles[1].cell = {{{-2, -2, -2}, {0, 0, 0}}};
    tiles[0].children = {1};
    if (with_neighbour) {
      tiles[2] = tiles[1], tiles[2].place = "b", tiles[2].cell = {{{0, -2, -2}, {2, 0, 0}}};
      tiles[0].children = {1, 2};
    }
    RoundedSource scene(triangles_of(box({-1, -1.5, -1.5}, {-1e-4, -0.5, -0.5})), {0, offset, offset});
    const auto content = [](std::size_t) { return box({-1.1, -1.6, -1.6}, {0.1, -0.4, -0.4}); };
    return check_cover(tiles, content, scene).findings;
  };
  CHECK(findings(0, false).empty());
  CHECK(findings(1e-5, false).empty());
  const std::vector<TileFinding> open = findings(1e-3, false);
  REQUIRE(open.size() == 1);
  CHECK(open[0].answer == Answer::undecided);
  CHECK(findings(1e-3, true).empty());
}

TEST_CASE("triangles as near to each other as doubles tell are parted by planes across them", "[quick][check]") {
  // The direction between the nearest points is lost in rounding, that of the large faces is not.
  const TriangleD a{{{-400, -300, 0}, {500, -200, 0}, {10, 700, 0}}}, b{{{0.3, 0.2, 1e-7}, {90, 80, 3}, {70, -60, 5}}};
  CHECK(keeps_gap(a, b, 0.999e-7) == Answer::proven);
  CHECK(keeps_gap(b, a, 0.999e-7) == Answer::proven);
  CHECK(keeps_gap(a, b, 1.001e-7) != Answer::proven);
}
