#include "lib/check/detail/hidden.h"
#include "lib/check/verdict_text.h"
#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Returns a room with walls of 3 around (0,0,0)..(32,24,24), open at x = 32 by a door of 6 x 13: 4 voxels wide, since
/// voxels that the walls touch count. Voxels have an edge of 1. The half of the door behind its middle is added to the
/// room by a closing.
IndexedMesh room() {
  IndexedMesh m = box({-3, -3, -3}, {35, 27, 0});
  for (const auto& [lo, hi] : std::vector<std::pair<Vec3d, Vec3d>>{{{-3, -3, 24}, {35, 27, 27}},
                                                                   {{-3, -3, 0}, {0, 27, 24}},
                                                                   {{0, -3, 0}, {35, 0, 24}},
                                                                   {{0, 24, 0}, {35, 27, 24}},
                                                                   {{32, 0, 0}, {35, 8, 24}},
                                                                   {{32, 14, 0}, {35, 24, 24}},
                                                                   {{32, 8, 13}, {35, 14, 24}}})
    m = join(m, box(lo, hi));
  return m;
}

/// Checks a proxy in the room, or with `scene` elsewhere.
CheckReport hidden_in(const IndexedMesh& scene, const IndexedMesh& proxy, double scale,
                      std::uint64_t memory_bytes = 1 << 28, double body = 0) {
  VectorSource source(triangles_of(scene)), walls(triangles_of(scene));
  CheckOptions options;
  options.inside = true;
  options.scene_memory_bytes = memory_bytes;
  HidingRecipe recipe;
  recipe.frame.origin = {-8, -8, -8};
  recipe.scale_world = scale;
  recipe.body_world = body;
  recipe.frame.up = UpAxis::z;
  recipe.opaque_only = true;
  options.hidden = HidingQuestion{recipe, &walls};
  return check_proxy(proxy, &source, options);
}

}  // namespace

TEST_CASE("a proxy in a room is hidden once its door is closed", "[quick][check][occluder]") {
  const IndexedMesh proxy = box({4, 4, 4}, {28, 20, 20});
  const CheckReport closed = hidden_in(room(), proxy, 4.0625);
  CHECK(closed.asks_hidden);
  CHECK(closed.answer() == Answer::proven);
  CHECK(hidden_in(room(), proxy, 1.5).answer() == Answer::refuted);
  const CheckReport without = hidden_in(room(), proxy, 0);
  CHECK(without.answer() == Answer::refuted);
  CHECK(without.exposed.count > 0);
}

TEST_CASE("a proxy in a room that a body enters is refuted", "[quick][check][occluder]") {
  const IndexedMesh proxy = box({4, 4, 4}, {28, 20, 20});
  const std::uint64_t memory = 1 << 28;
  CHECK(hidden_in(room(), proxy, 4.0625, memory, 9).answer() == Answer::refuted);
  CHECK(hidden_in(room(), proxy, 4.0625, memory, 14).answer() == Answer::proven);  // the door is less high
  CHECK(hidden_in(room(), proxy, 4.0625, memory, -1).answer() == Answer::undecided);
  const std::string text = verdict_text(hidden_in(room(), proxy, 4.0625, memory, 14), "p.obj");
  CHECK(text.find("rooms count as outside if a body 14 high, z up, and 4.667 wide along the axes can enter") !=
        std::string::npos);
}

TEST_CASE("inner walls may lie in what is hidden", "[quick][check][occluder]") {
  const CheckReport r = hidden_in(join(room(), box({14, 0, 0}, {15, 24, 24})), box({8, 8, 8}, {26, 16, 16}), 4.0625);
  CHECK(r.touching.count > 0);
  CHECK(r.insideness() == Answer::refuted);
  CHECK(r.answer() == Answer::proven);
}

TEST_CASE("a proxy that comes a voxel out of what is hidden is refuted, with a place", "[quick][check][occluder]") {
  CHECK(hidden_in(room(), box({4, 4, 4}, {28, 20, 20}), 4.0625).answer() == Answer::proven);
  CHECK(hidden_in(room(), box({2, 2, 2}, {30, 22, 26}), 4.0625).answer() == Answer::proven);  // and in the ceiling
  for (const IndexedMesh& proxy : {box({2, 2, 2}, {33, 22, 12}), box({2, 2, 2}, {30, 22, 27}),
                                   join(box({4, 4, 4}, {28, 20, 20}), box({36, -2, -2}, {38, 0, 0}))}) {
    const CheckReport r = hidden_in(room(), proxy, 4.0625);
    CHECK(r.answer() == Answer::refuted);
    REQUIRE(r.exposed.count > 0);
    CHECK(r.exposed.examples[0].position[0] > 0);
    CHECK(first_place(r) == r.exposed.examples[0].position);  // other places are not printed
  }
}

TEST_CASE("a proxy around the scene swallows what is not hidden", "[quick][check][occluder]") {
  CHECK(hidden_in(room(), box({-7, -7, -7}, {40, 40, 40}), 4.0625).answer() == Answer::refuted);
  // A proxy that touches no open voxel: it is around the whole box of voxels.
  CHECK(hidden_in(room(), box({-200, -200, -200}, {200, 200, 200}), 4.0625).answer() == Answer::refuted);
}

TEST_CASE("what cannot be told of hiding is not decided, and says why", "[quick][check][occluder]") {
  const IndexedMesh proxy = box({4, 4, 4}, {28, 20, 20});
  const CheckReport little = hidden_in(room(), proxy, 4.0625, 1000);
  CHECK(little.answer() == Answer::undecided);
  CHECK(little.hidden_unknown.find("memory") != std::string::npos);
  CHECK(hidden_in(room(), proxy, 4.0625, little.hidden_bytes).answer() == Answer::proven);
  CHECK(hidden_in(room(), proxy, 1e9).answer() == Answer::undecided);
  CHECK(hidden_in(room(), proxy, -1).answer() == Answer::undecided);
}

TEST_CASE("vertices beside the lattice are hidden, seen, or too near to tell", "[quick][check][occluder]") {
  const auto answer = [](double x) {
    return hidden_in(room(), box({4.001, 4.5, 4.5}, {x, 19.5, 19.5}), 4.0625).answer();
  };
  double side = 29;  // of the first voxel along x that is not hidden
  REQUIRE(answer(side - 0.5) == Answer::proven);
  while (side < 40 && answer(side + 0.5) == Answer::proven) ++side;
  CHECK(answer(side - 1e-3) == Answer::proven);
  CHECK(answer(side + 1e-3) == Answer::refuted);
  CHECK(answer(side - 1e-7) == Answer::undecided);
  CHECK(answer(side + 1e-7) == Answer::undecided);
}

TEST_CASE("the verdict says which gaps count as closed", "[quick][check][occluder]") {
  HidingRecipe recipe;
  CHECK(recipe.closed_gap() == Approx(2 * std::sqrt(3)));
  recipe.scale_world = 2, recipe.element = StructuringElement::ball;
  CHECK(recipe.closed_gap() == Approx(2 * std::sqrt(3) + 4 + 0.125));
  const std::string text = verdict_text(hidden_in(room(), box({4, 4, 4}, {28, 20, 20}), 4.0625), "p.obj");
  CHECK(text.find(
            "hidden from outside         yes, if gaps narrower than 17.75 count as closed: its file names voxels of "
            "1 and a closing scale of 4.062") != std::string::npos);
}

TEST_CASE("a proxy strictly inside a closed scene needs no voxels", "[quick][check][occluder]") {
  const CheckReport r = hidden_in(cube(10), cube(1), 4, 1000);
  CHECK(r.answer() == Answer::proven);
  CHECK_FALSE(r.asks_hidden);
}

TEST_CASE("a triangle meets the open cube of a voxel, not its faces", "[quick][check][occluder]") {
  const auto meets = [](const std::array<LatticeCoord, 3>& t) { return meets_open_voxel(t, {1, -1, 0}); };
  CHECK(meets({{{70, -60, 3}, {71, -60, 3}, {70, -59, 4}}}));
  CHECK(meets({{{0, -200, 32}, {400, -32, 32}, {0, 200, 32}}}));
  CHECK_FALSE(meets({{{64, -64, 0}, {128, -64, 0}, {64, 0, 0}}}));      // in a face
  CHECK_FALSE(meets({{{64, -64, 0}, {128, -64, 64}, {128, -80, 0}}}));  // along an edge
  CHECK_FALSE(meets({{{128, 0, 64}, {200, 10, 80}, {300, 20, 64}}}));   // at a corner
  CHECK(meets({{{127, -1, 63}, {200, 10, 80}, {300, 20, 64}}}));
  CHECK(meets({{{64, -64, 0}, {128, 0, 64}, {64, 0, 0}}}));            // through its middle
  CHECK_FALSE(meets({{{64, -32, -32}, {64, -32, 96}, {0, 40, 32}}}));  // beside an edge's middle
}
