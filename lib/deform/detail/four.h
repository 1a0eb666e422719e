#pragma once
#include <cmath>
#include <cstddef>

#include "lib/core/clones.h"

/// Four doubles side by side, and vectors of them: four points at a time.
namespace bp::detail {

typedef double Four __attribute__((vector_size(32)));
typedef long long FourBits __attribute__((vector_size(32)));  ///< of comparisons: all ones where true

struct alignas(32) FourVec {
  Four x, y, z;
};

BP_INLINE void set(Four& out, double value) {
  out = Four{value, value, value, value};
}
BP_INLINE void root(Four& x) {
  for (int i = 0; i < 4; ++i) x[i] = std::sqrt(x[i]);
}
#define BP_DOT(a, b) ((a).x * (b).x + (a).y * (b).y + (a).z * (b).z)

/// out = angle of the point (t, s), s >= 0, not both 0: from 0 to pi, to 1e-15. The polynomial is the best of degree 9
/// for atan(z) / z in z^2 on [0, (sqrt 2 - 1)^2].
BP_INLINE void angle(const Four& s, const Four& t, Four& out) {
  constexpr double kTangent = 0.41421356237309503, kPi = 3.141592653589793;
  constexpr double kTerms[] = {-0.02531472973194233, 0.050246342455960435, -0.06505944155503311, 0.07673529098467827,
                               -0.09089529357362555, 0.11111048820585145,  -0.14285712660659053, 0.1999999997837687,
                               -0.33333333333221343, 0.999999999999999};
  const Four zero{};
  const Four a = t < zero ? -t : t;
  const FourBits steep = s > a;
  const Four most = steep ? s : a, least = steep ? a : s;
  const FourBits large = least > kTangent * most;
  const Four z = (large ? least - most : least) / (large ? least + most : most), square = z * z;
  Four p;
  set(p, kTerms[0]);
  for (std::size_t i = 1; i < 10; ++i) p = p * square + kTerms[i];
  p = p * z;
  p = large ? p + kPi / 4 : p;
  p = steep ? kPi / 2 - p : p;
  out = t < zero ? kPi - p : p;
}

}  // namespace bp::detail
