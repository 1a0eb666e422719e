#include "lib/pass/color/vertex_colors.h"

#include <algorithm>
#include <array>

#include "lib/voxel/color_samples.h"

// [KBS11] Kavan, Bargteil and Sloan, Least squares vertex baking, 2011: minimises the squared difference between what
// is interpolated over the faces and what was sampled there. We differ in the regularization: not towards smoothness
// across edges but, weakly, towards each vertex's own weighted mean, which also decides where samples are too few. The
// matrix is then bounded by its diagonal whatever the mesh is, and ten rounds of conjugate gradients are far below a
// step of 8 bits.

namespace bp {

namespace {

constexpr double kSpacing = kColorCellVox * kLatticePerVoxel / 2;  // lattice units: as the scene was sampled
constexpr int kLeastRows = 2;
constexpr double kTowardsMean = 0.05;
constexpr int kRounds = 10;

using Rgb = std::array<double, 3>;

Rgb rgb_of(LinearColor c) {
  return {double(c.r), double(c.g), double(c.b)};
}

Vec3d point(LatticeCoord v) {
  return {double(v.x), double(v.y), double(v.z)};
}

class Baker {
 public:
  Baker(LatticeMesh& mesh, const NearbyColors& colors)
      : mesh_(mesh),
        colors_(colors),
        n_(mesh.vertices.size()),
        faces_(mesh.triangles.size()),
        mass_(n_, 0),
        diagonal_(n_, 0),
        mean_(n_, Rgb{}),
        range_(n_) {}

  void bake() {
    for (std::size_t f = 0; f < faces_.size(); ++f) sample(f);
    for (std::size_t v = 0; v < n_; ++v) {
      right_.push_back(mean_[v]);
      mean_[v] = mass_[v] > 0 ? divided(mean_[v], mass_[v]) : rgb_of(colors_.at(point(mesh_.vertices[v])));
      for (std::size_t i = 0; i < 3; ++i) right_[v][i] += kTowardsMean * mass_[v] * mean_[v][i];
      diagonal_[v] += kTowardsMean * mass_[v];
    }
    mesh_.colors.assign(n_, {});
    for (std::size_t i = 0; i < 3; ++i) solve(i);
  }

 private:
  /// Products of the corners' weights over the samples of a face: 00 11 22 01 12 20.
  using Products = std::array<double, 6>;
  struct Range {
    Rgb low{65535, 65535, 65535}, high{0, 0, 0};
  };

  static Rgb divided(const Rgb& c, double by) { return {c[0] / by, c[1] / by, c[2] / by}; }

  void sample(std::size_t f) {
    const auto& t = mesh_.triangles[f];
    const TriangleD corners{point(mesh_.vertices[t[0]]), point(mesh_.vertices[t[1]]), point(mesh_.vertices[t[2]])};
    const double area = area_of(corners);
    for_each_sample(corners, kSpacing, kLeastRows, [&](const std::array<double, 3>& w, double share) {
      const Rgb c = rgb_of(colors_.at(point_of(corners, w)));
      for (std::size_t k = 0; k < 3; ++k) {
        const double weight = area * share * w[k];
        faces_[f][k] += weight * w[k];
        faces_[f][3 + k] += weight * w[(k + 1) % 3];
        mass_[t[k]] += weight;
        diagonal_[t[k]] += weight * w[k];
        for (std::size_t i = 0; i < 3; ++i) {
          mean_[t[k]][i] += weight * c[i];
          range_[t[k]].low[i] = std::min(range_[t[k]].low[i], c[i]);
          range_[t[k]].high[i] = std::max(range_[t[k]].high[i], c[i]);
        }
      }
    });
  }

  void multiply(const std::vector<double>& x, std::vector<double>& y) const {
    for (std::size_t v = 0; v < n_; ++v) y[v] = kTowardsMean * mass_[v] * x[v];
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const auto& t = mesh_.triangles[f];
      const Products& m = faces_[f];
      y[t[0]] += m[0] * x[t[0]] + m[3] * x[t[1]] + m[5] * x[t[2]];
      y[t[1]] += m[1] * x[t[1]] + m[3] * x[t[0]] + m[4] * x[t[2]];
      y[t[2]] += m[2] * x[t[2]] + m[4] * x[t[1]] + m[5] * x[t[0]];
    }
  }

  /// Conjugate gradients from the means on, each equation divided by its diagonal.
  void solve(std::size_t channel) {
    std::vector<double> x(n_), r(n_), p(n_), q(n_);
    for (std::size_t v = 0; v < n_; ++v) x[v] = mean_[v][channel];
    multiply(x, q);
    for (std::size_t v = 0; v < n_; ++v) r[v] = right_[v][channel] - q[v];
    const auto preconditioned = [&](std::size_t v) { return diagonal_[v] > 0 ? r[v] / diagonal_[v] : 0; };
    double before = 0;
    for (int round = 0; round < kRounds; ++round) {
      double now = 0, along = 0;
      for (std::size_t v = 0; v < n_; ++v) now += r[v] * preconditioned(v);
      if (!(now > 0)) break;
      for (std::size_t v = 0; v < n_; ++v) p[v] = preconditioned(v) + (round > 0 ? now / before * p[v] : 0);
      multiply(p, q);
      for (std::size_t v = 0; v < n_; ++v) along += p[v] * q[v];
      if (!(along > 0)) break;
      for (std::size_t v = 0; v < n_; ++v) {
        x[v] += now / along * p[v];
        r[v] -= now / along * q[v];
      }
      before = now;
    }
    for (std::size_t v = 0; v < n_; ++v) {
      const Range& range = range_[v];
      const double c = mass_[v] > 0 ? std::clamp(x[v], range.low[channel], range.high[channel]) : x[v];
      std::uint16_t LinearColor::*const of[] = {&LinearColor::r, &LinearColor::g, &LinearColor::b};
      mesh_.colors[v].*of[channel] = std::uint16_t(c + 0.5);
    }
  }

  LatticeMesh& mesh_;
  const NearbyColors& colors_;
  const std::size_t n_;
  std::vector<Products> faces_;
  std::vector<double> mass_, diagonal_;
  std::vector<Rgb> mean_, right_;
  std::vector<Range> range_;
};

}  // namespace

void color_vertices(LatticeMesh& mesh, const NearbyColors& colors) {
  Baker(mesh, colors).bake();
}

}  // namespace bp
