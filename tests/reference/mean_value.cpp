#include "tests/reference/mean_value.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"

namespace bp::reference {

namespace {

struct Toward {
  double length = 0;
  Vec3d unit{};
};

/// Figure 4 of the paper. False: the point lies in the plane of the face, but not in the face.
bool face_weights(const std::array<const Toward*, 3>& p, std::array<double, 3>& w) {
  std::array<double, 3> theta, cosine, sine;
  double h = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    theta[i] = 2 * std::asin(length(p[(i + 1) % 3]->unit - p[(i + 2) % 3]->unit) / 2);
    h += theta[i] / 2;
  }
  const double side = dot(p[0]->unit, cross(p[1]->unit, p[2]->unit)) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    cosine[i] = 2 * std::sin(h) * std::sin(h - theta[i]) / (std::sin(theta[a]) * std::sin(theta[b])) - 1;
    sine[i] = side * std::sqrt(1 - cosine[i] * cosine[i]);
    if (!(std::abs(sine[i]) > 1e-9)) return false;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    w[i] = (theta[i] - cosine[a] * theta[b] - cosine[b] * theta[a]) / (p[i]->length * std::sin(theta[a]) * sine[b]);
  }
  return true;
}

}  // namespace

void mean_value(const IndexedMesh& cage, const Vec3d& point, std::vector<double>& weights) {
  std::vector<Toward> toward(cage.vertices.size());
  for (std::size_t v = 0; v < toward.size(); ++v) {
    const Vec3d d = cage.vertices[v] - point;
    toward[v].length = length(d);
    toward[v].unit = (1 / toward[v].length) * d;
  }
  weights.assign(toward.size(), 0);
  for (const auto& t : cage.triangles) {
    std::array<double, 3> w;
    if (!face_weights({&toward[t[0]], &toward[t[1]], &toward[t[2]]}, w)) continue;
    for (std::size_t i = 0; i < 3; ++i) weights[t[i]] += w[i];
  }
  double sum = 0;
  for (const double w : weights) sum += w;
  for (double& w : weights) w /= sum;
}

}  // namespace bp::reference
