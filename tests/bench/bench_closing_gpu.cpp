// Closing on the GPU: time per stage, ours against the paper's hierarchical collision, constant against varying scale.
// One JSON line per measurement; every result is compared in the same run, or the line says what it was not compared
// with.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "gpu/cuda_backend.h"
#include "gpu/kernels/tuning.h"
#include "lib/core/error.h"
#include "lib/device/cpu/cpu_backend.h"
#include "tests/backend/gpu_tile.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/gpu_clock.h"

namespace bp {
namespace {

struct Options {
  std::vector<std::string> models;
  std::vector<int> resolutions{512};
  std::vector<double> scales{20.8};
  std::vector<std::string> elements{"cube"}, fields{"constant", "varying", "turned", "skew", "own"};
  std::string commit = "unknown";
  int repeats = 21;
  std::size_t slab_bytes = kSlabBytes;
  bool hierarchical = true, cpu = true, stages = true;
};

std::vector<std::string> split(const std::string& s) {
  std::vector<std::string> parts{""};
  for (const char c : s) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

Options parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= argc) fail(ErrorCode::bad_argument, "{}: needs a value", a);
      return argv[++i];
    };
    if (a == "--resolution") {
      o.resolutions.clear();
      for (const auto& v : split(value())) o.resolutions.push_back(std::stoi(v));
    } else if (a == "--scale") {
      o.scales.clear();
      for (const auto& v : split(value())) o.scales.push_back(std::stod(v));
    } else if (a == "--element") {
      o.elements = split(value());
    } else if (a == "--field") {
      o.fields = split(value());
    } else if (a == "--commit") {
      o.commit = value();
    } else if (a == "--repeats") {
      o.repeats = std::stoi(value());
    } else if (a == "--slab") {  // MiB
      o.slab_bytes = std::size_t(std::stoi(value())) << 20;
    } else if (a == "--no-hierarchical") {
      o.hierarchical = false;
    } else if (a == "--no-cpu") {
      o.cpu = false;
    } else {
      o.models.push_back(a);
    }
  }
  if (o.models.empty()) fail(ErrorCode::bad_argument, "usage: bench_closing_gpu [options] plant|FILE.obj|FILE.bpv...");
  return o;
}

struct Timing {
  double total = 0;
  std::vector<std::pair<std::string, double>> stages;
};

class Bench {
 public:
  explicit Bench(const Options& o) : options_(o), device_(cuda_devices().at(0)) {
    BP_CUDA_CHECK(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
    flush_.grow(kFlushBytes);
  }
  ~Bench() { (void)cudaStreamDestroy(stream_); }

  /// Median total, caches cold, then medians of the stages in runs of their own.
  template <class Run>
  Timing measure(const Run& run) {
    Clock clock(stream_);
    Timing t;
    run(DeviceClosing::Mark{});
    std::vector<double> totals;
    for (int i = 0; i < options_.repeats; ++i) {
      BP_CUDA_CHECK(cudaMemsetAsync(flush_.data(), i, kFlushBytes, stream_));
      clock.start();
      run(DeviceClosing::Mark{});
      clock.mark("total");
      totals.push_back(clock.read()[0].second);
    }
    t.total = median(totals);
    std::vector<std::string> order;
    std::map<std::string, std::vector<double>> by_name;
    for (int i = 0; i < options_.repeats; ++i) {
      BP_CUDA_CHECK(cudaMemsetAsync(flush_.data(), i, kFlushBytes, stream_));
      clock.start();
      run([&](const char* name) { clock.mark(name); });
      for (const auto& [name, ms] : clock.read()) {
        if (by_name.count(name) == 0) order.push_back(name);
        by_name[name].push_back(ms);
      }
    }
    for (const auto& name : order) t.stages.emplace_back(name, median(by_name[name]));
    return t;
  }

  void print(const BenchSolid& s, int resolution, double scale, const std::string& element, const std::string& field,
             const std::string& algorithm, const GpuTile& tile, const Timing& t, const BitBox& result,
             const std::string& compared) {
    const GridShape& g = tile.layout().shape;
    const double voxels = double(s.tight.volume());
    std::printf(
        "{\"bench\":\"closing\",\"device\":\"%s\",\"commit\":\"%s\",\"model\":\"%s\",\"resolution\":%d,\"grid\":[%d,%d,"
        "%d],"
        "\"domain\":[%d,%d,%d],\"scale\":%g,\"element\":\"%s\",\"field\":\"%s\",\"algorithm\":\"%s\",\"ms\":%.4f,"
        "\"voxels_per_s\":%.4g,\"GB_per_s\":%.4g,",
        device_.name.c_str(), options_.commit.c_str(), s.name.c_str(), resolution, s.tight.size().x, s.tight.size().y,
        s.tight.size().z, 32 * g.words, g.ny, g.nz, scale, element.c_str(), field.c_str(), algorithm.c_str(), t.total,
        voxels / t.total * 1e3, double(g.word_count()) * 8 / t.total / 1e6);
    std::printf("\"stages\":{");
    for (std::size_t i = 0; i < t.stages.size(); ++i)
      std::printf("%s\"%s\":%.4f", i ? "," : "", t.stages[i].first.c_str(), t.stages[i].second);
    std::printf("},\"solid\":%llu,\"closed\":%llu,\"hash\":\"%016llx\",\"equal\":\"%s\"}\n",
                (unsigned long long)s.bits.count(), (unsigned long long)result.count(),
                (unsigned long long)bits_hash(result), compared.c_str());
    std::fflush(stdout);
  }

  void run(const BenchSolid& s, int resolution, double scale_vox, const std::string& element_name,
           const std::string& field) {
    const Scale most = Scale(std::lround(scale_vox * kScaleOne));
    // "varying": the largest scale is the constant one's; "around": the mean is. "turned", "skew" and "own" turn the
    // cubes, at a constant scale, or at one that varies: "turned/varying".
    const bool oriented = field.rfind("turned", 0) == 0 || field.rfind("skew", 0) == 0 || field.rfind("own", 0) == 0;
    const bool varies = field.ends_with("varying");
    if (field.rfind("own", 0) == 0 && s.orientation.empty()) return;
    const Scale least = varies ? Scale(most / 2) : field == "around" ? Scale(most * 3 / 4) : most;
    const Scale top = field == "around" ? Scale(most * 5 / 4) : most;
    const auto element = element_name == "ball" ? StructuringElement::ball : StructuringElement::cube;
    if (oriented && element == StructuringElement::ball) return;
    OrientationField orientation;
    if (oriented)
      orientation = field.rfind("own", 0) == 0 ? s.orientation : bench_orientation(field.substr(0, field.find('/')));
    const ClosingParams params{element, oriented ? &orientation : nullptr};
    VoxelBox interior = s.tight.grown(1);
    const Halo halo{top / kScaleOne + 2, oriented ? oriented_reach(orientation, top) : top / kScaleOne + 1};
    const ScaleLattice scale = bench_scale(interior.grown(halo.total_vox() + 8), least, top);
    GpuTile tile(s.bits, scale, halo, interior);
    if (oriented) tile.orient(orientation, interior.grown(halo.erosion_vox));
    DeviceClosing ours({device_.multiprocessors, options_.slab_bytes, false});
    const auto go = [&](const DeviceClosing::Mark& mark) { tile.close(ours, element, stream_, mark); };
    tile.poison(stream_);
    go({});
    const BitBox first = tile.result(stream_);
    const Timing t = measure(go);
    tile.poison(stream_);
    go({});
    const BitBox result = tile.result(stream_);
    std::string compared = first == result ? "itself" : "NOT ITSELF";
    if (options_.cpu) {
      CpuBackend cpu;
      BitBox want;
      cpu.close(s.bits, scale, halo, params, interior, want);
      compared = want == result ? "cpu" : "NOT CPU";
    }
    print(s, resolution, scale_vox, element_name, field, oriented ? "rows" : "distance", tile, t, result, compared);
    failed_ = failed_ || compared.rfind("NOT", 0) == 0;
    if (options_.hierarchical) compare_walks(s, resolution, scale_vox, element_name, field, tile, element, result);
  }

  /// Compares both variants of the tree walk with `ours`.
  void compare_walks(const BenchSolid& s, int resolution, double scale_vox, const std::string& element_name,
                     const std::string& field, GpuTile& tile, StructuringElement element, const BitBox& ours) {
    HierarchicalClosing walk(device_.multiprocessors);
    for (const auto variant : {HierarchicalVariant::plain, HierarchicalVariant::half_resolution}) {
      const auto climb = [&](const DeviceClosing::Mark& mark) { tile.close(walk, element, variant, stream_, mark); };
      tile.poison(stream_);
      const Timing w = measure(climb);
      const BitBox other = tile.result(stream_);
      failed_ = failed_ || other != ours;
      print(s, resolution, scale_vox, element_name, field,
            variant == HierarchicalVariant::plain ? "hierarchical" : "hierarchical, half resolution first", tile, w,
            other, other == ours ? "ours" : "NOT OURS");
    }
  }

  [[nodiscard]] bool failed() const { return failed_; }

 private:
  static constexpr std::size_t kFlushBytes = std::size_t(128) << 20;
  const Options& options_;
  CudaDevice device_;
  cudaStream_t stream_{};
  DeviceBuffer<std::uint8_t> flush_;
  bool failed_ = false;
};

int run(const Options& o) {
  if (cuda_devices().empty()) fail(ErrorCode::out_of_resource, "no GPU here");
  Bench bench(o);
  for (const auto& model : o.models) {
    for (const int resolution : o.resolutions) {
      const BenchSolid s = load_bench_solid(model, resolution);
      for (const double scale : o.scales) {
        for (const auto& element : o.elements) {
          for (const auto& field : o.fields) bench.run(s, resolution, scale, element, field);
        }
      }
    }
  }
  return bench.failed() ? 1 : 0;
}

}  // namespace
}  // namespace bp

int main(int argc, char** argv) {
  try {
    return bp::run(bp::parse(argc, argv));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_closing_gpu: %s\n", e.what());
    return 1;
  }
}
