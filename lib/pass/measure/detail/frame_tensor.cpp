#include "lib/pass/measure/detail/frame_tensor.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"

namespace bp::detail {

namespace {

struct Monomial {
  int a, b, c;   ///< x^a y^b z^c
  double times;  ///< 4! / (a! b! c!)
};
constexpr std::array<Monomial, FrameTensor::kParts> kMonomials{{{4, 0, 0, 1},
                                                                {0, 4, 0, 1},
                                                                {0, 0, 4, 1},
                                                                {3, 1, 0, 4},
                                                                {3, 0, 1, 4},
                                                                {1, 3, 0, 4},
                                                                {0, 3, 1, 4},
                                                                {1, 0, 3, 4},
                                                                {0, 1, 3, 4},
                                                                {2, 2, 0, 6},
                                                                {2, 0, 2, 6},
                                                                {0, 2, 2, 6},
                                                                {2, 1, 1, 12},
                                                                {1, 2, 1, 12},
                                                                {1, 1, 2, 12}}};

struct Powers {
  double p[3][5];
  explicit Powers(const Vec3d& v) {
    for (std::size_t i = 0; i < 3; ++i) {
      p[i][0] = 1;
      for (int k = 1; k < 5; ++k) p[i][k] = p[i][k - 1] * v[i];
    }
  }
  [[nodiscard]] double of(int a, int b, int c) const {
    return a < 0 || b < 0 || c < 0 ? 0 : p[0][a] * p[1][b] * p[2][c];
  }
};

Frame transposed_inverse(const Frame& m) {
  const Vec3d a = cross(m[1], m[2]), b = cross(m[2], m[0]), c = cross(m[0], m[1]);
  const double det = dot(m[0], a);
  return {(1 / det) * a, (1 / det) * b, (1 / det) * c};
}

/// Returns the nearest rotation of a matrix with a positive determinant.
Frame polar(Frame m) {
  double change = 1;
  for (int i = 0; i < 60 && change > 1e-28; ++i) {
    const Frame t = transposed_inverse(m);
    change = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d next = 0.5 * (m[k] + t[k]);
      change += dot(next - m[k], next - m[k]);
      m[k] = next;
    }
  }
  return m;
}

Frame frame_of(const std::array<double, 4>& q) {
  const auto [w, x, y, z] = q;
  const double n = w * w + x * x + y * y + z * z;
  return {Vec3d{1 - 2 * (y * y + z * z) / n, 2 * (x * y - z * w) / n, 2 * (x * z + y * w) / n},
          Vec3d{2 * (x * y + z * w) / n, 1 - 2 * (x * x + z * z) / n, 2 * (y * z - x * w) / n},
          Vec3d{2 * (x * z - y * w) / n, 2 * (y * z + x * w) / n, 1 - 2 * (x * x + y * y) / n}};
}

std::array<double, 4> quaternion_of(const Frame& r) {
  const double t[4] = {1 + r[0][0] + r[1][1] + r[2][2], 1 + r[0][0] - r[1][1] - r[2][2],
                       1 - r[0][0] + r[1][1] - r[2][2], 1 - r[0][0] - r[1][1] + r[2][2]};
  const double yz = r[2][1] - r[1][2], zx = r[0][2] - r[2][0], xy = r[1][0] - r[0][1];
  const double pxy = r[1][0] + r[0][1], pzx = r[0][2] + r[2][0], pyz = r[2][1] + r[1][2];
  std::array<double, 4> q{};
  switch (std::max_element(t, t + 4) - t) {
    case 0:
      q = {t[0], yz, zx, xy};
      break;
    case 1:
      q = {yz, t[1], pxy, pzx};
      break;
    case 2:
      q = {zx, pxy, t[2], pyz};
      break;
    default:
      q = {xy, pzx, pyz, t[3]};
  }
  const double n = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]) * (q[0] < 0 ? -1 : 1);
  for (double& part : q) part /= n;
  return q;
}

/// Ascends to a better frame. Each step takes the axes nearest to the gradients, which never lowers a convex function.
/// A little of the frame itself is kept, for tensors that say nothing about a direction.
Frame ascend(const FrameTensor& tensor, Frame frame, double keep) {
  constexpr int kMostSteps = 200;
  for (int step = 0; step < kMostSteps; ++step) {
    Frame next;
    for (std::size_t i = 0; i < 3; ++i) next[i] = tensor.gradient(frame[i]) + keep * frame[i];
    next = polar(next);
    double change = 0;
    for (std::size_t i = 0; i < 3; ++i) change += dot(next[i] - frame[i], next[i] - frame[i]);
    frame = next;
    if (change < 1e-20) break;
  }
  return frame;
}

}  // namespace

void FrameTensor::add(const Vec3d& n, double w) {
  const Powers p(n);
  for (std::size_t i = 0; i < kParts; ++i) m[i] += w * p.of(kMonomials[i].a, kMonomials[i].b, kMonomials[i].c);
}

Vec3d FrameTensor::gradient(const Vec3d& x) const {
  const Powers p(x);
  Vec3d g{};
  for (std::size_t i = 0; i < kParts; ++i) {
    const auto [a, b, c, times] = kMonomials[i];
    const double s = 0.25 * times * m[i];
    g[0] += s * a * p.of(a - 1, b, c);
    g[1] += s * b * p.of(a, b - 1, c);
    g[2] += s * c * p.of(a, b, c - 1);
  }
  return g;
}

Frame best_frame(const FrameTensor& tensor) {
  // Starts: not turned; turned by 45 degrees around each axis; and around both diagonals of the octants, both ways.
  constexpr double kTurn = 0.41421356237309503, kSkew = 0.25;
  static constexpr std::array<std::array<double, 4>, 12> kStarts{{{1, 0, 0, 0},
                                                                  {1, kTurn, 0, 0},
                                                                  {1, 0, kTurn, 0},
                                                                  {1, 0, 0, kTurn},
                                                                  {1, kSkew, kSkew, kSkew},
                                                                  {1, -kSkew, -kSkew, -kSkew},
                                                                  {1, kSkew, -kSkew, kSkew},
                                                                  {1, -kSkew, kSkew, -kSkew},
                                                                  {1, kSkew, kSkew, -kSkew},
                                                                  {1, -kSkew, -kSkew, kSkew},
                                                                  {1, -kSkew, kSkew, kSkew},
                                                                  {1, kSkew, -kSkew, -kSkew}}};
  const double total =
      tensor.m[0] + tensor.m[1] + tensor.m[2] + 2 * (tensor.m[9] + tensor.m[10] + tensor.m[11]);  // sum of all weights
  if (!(total > 0)) return {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  Frame best{};
  double most = -1;
  for (const auto& start : kStarts) {
    const Frame frame = ascend(tensor, frame_of(start), 1e-3 * total);
    double value = 0;
    for (const Vec3d& axis : frame) value += dot(axis, tensor.gradient(axis));
    if (value > most + 1e-9 * total) best = frame, most = value;  // the first of equal ones wins
  }
  return best;
}

std::vector<std::array<double, 4>> turns_of(const Frame& frame) {
  static constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
  std::vector<std::array<double, 4>> turns;
  for (const auto& order : kOrders) {
    for (int signs = 0; signs < 8; ++signs) {
      Frame r;
      for (std::size_t i = 0; i < 3; ++i) r[i] = (signs >> i & 1 ? -1.0 : 1.0) * frame[std::size_t(order[i])];
      if (dot(cross(r[0], r[1]), r[2]) > 0) turns.push_back(quaternion_of(r));
    }
  }
  return turns;
}

std::array<double, 4> least_turn(const Frame& frame) {
  std::array<double, 4> best{-1, 0, 0, 0};
  for (const std::array<double, 4>& q : turns_of(frame)) {
    if (q[0] > best[0] + 1e-12) best = q;
  }
  return best;
}

double likeness(const Frame& a, const Frame& b) {
  double least = 1;
  for (const Vec3d& axis : a) {
    double most = 0;
    for (const Vec3d& other : b) most = std::max(most, std::abs(dot(axis, other)));
    least = std::min(least, most);
  }
  return least;
}

}  // namespace bp::detail
