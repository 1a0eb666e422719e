#include <cmath>
#include <filesystem>
#include <map>

#include "io/scene/scene_reader.h"
#include "lib/core/box.h"
#include "lib/core/error.h"
#include "samples/plant/parts.h"
#include "samples/plant/write.h"
#include "tests/catch.h"

using namespace plant;

namespace {

struct Measured {
  std::uint64_t triangles = 0;
  bp::Bounds3d bounds;
  double signed_volume = 0;
};

Measured measure(const std::filesystem::path& path) {
  Measured m;
  const auto source = bp::open_scene(path.string());
  std::vector<bp::TriangleD> triangles;
  while (source->read(triangles)) {
    for (const auto& [a, b, c] : triangles) {
      for (const auto& p : {a, b, c}) m.bounds.add(p);
      m.signed_volume += dot({a[0], a[1], a[2]}, cross({b[0], b[1], b[2]}, {c[0], c[1], c[2]})) / 6;
    }
  }
  CHECK(source->counts().non_finite + source->counts().degenerate + source->counts().bad_faces == 0);
  m.triangles = source->counts().triangles;
  return m;
}

Measured written(const Site& site, const char* name, void (*write)(const Site&, bp::OutputFile&)) {
  const auto path = std::filesystem::temp_directory_path() / name;
  bp::OutputFile file(path.string(), true);
  write(site, file);
  file.commit();
  const Measured m = measure(path);
  std::filesystem::remove(path);
  return m;
}

/// Edges of one part; a closed part has each edge once in each direction.
class EdgeSink : public Sink {
 public:
  Wants part(std::uint32_t, std::uint32_t) override {
    base_ += 1u << 20;
    return faces;
  }
  void face(std::uint32_t a, std::uint32_t b, std::uint32_t c) override {
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}})
      balance[{base_ + std::min(from, to), base_ + std::max(from, to)}] += from < to ? 1 : -1;
  }
  std::map<std::pair<std::uint64_t, std::uint64_t>, int> balance;

 private:
  std::uint64_t base_ = 0;
};

}  // namespace

TEST_CASE("a plant has the number of triangles that was asked for", "[quick][samples]") {
  const std::uint64_t wanted = GENERATE(10000u, 12345u, 50000u, 200000u, 3000000u, 100000000u, 1000000000u);
  const std::uint64_t seed = GENERATE(1u, 2u, 99u);
  CAPTURE(wanted, seed);
  const auto got = double(Site(wanted, seed).counts().triangles);
  CHECK(std::abs(got - double(wanted)) <= 0.01 * double(wanted));
}

TEST_CASE("a plant is the same scene as PLY and as instanced GLB", "[quick][samples]") {
  const Site site(400000, 3);
  const Measured ply = written(site, "bp-test-plant.ply", write_ply);
  const Measured glb = written(site, "bp-test-plant.glb", write_glb);
  CHECK(ply.triangles == site.counts().triangles);
  CHECK(glb.triangles == site.counts().triangles);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(std::abs(ply.bounds.min[i] - glb.bounds.min[i]) < 1e-3);
    CHECK(std::abs(ply.bounds.max[i] - glb.bounds.max[i]) < 1e-3);
  }
  CHECK(ply.bounds.min[1] == -0.5);
  // Mirrored placements keep the outside outside in both.
  CHECK(std::abs(ply.signed_volume - glb.signed_volume) < 1e-4 * std::abs(ply.signed_volume));
}

TEST_CASE("a changed plant differs in the vertices of one component", "[quick][samples]") {
  const Site site(20000, 3);
  const auto vertices = [&](void (*write)(const Site&, bp::OutputFile&)) {
    const auto path = std::filesystem::temp_directory_path() / "bp-test-changed.ply";
    bp::OutputFile file(path.string(), true);
    write(site, file);
    file.commit();
    const bp::IndexedMesh mesh = bp::read_mesh(path.string());
    std::filesystem::remove(path);
    return mesh;
  };
  const bp::IndexedMesh before = vertices(write_ply);
  const bp::IndexedMesh after =
      vertices([](const Site& s, bp::OutputFile& file) { write_changed_ply(s, s.counts().parts / 2, file); });
  REQUIRE(before.vertices.size() == after.vertices.size());
  CHECK(before.triangles == after.triangles);
  std::size_t first = before.vertices.size(), last = 0, differ = 0;
  for (std::size_t i = 0; i < before.vertices.size(); ++i) {
    if (before.vertices[i] == after.vertices[i]) continue;
    CHECK(after.vertices[i][1] == Approx(before.vertices[i][1] + 2));
    first = std::min(first, i), last = i, ++differ;
  }
  CHECK(differ > 2);
  CHECK(differ == last + 1 - first);
}

TEST_CASE("solids of a plant are closed and face outward", "[quick][samples]") {
  EdgeSink edges;
  Parts closed(edges, 1, 1);
  closed.box({0, 0, 0}, {1, 1, 1});
  closed.beam({0, 0, 0}, {1, 2, 3}, 0.1, 0.2);
  closed.cylinder({0, 0, 0}, {0, 0, 1}, 1, 2, 9);
  closed.ring({0, 0, 0}, {0, 1, 0}, 3, 1, 7, 5);
  closed.tube({{0, 0, 0}, {0, 3, 0}, {3, 3, 0}}, 0.2, 8, 0.5, true);
  closed.drum({0, 0, 0});
  for (const auto& [edge, balance] : edges.balance) CHECK(balance == 0);

  struct Volume : Sink {
    std::vector<Vec> points;
    double six = 0;
    Wants part(std::uint32_t, std::uint32_t) override {
      points.clear();
      return Wants(vertices | faces);
    }
    void vertex(Vec v) override { points.push_back(v); }
    void face(std::uint32_t a, std::uint32_t b, std::uint32_t c) override {
      six += dot(points[a], cross(points[b], points[c]));
    }
  };
  const auto volume = [](auto make) {
    Volume sink;
    Parts parts(sink, 1, 1);
    make(parts);
    return sink.six / 6;
  };
  CHECK(volume([](Parts& p) { p.box({1, 1, 1}, {2, 3, 4}); }) == Approx(6));
  CHECK(volume([](Parts& p) { p.beam({1, 1, 1}, {1, 1, 5}, 0.5, 0.5); }) == Approx(1));
  CHECK(volume([](Parts& p) { p.cylinder({5, 0, 0}, {1, 0, 0}, 1, 2, 64); }) == Approx(6.273).epsilon(1e-3));
  CHECK(volume([](Parts& p) { p.ring({0, 0, 0}, {0, 1, 0}, 3, 1, 64, 64); }) > 0);
  CHECK(volume([](Parts& p) { p.tube({{0, 0, 0}, {0, 3, 0}, {3, 3, 0}}, 0.2, 8, 0.5, true); }) > 0);
}

TEST_CASE("our sines agree with the library's", "[quick][samples]") {
  for (const int n : {3, 8, 17, 360}) {
    for (int i = 0; i < n; ++i) {
      CHECK(std::abs(turn(i, n).cosine - std::cos(2 * M_PI * i / n)) < 1e-15);
      CHECK(std::abs(turn(i, n).sine - std::sin(2 * M_PI * i / n)) < 1e-15);
    }
  }
}

TEST_CASE("too many vertices for PLY are refused", "[quick][samples]") {
  bp::OutputFile file((std::filesystem::temp_directory_path() / "bp-test-plant-big.ply").string(), true);
  CHECK_THROWS_AS(write_ply(Site(20000000000u, 1), file), bp::Error);
}
