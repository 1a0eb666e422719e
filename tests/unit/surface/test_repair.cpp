#include "lib/surface/repair.h"
#include "tests/catch.h"

using namespace bp;

namespace {

/// By the definition: around the centre of a block, the faces between occupied and empty cells form one closed fan.
/// Each of the 12 inner squares (pairs of face-neighbours) is a face if exactly one of its cells is occupied; squares
/// that share one of the 6 half-edges from the centre are linked; manifold if every half-edge has 0 or 2 faces and the
/// faces form one cycle.
bool manifold_by_definition(unsigned block) {
  struct Face {
    int edges[2];
  };
  std::vector<Face> faces;
  for (int i = 0; i < 8; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const int j = i | (1 << axis);
      if (j == i || ((block >> i) & 1) == ((block >> j) & 1)) continue;
      Face f{};
      int k = 0;
      for (int other = 0; other < 3; ++other) {
        if (other != axis) f.edges[k++] = 2 * other + ((i >> other) & 1);  // half-edge towards the square's side
      }
      faces.push_back(f);
    }
  }
  if (faces.empty()) return true;
  int uses[6] = {};
  for (const Face& f : faces) {
    ++uses[f.edges[0]];
    ++uses[f.edges[1]];
  }
  for (const int u : uses) {
    if (u != 0 && u != 2) return false;
  }
  int edge = faces[0].edges[0], length = 0;
  std::size_t at = 0;
  do {  // walk the cycle
    edge = faces[at].edges[0] == edge ? faces[at].edges[1] : faces[at].edges[0];
    ++length;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (i != at && (faces[i].edges[0] == edge || faces[i].edges[1] == edge)) {
        at = i;
        break;
      }
    }
  } while (at != 0 && length < 13);
  return length == int(faces.size());
}

}  // namespace

TEST_CASE("a corner is manifold exactly if its faces form one fan, on all 256 blocks", "[quick][meshing]") {
  for (unsigned block = 0; block < 256; ++block) {
    CAPTURE(block);
    CHECK(corner_is_manifold(Corner(block)) == manifold_by_definition(block));
  }
}

TEST_CASE("repair makes each of the 256 blocks manifold and only adds", "[quick][meshing]") {
  for (unsigned block = 0; block < 256; ++block) {
    CAPTURE(block);
    const Corner add = corner_repair(Corner(block));
    CHECK((add & block) == 0);
    CHECK((add == 0) == manifold_by_definition(block));
    CHECK(manifold_by_definition(block | add));
  }
}
