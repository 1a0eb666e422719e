// bench_close_tiles STREAM SCALE_VOX [ELEMENT [RUNS [COMMIT]]]: the closing stage alone, without codec, flood and disc:
// all tiles of a brick stream from a shelf in memory to closed boxes, by the CPU backend on all cores and by each GPU,
// copies included. One JSON line per backend and tile size: median wall time of RUNS passes, the first (allocations,
// loading of kernels) apart. Results are compared.
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <vector>

#include "io/stream/brick_shelf.h"
#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/pool.h"
#include "lib/device/cpu/cpu_backend.h"
#include "lib/grid/tile_grid.h"
#include "lib/pass/close/close_pass.h"
#include "tests/bench/median.h"
#ifdef BP_HAVE_CUDA
#include "gpu/cuda_backend.h"
#endif

namespace bp {
namespace {

struct Job {
  StreamHeader header;
  std::unique_ptr<BrickShelf> shelf;
  ScaleField field;
  ClosingParams params;
  VoxelBox grid;
};

Job load(const std::string& path, double scale_vox, const std::string& element) {
  BrickReader source(path);
  Job job;
  job.header = source.header();
  job.shelf = make_shelf(std::uint64_t(64) << 30, "/tmp");
  for (Brick brick; source.read(brick);) job.shelf->put(brick.coord, brick.fill, brick.bits);
  job.field.base = scale_vox * job.header.frame.voxel;
  job.params.element = element == "ball" ? StructuringElement::ball : StructuringElement::cube;
  job.grid = voxels_of(closing_bricks(job.header, job.field));
  return job;
}

std::uint64_t hash_of(const BitBox& bits) {
  std::uint64_t h = 1469598103934665603u ^ std::uint64_t(bits.box().min.x * 73856093 ^ bits.box().min.y * 19349663);
  for (std::int64_t i = 0; i < bits.word_count(); ++i) h = (h ^ bits.data()[i]) * 1099511628211u;
  return h;
}

/// One pass over all tiles; `check` adds up hashes (not timed).
struct Pass {
  double ms = 0;
  std::uint64_t hash = 0;
};
Pass close_all(const Job& job, Backends& backends, std::int32_t edge, bool check) {
  const TileGrid tiles(job.grid, edge);
  std::vector<Backend*> all;
  for (const auto& b : backends) all.push_back(b.get());
  Pool<Backend*> pool(std::move(all));
  std::atomic<std::uint64_t> hash{0};
  const auto start = std::chrono::steady_clock::now();
  parallel_for(std::int64_t(tiles.total()), [&](std::int64_t i) {
    const VoxelBox box = tiles.box(tiles.coord(std::uint64_t(i)));
    const Halo halo = halo_of(box, job.field, job.header.frame);
    const ScaleLattice lattice = job.field.sample(job.header.frame, box.grown(halo.erosion_vox + kBrickEdge));
    thread_local BitBox closed;
    Pool<Backend*>::Lease(pool)->close_from_shelf(*job.shelf, job.header.bricks, lattice, halo, job.params, box,
                                                  closed);
    if (check) hash += hash_of(closed);
  });
  return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(), hash};
}

Backends cpu_backends() {
  Backends all;
  for (int i = 0; i < thread_count(); ++i) all.push_back(std::make_unique<CpuBackend>());
  return all;
}

int run(const std::string& path, double scale_vox, const std::string& element, int runs, const std::string& commit) {
  const Job job = load(path, scale_vox, element);
  std::vector<Backends> kinds;
  kinds.push_back(cpu_backends());
#ifdef BP_HAVE_CUDA
  for (const int per_gpu : {1, 2, 4, 8}) {
    Backends all;
    for (const CudaDevice& device : cuda_devices()) {
      for (int i = 0; i < per_gpu; ++i) all.push_back(make_cuda_backend(device.index));
    }
    if (!all.empty()) kinds.push_back(std::move(all));
  }
#endif
  bool failed = false;
  const VoxelCoord size = job.grid.size();
  for (const std::int32_t edge : {256, 512}) {
    std::uint64_t want = 0;
    for (Backends& backends : kinds) {
      const Pass first = close_all(job, backends, edge, true);
      if (want == 0) want = first.hash;
      const bool equal = close_all(job, backends, edge, true).hash == want && first.hash == want;
      std::vector<double> ms;
      for (int i = 0; i < runs; ++i) ms.push_back(close_all(job, backends, edge, false).ms);
      fmt::print(
          "{{\"bench\":\"close_tiles\",\"backend\":\"{}\",\"backends\":{},\"threads\":{},\"commit\":\"{}\",\"stream\":"
          "\"{}\","
          "\"grid\":[{},{},{}],\"scale\":{},\"element\":\"{}\",\"tile\":{},\"first_ms\":{:.1f},\"ms\":{:.2f},\"equal\":"
          "{}}}\n",
          backends.front()->name(), backends.size(), thread_count(), commit, path.substr(path.find_last_of('/') + 1),
          size.x, size.y, size.z, scale_vox, element, edge, first.ms, median(ms), equal);
      std::fflush(stdout);
      failed = failed || !equal;
    }
  }
  return failed ? 1 : 0;
}

}  // namespace
}  // namespace bp

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: bench_close_tiles STREAM SCALE_VOX [cube|ball [RUNS [COMMIT]]]\n");
    return 2;
  }
  try {
    return bp::run(argv[1], std::atof(argv[2]), argc > 3 ? argv[3] : "cube", argc > 4 ? std::atoi(argv[4]) : 21,
                   argc > 5 ? argv[5] : "unknown");
  } catch (const std::exception& e) {
    fmt::print(stderr, "bench_close_tiles: {}\n", e.what());
    return 1;
  }
}
