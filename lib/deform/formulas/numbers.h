#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "lib/core/clones.h"
#include "lib/core/host_device.h"

/// The number types of the formulas of coordinates: a double; several doubles side by side on the CPU; long doubles. A
/// formula is written once, as a template of its `Real`. It consists of IEEE operations in one order, also for angles
/// and logarithms. So a CPU and a GPU find the same bits, if neither contracts products and sums.
namespace bp::detail {

#define BP_FORMULA BP_HD BP_INLINE
#define BP_DOT(a, b) ((a).x * (b).x + (a).y * (b).y + (a).z * (b).z)

/// A vector, aligned as vectors of doubles are where they exist: code for a plain CPU and its clones share it.
template <class Real>
struct alignas(sizeof(Real)) Vec {
  Real x, y, z;
};

/// Operations on numbers: root(x), any(condition), and a number as the integer with its bits.
template <class Real>
struct Numbers;

template <>
struct Numbers<double> {
  using Bits = long long;
  static BP_FORMULA void root(double& x) { x = std::sqrt(x); }
  static BP_FORMULA bool any(bool condition) { return condition; }
  static BP_FORMULA void bits(const double& x, Bits& out) { std::memcpy(&out, &x, sizeof(x)); }
  static BP_FORMULA void number(const Bits& bits, double& out) { std::memcpy(&out, &bits, sizeof(out)); }
};

template <class Real>
BP_FORMULA void root(Real& x) {
  Numbers<Real>::root(x);
}

/// Sets `out` to the angle of the point (t, s), s >= 0, not both 0: from 0 to pi, right to 1e-15. The polynomial is the
/// best of degree 9 for atan(z) / z in z^2 on [0, (sqrt 2 - 1)^2].
template <class Real>
BP_FORMULA void angle(const Real& s, const Real& t, Real& out) {
  constexpr double kTangent = 0.41421356237309503, kPi = 3.141592653589793;
  constexpr double kTerms[] = {-0.02531472973194233, 0.050246342455960435, -0.06505944155503311, 0.07673529098467827,
                               -0.09089529357362555, 0.11111048820585145,  -0.14285712660659053, 0.1999999997837687,
                               -0.33333333333221343, 0.999999999999999};
  const Real zero{};
  const Real a = t < zero ? -t : t;
  const auto steep = s > a;
  const Real most = steep ? s : a, least = steep ? a : s;
  const auto large = least > kTangent * most;
  const Real z = (large ? least - most : least) / (large ? least + most : most), square = z * z;
  Real p = zero + kTerms[0];
  for (std::size_t i = 1; i < 10; ++i) p = p * square + kTerms[i];
  p = p * z;
  p = large ? p + kPi / 4 : p;
  p = steep ? kPi / 2 - p : p;
  out = t < zero ? kPi - p : p;
}

/// Sets `out` to log x for a normal x >= 1, right to 1e-15. It is the exponent, and the series of the area tangent of
/// (m - 1) / (m + 1) for the rest m of x from 1/sqrt 2 to sqrt 2.
template <class Real>
BP_FORMULA void logarithm(const Real& x, Real& out) {
  constexpr long long kOne = 0x3FF0000000000000, kMantissa = 0xFFFFFFFFFFFFF, kCount = 0x4330000000000000;
  constexpr double kLog2 = 0.6931471805599453, kRoot2 = 1.4142135623730951, kLarge = 4503599627370496.0;
  typename Numbers<Real>::Bits bits{};
  Numbers<Real>::bits(x, bits);
  Real m, exponent;
  Numbers<Real>::number((bits & kMantissa) | kOne, m);
  Numbers<Real>::number((bits >> 52) + kCount, exponent);
  exponent = exponent - kLarge - 1023.0;
  const auto large = m > kRoot2;
  m = large ? m * 0.5 : m;
  exponent = large ? exponent + 1.0 : exponent;
  const Real z = (m - 1.0) / (m + 1.0), square = z * z;
  Real p = Real{} + 1.0 / 19;
  for (int n = 17; n > 0; n -= 2) p = p * square + 1.0 / n;
  out = exponent * kLog2 + 2.0 * (z * p);
}

// Extended precision is for the CPU only.
BP_INLINE void root(long double& x) {
  x = std::sqrt(x);
}
BP_INLINE void angle(const long double& s, const long double& t, long double& out) {
  out = std::atan2(s, t);
}
BP_INLINE void logarithm(const long double& x, long double& out) {
  out = std::log(x);
}

}  // namespace bp::detail
