// Points bound to a cage per second: a plain loop over the faces as the paper writes it, and ours, compiled with the
// same flags, in turns.   bench_deform CAGE [POINTS]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>

#include "io/scene/scene_reader.h"
#include "lib/core/box.h"
#include "lib/core/parallel.h"
#include "lib/deform/coordinates.h"
#include "tests/bench/median.h"
#include "tests/reference/mean_value.h"

namespace {

using namespace bp;

/// Of the clock on the wall, and of all cores together.
struct Seconds {
  std::vector<double> wall, cores;

  template <class F>
  void add(const F& f) {
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t before = std::clock();
    f();
    cores.push_back(double(std::clock() - before) / CLOCKS_PER_SEC);
    wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
};

/// In the bounds of the cage, and inside it.
std::vector<Vec3d> points_inside(const IndexedMesh& cage, const CageCoordinates& coordinates, std::size_t n) {
  Bounds3d bounds;
  for (const Vec3d& v : cage.vertices) bounds.add(v);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Vec3d> points;
  CoordinateRows rows;
  while (points.size() < n) {
    std::vector<Vec3d> some(1000);
    for (Vec3d& p : some) {
      for (std::size_t i = 0; i < 3; ++i) p[i] = bounds.min[i] + share(random) * (bounds.max[i] - bounds.min[i]);
    }
    coordinates.evaluate(some, rows);
    for (std::size_t i = 0; i < some.size() && points.size() < n; ++i) {
      if (rows.places[i] == CoordinateRows::Place::inside) points.push_back(some[i]);
    }
  }
  return points;
}

void run_ours(const CageCoordinates& coordinates, const std::vector<Vec3d>& points) {
  constexpr std::int64_t kBlock = 4096, kStep = 128;
  parallel_ranges(std::int64_t(points.size()), kBlock, [&](std::int64_t begin, std::int64_t end) {
    CoordinateRows rows;
    for (std::int64_t i = begin; i < end; i += kStep)
      coordinates.evaluate(std::span(points).subspan(std::size_t(i), std::size_t(std::min(kStep, end - i))), rows);
  });
}

void run_plain(const IndexedMesh& cage, std::span<const Vec3d> points) {
  std::vector<double> weights;
  for (const Vec3d& p : points) reference::mean_value(cage, p, weights);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "usage: bench_deform CAGE [POINTS]\n"), 2;
  const IndexedMesh cage = read_mesh(argv[1]);
  const CageCoordinates coordinates(make_cage(cage, argv[1]));
  const std::vector<Vec3d> points =
      points_inside(cage, coordinates, argc > 2 ? std::size_t(std::atol(argv[2])) : 1000000);
  constexpr std::size_t kShare = 20;  // of the points, for the plain loop
  Seconds plain, ours;
  for (int round = 0; round < 3; ++round) {
    plain.add([&] { run_plain(cage, std::span(points).first(points.size() / kShare)); });
    ours.add([&] { run_ours(coordinates, points); });
  }
  const auto ratio = [&](const std::vector<double>& a, const std::vector<double>& b) {
    return kShare * median(a) / median(b);
  };
  std::printf(
      "{\"faces\": %zu, \"points\": %zu, \"threads\": %d, \"plain_s\": %.2f, \"ours_s\": %.2f, "
      "\"times\": %.1f, \"times_per_core\": %.1f}\n",
      cage.triangles.size(), points.size(), thread_count(), kShare * median(plain.wall), median(ours.wall),
      ratio(plain.wall, ours.wall), ratio(plain.cores, ours.cores));
}
