#include "tests/reference/green.h"

#include <cmath>
#include <numbers>

#include "lib/core/vec3.h"

namespace bp::reference {

namespace {

using std::numbers::pi;

double angle(const Vec3d& a, const Vec3d& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

/// The function GCTriInt of the paper, for a point at the origin.
double triangle_integral(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const double alpha = angle(b - a, p - a), beta = angle(a - p, b - p);
  const double sine = length(p - a) * std::sin(alpha), lambda = sine * sine, c = dot(p, p);
  const auto part = [&](double theta) {
    const double s = std::sin(theta), k = std::cos(theta), root = std::sqrt(lambda + s * s * c);
    const double inner = 1 - 2 * c * k / (c * (1 + k) + lambda + std::sqrt(lambda) * root);
    return -(s > 0 ? 0.5 : -0.5) *
           (2 * std::sqrt(c) * std::atan(std::sqrt(c) * k / root) +
            std::sqrt(lambda) * std::log(2 * std::sqrt(lambda) * s * s / ((1 - k) * (1 - k)) * inner));
  };
  return -std::abs(part(pi - alpha) - part(pi - alpha - beta) - std::sqrt(c) * beta) / (4 * pi);
}

}  // namespace

void green(const IndexedMesh& cage, const Vec3d& point, std::vector<double>& weights) {
  weights.assign(cage.vertices.size(), 0);
  for (const auto& t : cage.triangles) {
    std::array<Vec3d, 3> v, across;
    std::array<double, 3> second;
    for (std::size_t i = 0; i < 3; ++i) v[i] = cage.vertices[t[i]] - point;
    Vec3d normal = cross(v[1] - v[0], v[2] - v[0]);
    normal = (1 / length(normal)) * normal;
    const Vec3d foot = dot(v[0], normal) * normal;
    double first = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d &a = v[i], &b = v[(i + 1) % 3];
      const double side = dot(cross(a - foot, b - foot), normal) < 0 ? -1 : 1;
      first += side * triangle_integral(foot, a, b);
      second[i] = triangle_integral({}, b, a);
      across[i] = cross(b, a);
      across[i] = (1 / length(across[i])) * across[i];
    }
    first = -std::abs(first);
    Vec3d w = first * normal;
    for (std::size_t i = 0; i < 3; ++i) w = w + second[i] * across[i];
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d& n = across[(i + 1) % 3];
      weights[t[i]] += dot(n, w) / dot(n, v[i]);
    }
    weights.push_back(-first);
  }
}

}  // namespace bp::reference
