#include "lib/levels/level_request.h"
#include "tests/catch.h"

using namespace bp;

namespace {

using Faces = std::vector<std::uint64_t>;

/// Budgets of the levels of a scene of so many triangles.
Faces budgets(const LevelRequest& request, std::uint64_t triangles, const LevelDefaults& defaults = {}) {
  const LevelRequest r = with_defaults(request, triangles, defaults);
  Faces faces;
  for (std::size_t i = 0; i < level_count(r); ++i) faces.push_back(level_target(r, i, 0, 1000000).faces);
  return faces;
}

}  // namespace

TEST_CASE("levels that nobody asked for follow from the triangles of the scene", "[quick][levels]") {
  CHECK(budgets({}, 28617) == Faces{10000, 2500, 625, 156});
  CHECK(budgets({}, 8000) == Faces{4000, 1000, 250, 62});
  CHECK(budgets({}, 1000) == Faces{500, 125, 31});
  CHECK(budgets({}, 300) == Faces{200, 50, 12});
  CHECK(budgets({}, 60) == Faces{60, 15});
  CHECK(budgets({}, 12) == Faces{12});
  CHECK(budgets({}, 1) == Faces{12});
  CHECK(budgets({}, 1000000) == Faces{kMostDefaultFaces, kMostDefaultFaces / 4, kMostDefaultFaces / 16, 156});
  CHECK(budgets({}, 100000000).front() == kMostDefaultFaces);
  LevelRequest two;
  two.levels = 2;
  CHECK(budgets(two, 28617) == Faces{10000, 2500});
  CHECK(budgets(two, 12) == Faces{12, 12});  // which is left out when it is made
}

TEST_CASE("a body for collisions may have more faces than a scene of few triangles", "[quick][levels]") {
  LevelDefaults body{8, kMostCollisionFaces, kLeastFirstFaces};
  LevelRequest one;
  one.levels = 1;
  CHECK(budgets(one, 54, body) == Faces{200});
  CHECK(budgets(one, 8000, body) == Faces{1000});
  CHECK(budgets(one, 1000000, body) == Faces{kMostCollisionFaces});
}

TEST_CASE("voxels that were named decide the faces, up to those of the scene", "[quick][levels]") {
  LevelDefaults named;
  named.by_voxels = true;
  CHECK(budgets({}, 500000, named) == Faces{10000, 2500, 625, 156});
  CHECK(budgets({}, 4000, named) == Faces{2000, 500, 125, 31});
  CHECK(budgets({}, 12, named) == Faces{12});
}

TEST_CASE("faces as percentages of the triangles of the scene", "[quick][levels]") {
  LevelRequest r;
  r.shares = {50, 10, 2};
  CHECK(asks_for_faces(r));
  CHECK(level_count(r) == 3);
  CHECK(budgets(r, 28617) == Faces{14309, 2862, 572});
  CHECK(budgets(r, 20) == Faces{10, 4, 4});
  r.shares = {50};
  CHECK(budgets(r, 1000) == Faces{500});
  r.levels = 3;
  CHECK(budgets(r, 1000) == Faces{500, 125, 31});
}

TEST_CASE("what was asked for does not depend on the scene", "[quick][levels]") {
  LevelRequest r;
  r.faces = {5000};
  CHECK(budgets(r, 12) == Faces{5000});
  LevelRequest by_error;
  by_error.errors_world = {1};
  CHECK(budgets(by_error, 100000) == Faces{0});
}

TEST_CASE("errors double from level to level, and so do scales", "[quick][levels]") {
  LevelRequest r;
  r.errors_world = {0.5};
  r.scale_world = 2;
  r.levels = 3;
  CHECK(level_target(r, 2, 0, 1000).error_world == 2);
  CHECK(*level_target(r, 2, 0, 1000).scale_world == 8);
  r.errors_world = {0.5, 3, 4};
  CHECK(level_target(r, 1, 0, 1000).error_world == 3);
}

TEST_CASE("a mesh with clearly fewer faces than its budget is told from one with about as many", "[quick][levels]") {
  CHECK(clearly_fewer(949, 1000));
  CHECK_FALSE(clearly_fewer(950, 1000));
  CHECK_FALSE(clearly_fewer(12, 13));
  CHECK(clearly_fewer(12, 14));
  CHECK_FALSE(clearly_fewer(12, 0));
}
