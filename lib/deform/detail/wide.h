#pragma once
#include <cmath>
#include <cstddef>

#include "lib/core/clones.h"

/// Doubles side by side, and vectors of them: kWide points at a time.
namespace bp::detail {

constexpr int kWide = 4;
typedef double Wide __attribute__((vector_size(8 * kWide)));
typedef long long WideBits __attribute__((vector_size(8 * kWide)));  ///< of comparisons: all ones where true

struct alignas(8 * kWide) WideVec {
  Wide x, y, z;
};

BP_INLINE void set(Wide& out, double value) {
  out = Wide{} + value;
}
BP_INLINE void root(Wide& x) {
  for (int i = 0; i < kWide; ++i) x[i] = std::sqrt(x[i]);
}
/// Bit k: lane k is true.
BP_INLINE unsigned bits_of(const WideBits& lanes) {
  unsigned bits = 0;
  for (int i = 0; i < kWide; ++i) bits |= unsigned(lanes[i] & 1) << i;
  return bits;
}
#define BP_DOT(a, b) ((a).x * (b).x + (a).y * (b).y + (a).z * (b).z)

/// out = angle of the point (t, s), s >= 0, not both 0: from 0 to pi, to 1e-15. The polynomial is the best of degree 9
/// for atan(z) / z in z^2 on [0, (sqrt 2 - 1)^2].
BP_INLINE void angle(const Wide& s, const Wide& t, Wide& out) {
  constexpr double kTangent = 0.41421356237309503, kPi = 3.141592653589793;
  constexpr double kTerms[] = {-0.02531472973194233, 0.050246342455960435, -0.06505944155503311, 0.07673529098467827,
                               -0.09089529357362555, 0.11111048820585145,  -0.14285712660659053, 0.1999999997837687,
                               -0.33333333333221343, 0.999999999999999};
  const Wide zero{};
  const Wide a = t < zero ? -t : t;
  const WideBits steep = s > a;
  const Wide most = steep ? s : a, least = steep ? a : s;
  const WideBits large = least > kTangent * most;
  const Wide z = (large ? least - most : least) / (large ? least + most : most), square = z * z;
  Wide p;
  set(p, kTerms[0]);
  for (std::size_t i = 1; i < 10; ++i) p = p * square + kTerms[i];
  p = p * z;
  p = large ? p + kPi / 4 : p;
  p = steep ? kPi / 2 - p : p;
  out = t < zero ? kPi - p : p;
}

/// out = log x, of normal x >= 1, to 1e-15: the exponent, and the series of the area tangent of (m - 1) / (m + 1) for
/// the rest m of x from 1/sqrt 2 to sqrt 2.
BP_INLINE void logarithm(const Wide& x, Wide& out) {
  constexpr long long kOne = 0x3FF0000000000000, kMantissa = 0xFFFFFFFFFFFFF, kCount = 0x4330000000000000;
  constexpr double kLog2 = 0.6931471805599453, kRoot2 = 1.4142135623730951, kLarge = 4503599627370496.0;
  const WideBits bits = (WideBits)x;
  Wide m = (Wide)((bits & kMantissa) | kOne), exponent = (Wide)((bits >> 52) + kCount) - kLarge - 1023.0;
  const WideBits large = m > kRoot2;
  m = large ? m * 0.5 : m;
  exponent = large ? exponent + 1.0 : exponent;
  const Wide z = (m - 1.0) / (m + 1.0), square = z * z;
  Wide p;
  set(p, 1.0 / 19);
  for (int n = 17; n > 0; n -= 2) p = p * square + 1.0 / n;
  out = exponent * kLog2 + 2.0 * (z * p);
}

// The same of one number in extended precision, for code that is written once for both.
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
