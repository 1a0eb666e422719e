// Tests of parts of a scene that are left out, or may be drawn in another way.
#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

namespace {

/// A scene whose reader counts one surface that it does not deliver.
class PartialSource final : public VectorSource {
 public:
  PartialSource(std::vector<TriangleD> triangles, std::uint64_t SceneCounts::*left_out)
      : VectorSource(std::move(triangles)), left_out_(left_out) {}
  [[nodiscard]] const SceneCounts& counts() const override {
    told_ = VectorSource::counts();
    told_.*left_out_ = 1;
    return told_;
  }

 private:
  std::uint64_t SceneCounts::*left_out_;
  mutable SceneCounts told_;
};

/// Ten times a polygon of the first `corners` points, as its fan.
class FanSource final : public VectorSource {
 public:
  FanSource(const std::vector<Vec3d>& points, std::size_t corners, std::size_t batch)
      : VectorSource(fans(points, corners), batch), parts_(corners - 2) {}
  bool read_faces(std::vector<TriangleD>& out, std::vector<TriangleColors>&,
                  std::vector<std::uint8_t>& inner_edges) override {
    const bool more = read(out);
    inner_edges.clear();
    for (std::size_t i = 0; i < out.size(); ++i, ++next_) {
      const std::size_t part = next_ % parts_;
      inner_edges.push_back(
          std::uint8_t((part > 0 ? kSamePolygonBefore : 0) | (part + 1 < parts_ ? kSamePolygonAfter : 0)));
    }
    return more;
  }
  void rewind() override {
    VectorSource::rewind();
    next_ = 0;
  }

 private:
  static std::vector<TriangleD> fans(const std::vector<Vec3d>& points, std::size_t corners) {
    std::vector<TriangleD> all;
    for (int i = 0; i < 10; ++i)
      for (std::size_t k = 2; k < corners; ++k) all.push_back({points[0], points[k - 1], points[k]});
    return all;
  }
  std::size_t parts_, next_ = 0;
};

}  // namespace

TEST_CASE("of a scene that was not read as a whole nothing is proven, and what is refuted stays so", "[quick][check]") {
  const auto answer = [](double half, std::uint64_t SceneCounts::*left_out, bool inside) {
    PartialSource source(triangles_of(cube(half)), left_out);
    CheckOptions options;
    options.inside = inside;
    return check_proxy(cube(2), &source, options).answer();
  };
  for (const auto left_out : {&SceneCounts::non_finite, &SceneCounts::bad_faces, &SceneCounts::differing}) {
    CHECK(answer(1, left_out, false) == Answer::undecided);
    CHECK(answer(2, left_out, false) == Answer::refuted);
    CHECK(answer(3, left_out, true) == Answer::undecided);
  }
  CHECK(answer(1, &SceneCounts::instances, false) == Answer::proven);
  CHECK(answer(3, &SceneCounts::instances, true) == Answer::proven);
}

TEST_CASE("quads that are not flat are told, and whether both of their diagonals are enclosed", "[quick][check]") {
  const auto told = [](double height, std::size_t corners, std::size_t batch) {
    FanSource source({{0, 0, 0}, {1, 0, height}, {1, 1, 0}, {0, 1, height}, {-0.5, 0.5, height}}, corners, batch);
    const CheckReport r =
        check_proxy(box({-1, -1, -1}, {2, 2, 0.25}), &source);  // z = height / 2 amid the other diagonal
    CHECK(r.holds() == (height < 0.25));
    return std::pair(r.bent, r.bent_open);
  };
  using Pair = std::pair<std::uint64_t, std::uint64_t>;
  for (const std::size_t batch : {std::size_t(1), std::size_t(7)}) {
    CHECK(told(0, 4, batch) == Pair{0, 0});
    CHECK(told(0.125, 3, batch) == Pair{0, 0});
    CHECK(told(0.125, 4, batch) == Pair{10, 0});
    CHECK(told(0.125, 5, batch) == Pair{10, 10});
    CHECK(told(0.5, 4, batch) == Pair{10, 10});
  }
}
