#include "lib/pass/measure/detail/frame_smoothing.h"

#include "lib/core/parallel.h"

namespace bp::detail {

namespace {

using Numbers = std::vector<double>;

/// Sets `out` to the sum over the neighbours of (value there - value here).
void laplacian(const std::array<std::int32_t, 3>& n, const Numbers& in, Numbers& out) {
  const std::size_t step[3] = {1, std::size_t(n[0]), std::size_t(n[0]) * std::size_t(n[1])};
  std::size_t i = 0;
  std::int32_t at[3];
  for (at[2] = 0; at[2] < n[2]; ++at[2]) {
    for (at[1] = 0; at[1] < n[1]; ++at[1]) {
      for (at[0] = 0; at[0] < n[0]; ++at[0], ++i) {
        double sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (at[axis] > 0) sum += in[i - step[axis]] - in[i];
          if (at[axis] + 1 < n[axis]) sum += in[i + step[axis]] - in[i];
        }
        out[i] = sum;
      }
    }
  }
}

double product(const Numbers& a, const Numbers& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Solves (weight + L L) u = weight * known, or with -L in place of L L, for one part of the tensors.
class Solver {
 public:
  Solver(const FrameLattice& lattice, std::size_t part) : lattice_(lattice), part_(part), scratch_(lattice.count()) {}

  [[nodiscard]] Numbers solve() {
    constexpr int kMostSteps = 1500;
    const std::size_t n = lattice_.count();
    Numbers u(n, mean()), r(n), p, q(n);
    apply(u, q);
    for (std::size_t i = 0; i < n; ++i) r[i] = lattice_.weight[i] * lattice_.known[i].m[part_] - q[i];
    Numbers z(n);
    precondition(r, z);
    p = z;
    double rz = product(r, z);
    const double enough = rz * 1e-12;
    for (int step = 0; step < kMostSteps && rz > enough && rz > 1e-300; ++step) {
      apply(p, q);
      const double a = rz / product(p, q);
      for (std::size_t i = 0; i < n; ++i) u[i] += a * p[i], r[i] -= a * q[i];
      precondition(r, z);
      const double next = product(r, z), b = next / rz;
      rz = next;
      for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + b * p[i];
    }
    return u;
  }

 private:
  [[nodiscard]] double mean() const {
    double sum = 0, weights = 0;
    for (std::size_t i = 0; i < lattice_.count(); ++i) {
      sum += lattice_.weight[i] * lattice_.known[i].m[part_];
      weights += lattice_.weight[i];
    }
    return weights > 0 ? sum / weights : 0;
  }
  void apply(const Numbers& in, Numbers& out) {
    laplacian(lattice_.size, in, lattice_.places ? scratch_ : out);
    if (lattice_.places) laplacian(lattice_.size, scratch_, out);
    const double sign = lattice_.places ? 1 : -1;
    for (std::size_t i = 0; i < in.size(); ++i) out[i] = sign * out[i] + lattice_.weight[i] * in[i];
  }
  void precondition(const Numbers& in, Numbers& out) const {
    const double diagonal = lattice_.places ? 42 : 6;  // diagonal of L L, or of L, inside
    for (std::size_t i = 0; i < in.size(); ++i) out[i] = in[i] / (diagonal + lattice_.weight[i]);
  }

  const FrameLattice& lattice_;
  const std::size_t part_;
  Numbers scratch_;
};

}  // namespace

std::vector<FrameTensor> smoothed(const FrameLattice& lattice) {
  std::vector<FrameTensor> out(lattice.count());
  parallel_for(FrameTensor::kParts, [&](std::int64_t part) {
    const Numbers u = Solver(lattice, std::size_t(part)).solve();
    for (std::size_t i = 0; i < u.size(); ++i) out[i].m[std::size_t(part)] = u[i];
  });
  return out;
}

}  // namespace bp::detail
