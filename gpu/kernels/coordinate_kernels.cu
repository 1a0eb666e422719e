// The formulas of lib/deform/formulas, with a thread for each point. The numbers of a point take some 30 kB for a cage
// of 300 faces. They lie in device memory, those of a warp side by side, so that each access is one line. The file is
// compiled without fused products and sums, so the bits are those of the CPU.
#include "gpu/kernels/coordinate_kernels.h"
#include "gpu/kernels/launch.h"
#include "lib/deform/formulas/green.h"
#include "lib/deform/formulas/likelihood.h"
#include "lib/deform/formulas/weights.h"

namespace bp {

namespace {

using namespace detail;

constexpr int kWeighThreads = 64;
constexpr int kUnitBits = 26;

/// Items of one point: number f of item i lies at i * kNumbers + f in rows of a warp's width.
template <class T>
class LaneShelf {
 public:
  static constexpr std::uint32_t kNumbers = sizeof(T) / sizeof(double);

  __device__ LaneShelf(double*& warp, std::uint32_t items) : at_(warp + lane_id()) {
    warp += std::size_t(items) * kNumbers * kWarp;
  }
  __device__ T get(std::uint32_t i) const {
    double numbers[kNumbers];
    const double* const from = at_ + std::size_t(i) * kNumbers * kWarp;
#pragma unroll
    for (std::uint32_t f = 0; f < kNumbers; ++f) numbers[f] = from[f * kWarp];
    T item;
    memcpy(&item, numbers, sizeof(T));
    return item;
  }
  __device__ void put(std::uint32_t i, const T& item) const {
    double numbers[kNumbers];
    memcpy(numbers, &item, sizeof(T));
    double* const to = at_ + std::size_t(i) * kNumbers * kWarp;
#pragma unroll
    for (std::uint32_t f = 0; f < kNumbers; ++f) to[f * kWarp] = numbers[f];
  }

 private:
  double* at_;
};

/// Returns how many doubles a point needs: as many as the constructors of the two scratches take.
std::size_t numbers_of(const CageView& cage, CoordinateKind kind) {
  const std::size_t vertices = cage.vertex_count, edges = cage.edge_count, faces = cage.face_count;
  if (kind == CoordinateKind::green) return 5 * vertices + 2 * edges + faces;
  return 5 * vertices + 6 * edges + (kind == CoordinateKind::maximum_likelihood ? 7 * faces : 0);
}

struct MeanNumbers {
  LaneShelf<double> sums;
  LaneShelf<MeanVertex<double>> vertices;
  LaneShelf<MeanEdge<double>> edges;
  LaneShelf<MeanFace<double>> faces;
  __device__ MeanNumbers(const CageView& cage, double* warp)
      : sums(warp, cage.vertex_count),
        vertices(warp, cage.vertex_count),
        edges(warp, cage.edge_count),
        faces(warp, cage.face_count) {}
};

/// `sums` and `face_weights` follow each other, so the columns of weights are contiguous.
struct GreenNumbers {
  LaneShelf<double> sums, face_weights;
  LaneShelf<GreenVertex<double>> vertices;
  LaneShelf<GreenEdge<double>> edges;
  __device__ GreenNumbers(const CageView& cage, double* warp)
      : sums(warp, cage.vertex_count),
        face_weights(warp, cage.face_count),
        vertices(warp, cage.vertex_count),
        edges(warp, cage.edge_count) {}
};

/// Returns whether the point is surely inside, and not near the cage.
__device__ bool find_weights(const WeighTask& t, const Vec<double>& point, double* warp) {
  bool near = false;
  double total = 0;
  if (t.kind == CoordinateKind::green) {
    GreenNumbers s(t.cage, warp);
    green_formula<double>(t.cage, point, s, total, near);
    return !near && total > 0.5;
  }
  MeanNumbers s(t.cage, warp);
  mean_value_formula<double>(t.cage, point, s, total, near);
  if (near || !(total > 0)) return false;
  if (t.kind == CoordinateKind::maximum_likelihood) {
    take_face_shares<double>(t.cage, s, near);
    take_middles<double>(t.cage, s);
    likelihood_formula<double>(t.cage, true, s);
  }
  return true;
}

/// Does what CageCoordinates::finish() and round_weights() do.
__device__ bool finish_weights(const WeighTask& t, const Vec<double>& point, double* warp, std::uint32_t i) {
  const LaneShelf<double> w(warp, t.cage.columns());
  divide_by_sum(t.cage, w);
  reproduce_point(t.cage, point, w);
  double largest, all;
  sizes_of(t.cage.columns(), w, largest, all);
  constexpr double kScale = double(1 << kUnitBits);
  if (!std::isfinite(all) || !(largest * kScale < kMostUnits)) return false;
  round_to_units(t.cage.columns(), w, kScale,
                 [&](std::uint32_t c, std::int32_t unit) { t.units[std::size_t(c) * t.count + i] = unit; });
  return true;
}

__global__ void __launch_bounds__(kWeighThreads)
    weigh_kernel(const __grid_constant__ WeighTask t, std::size_t numbers) {
  const std::uint32_t i = thread_in_grid();
  if (i >= t.count) return;
  double* const warp = t.scratch + std::size_t(i / kWarp) * kWarp * numbers;
  const Vec3d& p = t.points[i];
  Vec<double> point{(p[0] - t.cage.origin[0]) / t.cage.diagonal, (p[1] - t.cage.origin[1]) / t.cage.diagonal,
                    (p[2] - t.cage.origin[2]) / t.cage.diagonal};
  double size = BP_DOT(point, point);
  root(size);
  const bool good = size <= kFarAway && find_weights(t, point, warp);  // a point that is not finite has no size
  t.done[i] = good && finish_weights(t, point, warp, i) ? 1 : 0;
}

template <class T>
const T* uploaded(DeviceBuffer<T>& buffer, const T* from, std::size_t n, Staging& staging) {
  staging.upload(buffer.grow(n), from, n * sizeof(T));
  return buffer.data();
}

}  // namespace

void DeviceWeigher::upload(const CageCoordinates& coordinates, std::span<const Vec3d> points, Staging& staging) {
  CageView cage = coordinates.view();
  const std::size_t numbers = numbers_of(cage, coordinates.kind());
  const std::size_t warps = (points.size() + kWarp - 1) / kWarp;
  scratch_.grow(warps * kWarp * numbers);
  units_.grow(points.size() * cage.columns());
  done_.grow(points.size());
  cage.vertices = uploaded(vertices_, cage.vertices, cage.vertex_count, staging);
  cage.edges = uploaded(edges_, cage.edges, cage.edge_count, staging);
  cage.faces = uploaded(faces_, cage.faces, cage.face_count, staging);
  if (cage.green != nullptr) {
    cage.green = uploaded(green_, cage.green, cage.face_count, staging);
    cage.edge_lengths = uploaded(lengths_, cage.edge_lengths, cage.edge_count, staging);
  }
  task_ = {cage,
           coordinates.kind(),
           uploaded(points_, points.data(), points.size(), staging),
           std::uint32_t(points.size()),
           scratch_.data(),
           units_.data(),
           done_.data()};
}

void DeviceWeigher::enqueue(cudaStream_t stream) {
  launch("weigh_kernel", weigh_kernel, (task_.count + kWeighThreads - 1) / kWeighThreads, kWeighThreads, 0, stream,
         task_, numbers_of(task_.cage, task_.kind));
}

void DeviceWeigher::release() {
  points_.release(), vertices_.release(), edges_.release(), faces_.release(), green_.release();
  lengths_.release(), scratch_.release(), units_.release(), done_.release();
}

}  // namespace bp
