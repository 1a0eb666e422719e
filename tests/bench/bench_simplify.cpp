// bench_simplify STREAM [FACES] [RUNS]: dense surface to FACES (1000) triangles without tightening, on one thread, as a
// line of JSON: dense triangles, processor seconds by phase, triangles per second. The least of RUNS (3) for each
// phase: the machine may be busy.
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <memory>

#include "io/stream/brick_shelf.h"
#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/simplify/detail/bulk_order.h"
#include "lib/simplify/detail/collapse_order.h"
#include "lib/simplify/simplify.h"
#include "lib/simplify/surface_tree.h"
#include "lib/surface/repair.h"
#include "lib/surface/surface.h"

namespace {

using namespace bp;

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

enum Phase { read, repair, extract, leaves, cells, root, all, phases };
constexpr const char* kPhaseNames[phases] = {"read", "repair", "extract", "flat", "cells", "root", "simplify"};

struct Bench {
  SimplifyParams params;
  SimplifyCounts counts;
  double seconds[phases];

  Bench() { std::fill_n(seconds, int(phases), std::numeric_limits<double>::infinity()); }

  template <class Body>
  double time(Phase phase, Body&& body) {
    const double begin = thread_seconds();
    body();
    const double taken = thread_seconds() - begin;
    seconds[phase] = std::min(seconds[phase], taken);
    return taken;
  }

  void run(const std::string& path) {
    const auto shelf = make_shelf_factory(std::uint64_t(8) << 30, "/tmp")();
    time(read, [&] { load(path, *shelf); });
    time(repair, [&] { repair_contacts(*shelf); });
    const ShelfSurface surface(*shelf, {});
    time(extract, [&] { (void)count_faces(surface); });
    SimplifyCounts ignored;
    time(leaves, [&] { (void)simplified_surface(surface, params, {}, ignored); });
    time(cells, [&] { (void)simplified_surface(surface, params, {kBulkFactor * params.faces, kLastBound}, ignored); });
    time(all, [&] { (void)simplify(surface, params, counts); });
  }

  static void load(const std::string& path, BrickShelf& shelf) {
    BrickReader source(path);
    const Layer layer = source.header().has_closing ? Layer::closing : Layer::solid;
    for (Brick brick; source.read(brick);) {
      if (brick.layer == layer) shelf.put(brick.coord, brick.fill, brick.bits);
    }
  }

  void print(const std::string& path) {
    seconds[root] = seconds[all] - seconds[cells];
    seconds[cells] -= seconds[leaves];
    fmt::print("{{\"bench\": \"simplify\", \"stream\": \"{}\", \"faces_dense\": {}, \"faces_flat\": {}, \"faces\": {}",
               path.substr(path.rfind('/') + 1), counts.faces_in, counts.faces_flat, counts.faces_out);
    fmt::print(", \"collapses\": {}, \"programs\": {}", counts.collapses, counts.solved);
    for (int p = 0; p < phases; ++p) fmt::print(", \"{}_s\": {:.4f}", kPhaseNames[p], seconds[p]);
    const double total = seconds[repair] + seconds[extract] + seconds[all];
    fmt::print(", \"dense_triangles_per_s\": {:.0f}}}\n", double(counts.faces_in) / total);
  }
};

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) bp::fail(bp::ErrorCode::bad_argument, "usage: bench_simplify STREAM [FACES] [RUNS]");
  const bp::ThreadLimit limit(1);
  Bench bench;
  bench.params.faces = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1000;
  const int runs = argc > 3 ? std::atoi(argv[3]) : 3;
  for (int i = 0; i < runs; ++i) bench.run(argv[1]);
  bench.print(argv[1]);
  return 0;
} catch (const bp::Error& e) {
  fmt::print(stderr, "bench_simplify: {}\n", e.what());
  return bp::exit_code(e.code());
}
