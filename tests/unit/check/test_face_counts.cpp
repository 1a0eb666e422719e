#include "lib/check/face_counts.h"
#include "lib/core/triangle_source.h"
#include "tests/catch.h"

using namespace bp;

namespace {

/// Triangles of a polygon.
constexpr std::uint8_t kFirst = kSamePolygonAfter, kLast = kSamePolygonBefore, kInner = kFirst | kLast;

FaceCounts counted(const std::vector<std::uint8_t>& inner_edges, std::uint64_t plain = 0) {
  FaceCounts faces;
  faces.add(inner_edges, plain);
  return faces;
}

}  // namespace

TEST_CASE("faces are counted by the triangles that they were cut into", "[quick][core]") {
  // A triangle, two quads, a pentagon, a triangle; then three more without inner edges.
  const std::vector<std::uint8_t> edges{0, kFirst, kLast, kFirst, kLast, kFirst, kInner, kLast, 0};
  const FaceCounts faces = counted(edges, 3);
  CHECK(faces.triangles == 5);
  CHECK(faces.quads == 2);
  CHECK(faces.polygons == 1);
  CHECK(faces.cut == 12);
  for (std::size_t split = 0; split <= edges.size(); ++split) {  // batches may end within a face
    FaceCounts both;
    both.add(std::span(edges).first(split));
    both.add(std::span(edges).subspan(split), 3);
    CHECK((both.triangles == 5 && both.quads == 2 && both.polygons == 1 && both.cut == 12));
  }
}

TEST_CASE("what is left of a face without its skipped triangles counts as a smaller one", "[quick][core]") {
  const FaceCounts faces = counted(
      {kFirst, kFirst, kLast, kLast, kFirst, kInner, kFirst, kInner, kLast});  // half, quad, half, two thirds, pentagon
  CHECK(faces.triangles == 2);
  CHECK(faces.quads == 2);
  CHECK(faces.polygons == 1);
  CHECK(counted({kFirst}, 1).triangles == 2);  // the next mesh does not go on with a face of the last one
}

TEST_CASE("faces are told in words, triangles always", "[quick][core]") {
  CHECK(counted({}).text() == "0 triangles");
  CHECK(counted({0, 0}).text() == "2 triangles");
  CHECK(counted({kFirst, kLast, kFirst, kLast}).text() == "2 quads, 4 triangles");
  CHECK(counted({kFirst, kLast, 0}).text() == "1 quad and 1 triangle, 3 triangles when cut");
  CHECK(counted({kFirst, kInner, kLast, kFirst, kLast, 0}).text() ==
        "1 larger polygon and 1 quad and 1 triangle, 6 triangles when cut");
}
