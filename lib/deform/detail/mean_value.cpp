#include "lib/deform/detail/mean_value.h"

#include <cmath>
#include <functional>
#include <vector>

namespace bp::detail {

BP_WIDE_CLONES unsigned mean_value_weights(const CageView& cage, const WideVec& points, CoordinateScratch& scratch,
                                           Wide& total) {
  WideBits near{};
  mean_value_formula<Wide>(cage, points, scratch, total, near);
  return bits_of(near);
}

namespace {

using Real = long double;
using RealVec = std::array<Real, 3>;

Real dot(const RealVec& a, const RealVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
RealVec cross(const RealVec& a, const RealVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Returns an edge's part of the mean vector of a face at that edge.
RealVec mean_of(const RealVec& a, const RealVec& b, const RealVec& normal) {
  const Real sine = std::sqrt(dot(normal, normal));
  const Real factor = sine > 0 ? std::atan2(sine, dot(a, b)) / (2 * sine) : 0;
  return {factor * normal[0], factor * normal[1], factor * normal[2]};
}

void each_face_slowly(const Cage& cage, const Vec3d& point, std::span<long double> lengths,
                      const std::function<void(std::size_t, const RealVec&)>& take) {
  constexpr Real kFlat = 1e-15L;
  std::vector<RealVec> toward(cage.vertices.size());
  for (std::size_t i = 0; i < toward.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) toward[i][k] = Real(cage.vertices[i][k]) - Real(point[k]);
    lengths[i] = std::sqrt(dot(toward[i], toward[i]));
    for (Real& x : toward[i]) x /= lengths[i];
  }
  for (std::size_t f = 0; f < cage.faces.size(); ++f) {
    const Cage::Face& face = cage.faces[f];
    RealVec normal[3], mean{};
    for (std::size_t i = 0; i < 3; ++i) {
      const RealVec &a = toward[face.corner[(i + 1) % 3]], &b = toward[face.corner[(i + 2) % 3]];
      normal[i] = cross(a, b);
      const RealVec part = mean_of(a, b, normal[i]);
      for (std::size_t k = 0; k < 3; ++k) mean[k] += part[k];
    }
    const Real height = dot(normal[0], toward[face.corner[0]]);
    const bool flat = std::abs(height) < kFlat;
    RealVec shares{};
    for (std::size_t i = 0; i < 3 && !flat; ++i) shares[i] = dot(normal[i], mean) / height;
    take(f, shares);
  }
}

}  // namespace

void mean_value_weights_slowly(const Cage& cage, const Vec3d& point, std::span<double> weights) {
  std::vector<Real> lengths(cage.vertices.size()), total(cage.vertices.size());
  each_face_slowly(cage, point, lengths, [&](std::size_t f, const RealVec& shares) {
    for (std::size_t i = 0; i < 3; ++i) total[cage.faces[f].corner[i]] += shares[i];
  });
  for (std::size_t i = 0; i < total.size(); ++i) weights[i] = double(total[i] / lengths[i]);
}

void face_shares_slowly(const Cage& cage, const Vec3d& point, std::size_t lane, CoordinateScratch& scratch) {
  std::vector<Real> lengths(cage.vertices.size());
  each_face_slowly(cage, point, lengths, [&](std::size_t f, const RealVec& shares) {
    for (std::size_t i = 0; i < 3; ++i) scratch.faces[f].share[i][int(lane)] = double(shares[i]);
  });
}

}  // namespace bp::detail
