// Points bound to a cage per second: a plain loop over the faces as the paper writes it, and ours, compiled with the
// same flags, in turns. Then coordinates and rounding on the CPU and on a GPU, if there is one, and whether the bits
// are the same; and the parts of bind and apply.   bench_deform CAGE [POINTS]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <numeric>
#include <random>

#include "io/deform/weight_file.h"
#include "io/scene/scene_reader.h"
#include "lib/core/box.h"
#include "lib/core/parallel.h"
#include "lib/core/pool.h"
#include "lib/device/cpu/cpu_backend.h"
#include "lib/store/content_hash.h"
#include "tests/bench/median.h"
#include "tests/reference/mean_value.h"
#ifdef BP_HAVE_CUDA
#include "gpu/cuda_backend.h"
#endif

namespace {

using namespace bp;

/// Seconds on the wall clock, and of all cores together.
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

/// Returns random points in the bounds of the cage and inside it.
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

/// Runs over all points in blocks, as bpdeform bind cuts them: weigh(backend, block of points, its weights, its
/// number).
class Blocks {
 public:
  Blocks(const CageCoordinates& coordinates, const std::vector<Vec3d>& points)
      : coordinates_(coordinates), points_(points), size_(points_of_block(coordinates.columns())) {}

  [[nodiscard]] std::size_t count() const { return (points_.size() + size_ - 1) / size_; }
  void weigh(const Backends& backends, const std::function<void(std::size_t, const WeightBlock&)>& take) const {
    std::vector<Backend*> idle;
    for (const auto& backend : backends) idle.push_back(backend.get());
    Pool<Backend*> pool(std::move(idle));
    Pool<WeightBlock*> memory(blocks_of(2 * std::size_t(thread_count())));
    parallel_for(std::int64_t(count()), [&](std::int64_t b) {
      const Pool<WeightBlock*>::Lease block(memory);
      const auto some = std::span(points_).subspan(std::size_t(b) * size_);
      const std::size_t n = std::min(size_, some.size());
      std::vector<CoordinateRows::Place> places(n);
      block->points = n;
      {
        const Pool<Backend*>::Lease backend(pool);
        backend->weigh(coordinates_, some.first(n), true, *block, places);
      }
      take(std::size_t(b), *block);
    });
  }

 private:
  /// Kept, so that no round pays for fresh memory.
  std::vector<WeightBlock*> blocks_of(std::size_t n) const {
    while (kept_.size() < n) kept_.push_back(std::make_unique<WeightBlock>(size_, coordinates_.columns()));
    std::vector<WeightBlock*> out;
    for (const auto& block : kept_) out.push_back(block.get());
    return out;
  }
  const CageCoordinates& coordinates_;
  const std::vector<Vec3d>& points_;
  const std::size_t size_;
  mutable std::vector<std::unique_ptr<WeightBlock>> kept_;
};

Backends cpu_backends() {
  Backends backends;
  for (int i = 0; i < thread_count(); ++i) backends.push_back(std::make_unique<CpuBackend>());
  return backends;
}

/// Empty where there is no GPU.
Backends gpu_backends() {
  Backends backends;
#ifdef BP_HAVE_CUDA
  constexpr int kBackends = 8;
  for (int i = 0; i < kBackends && !cuda_devices().empty(); ++i) backends.push_back(make_cuda_backend(0));
#endif
  return backends;
}

std::vector<ResultKey> hashes(const Blocks& blocks, const Backends& backends) {
  std::vector<ResultKey> out(blocks.count());
  blocks.weigh(backends, [&](std::size_t b, const WeightBlock& block) {
    ContentHash hash;
    hash.add(std::as_bytes(std::span(block.units).first(block.points * block.columns)));
    hash.add(std::as_bytes(std::span(block.bits).first(block.points)));
    out[b] = hash.value();
  });
  return out;
}

/// Prints the times of the other steps of bind and apply, on all cores: packing, unpacking, the sum over the columns.
void print_parts(const Blocks& blocks, const Backends& backends, const CageCoordinates& coordinates) {
  std::vector<PackedWeights> packed(blocks.count());
  const auto seconds = [](const auto& f) {
    Seconds s;
    s.add(f);
    return s.wall[0];
  };
  const double weigh = seconds([&] { blocks.weigh(backends, [](std::size_t, const WeightBlock&) {}); });
  const double with_pack = seconds([&] {
    blocks.weigh(backends, [&](std::size_t b, const WeightBlock& block) {
      WeightBlock copy(block.points, block.columns);
      std::copy_n(block.units.begin(), copy.units.size(), copy.units.begin());
      std::copy_n(block.bits.begin(), copy.bits.size(), copy.bits.begin());
      pack_weights(copy, packed[b]);
    });
  });
  std::uint64_t bytes = 0;
  for (const PackedWeights& p : packed) bytes += p.bytes.size();
  const std::vector<Vec3d> moves(coordinates.columns(), Vec3d{1, 2, 3});
  std::vector<double> unpack(packed.size()), add(packed.size());
  const double apply = seconds([&] {
    parallel_for(std::int64_t(packed.size()), [&](std::int64_t b) {
      WeightBlock block;
      std::vector<Vec3d> out(packed[std::size_t(b)].points);
      unpack[std::size_t(b)] =
          seconds([&] { (void)unpack_weights(packed[std::size_t(b)], coordinates.columns(), block); });
      add[std::size_t(b)] = seconds([&] { add_moves(block, moves, out); });
    });
  });
  std::printf(
      "{\"weigh_s\": %.3f, \"weigh_and_pack_s\": %.3f, \"packed_MB\": %.0f, \"unpack_and_add_s\": %.3f, "
      "\"core_s_unpack\": %.2f, \"core_s_add\": %.2f}\n",
      weigh, with_pack, double(bytes) / 1e6, apply, std::accumulate(unpack.begin(), unpack.end(), 0.0),
      std::accumulate(add.begin(), add.end(), 0.0));
}

/// Coordinates, rounded, of each kind; the plain loop takes plain_s on one core.
void compare_devices(const Cage& cage, const std::vector<Vec3d>& points, double plain_s) {
  const Backends cpu = cpu_backends(), gpu = gpu_backends();
  const char* const names[] = {"mean-value", "green", "maximum-likelihood"};
  for (const CoordinateKind kind :
       {CoordinateKind::mean_value, CoordinateKind::green, CoordinateKind::maximum_likelihood}) {
    const CageCoordinates coordinates(cage, kind);
    const Blocks blocks(coordinates, points);
    const bool same = gpu.empty() || hashes(blocks, cpu) == hashes(blocks, gpu);
    Seconds on_cpu, on_gpu;
    for (int round = 0; round < 3; ++round) {
      on_cpu.add([&] { blocks.weigh(cpu, [](std::size_t, const WeightBlock&) {}); });
      if (!gpu.empty()) on_gpu.add([&] { blocks.weigh(gpu, [](std::size_t, const WeightBlock&) {}); });
    }
    std::printf("{\"kind\": \"%s\", \"cpu_s\": %.3f", names[int(kind)], median(on_cpu.wall));
    if (!gpu.empty())
      std::printf(", \"gpu_s\": %.4f, \"plain_over_gpu\": %.0f, \"cpu_over_gpu\": %.1f, \"same_bits\": %s",
                  median(on_gpu.wall), plain_s / median(on_gpu.wall), median(on_cpu.wall) / median(on_gpu.wall),
                  same ? "true" : "false");
    std::printf("}\n");
    if (kind == CoordinateKind::mean_value) {
      print_parts(blocks, cpu, coordinates);
      if (!gpu.empty()) print_parts(blocks, gpu, coordinates);
    }
  }
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
  compare_devices(coordinates.cage(), points, kShare * median(plain.wall));
}
