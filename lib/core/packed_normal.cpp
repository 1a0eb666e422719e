#include "lib/core/packed_normal.h"

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

constexpr double kSteps = 32767;

double folded(double a, double b) {
  return (1 - std::abs(b)) * (a < 0 ? -1 : 1);
}

}  // namespace

PackedNormal pack_normal(const Vec3d& n) {
  const double sum = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
  if (!(sum > 0) || !std::isfinite(sum)) return 0;
  double x = n[0] / sum, y = n[1] / sum;
  if (n[2] < 0) {
    const double u = folded(x, y);
    y = folded(y, x);
    x = u;
  }
  const auto bits = [](double c) { return std::uint32_t(std::lround(c * kSteps) + 32768); };  // 1 to 65535
  return bits(x) << 16 | bits(y);
}

Vec3d unpack_normal(PackedNormal packed) {
  if (packed == 0) return {};
  double x = (double(packed >> 16) - 32768) / kSteps, y = (double(packed & 0xFFFF) - 32768) / kSteps;
  const double z = 1 - std::abs(x) - std::abs(y);
  if (z < 0) {
    const double u = folded(x, y);
    y = folded(y, x);
    x = u;
  }
  const double l = std::sqrt(x * x + y * y + z * z);
  return {x / l, y / l, z / l};
}

}  // namespace bp
