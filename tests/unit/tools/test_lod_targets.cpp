#include "lib/core/error.h"
#include "tests/catch.h"
#include "tools/lod/lod_targets.h"

using namespace bp;

namespace {

using Faces = std::vector<std::uint64_t>;

/// Budgets of the levels of a scene of so many triangles.
Faces budgets(const LodRequest& request, std::uint64_t triangles, const LodDefaults& defaults = {}) {
  const LodRequest r = request_for(request, triangles, defaults);
  Faces faces;
  for (std::size_t i = 0; i < level_count(r); ++i) faces.push_back(target_of(r, i, 0, 1, 0.001, 1000000).faces);
  return faces;
}

}  // namespace

TEST_CASE("levels that nobody asked for follow from the triangles of the scene", "[quick][tools]") {
  CHECK(budgets({}, 28617) == Faces{14308, 3577, 894, 223});
  CHECK(budgets({}, 1000) == Faces{500, 125, 31});
  CHECK(budgets({}, 300) == Faces{200, 50, 12});
  CHECK(budgets({}, 60) == Faces{60, 15});
  CHECK(budgets({}, 12) == Faces{12});
  CHECK(budgets({}, 1) == Faces{12});
  CHECK(budgets({}, 1000000) == Faces{kMostDefaultFaces, kMostDefaultFaces / 4, kMostDefaultFaces / 16, 625});
  CHECK(budgets({}, 100000000).front() == kMostDefaultFaces);
  LodRequest two;
  two.levels = 2;
  CHECK(budgets(two, 28617) == Faces{14308, 3577});
  CHECK(budgets(two, 12) == Faces{12, 12});  // which is left out when it is made
}

TEST_CASE("voxels that were named decide the faces, up to those of the scene", "[quick][tools]") {
  LodDefaults named;
  named.by_voxels = true;
  CHECK(budgets({}, 500000, named) == Faces{10000, 2500, 625, 156});
  CHECK(budgets({}, 4000, named) == Faces{2000, 500, 125, 31});
  CHECK(budgets({}, 12, named) == Faces{12});
}

TEST_CASE("faces as percentages of the triangles of the scene", "[quick][tools]") {
  LodRequest r;
  r.shares = {50, 10, 2};
  CHECK(asks_for_faces(r));
  CHECK(level_count(r) == 3);
  CHECK(budgets(r, 28617) == Faces{14309, 2862, 572});
  CHECK(budgets(r, 20) == Faces{10, 4, 4});
  r.shares = {50};
  CHECK(budgets(r, 1000) == Faces{500});
  r.levels = 3;
  CHECK(budgets(r, 1000) == Faces{500, 125, 31});
  r.errors = {Length{1, Length::Unit::scene}};
  CHECK_THROWS_AS(check(r), Error);
}

TEST_CASE("what was asked for does not depend on the scene", "[quick][tools]") {
  LodRequest r;
  r.faces = {5000};
  CHECK(budgets(r, 12) == Faces{5000});
  LodRequest by_error;
  by_error.errors = {Length{1, Length::Unit::scene}};
  CHECK(budgets(by_error, 100000) == Faces{0});
}
