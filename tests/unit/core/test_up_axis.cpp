#include "lib/core/up_axis.h"
#include "tests/catch.h"

using namespace bp;

TEST_CASE("the axis that points up becomes y, and the turn keeps the orientation", "[quick][core]") {
  const UpAxis up = UpAxis(GENERATE(range(0, 6)));
  CAPTURE(name_of(up));
  using Vector = std::array<int, 3>;
  constexpr Vector kUp[] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  const AxisTurn turn = to_y_up(up);
  CHECK(turn(kUp[std::size_t(up)]) == Vector{0, 1, 0});
  const Vector a = turn(Vector{1, 0, 0}), b = turn(Vector{0, 1, 0}), c = turn(Vector{0, 0, 1});
  const Vector cross{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  CHECK(cross == c);  // no mirror image
  CHECK(turn.inverse()(turn(Vector{1, 2, 3})) == Vector{1, 2, 3});
  for (int to = 0; to < 6; ++to)
    CHECK(turned(turned(Vector{1, 2, 3}, up, UpAxis(to)), UpAxis(to), up) == Vector{1, 2, 3});
  CHECK(up_axis_named(name_of(up)) == up);
  CHECK_FALSE(up_axis_named("+y"));
}
