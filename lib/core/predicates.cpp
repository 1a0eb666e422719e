// Expansion arithmetic: a number is kept as an unevaluated sum of doubles that do not overlap, smallest first, so the
// sign is that of the last one. The error-free transformations are due to Dekker and Knuth, the growing of expansions
// to Shewchuk (docs/references.md: [Knu69] [Dek71] [She97]). We enumerate all terms of the determinant rather than
// refine in stages: a scene seldom comes here, and what comes here (coplanar faces, shared edges) mostly has exact
// differences and many zero terms, which cost nothing.
#include "lib/core/predicates.h"

namespace bp::detail {

namespace {

/// value + error, exactly.
struct Pair {
  double value, error;
};

Pair two_sum(double a, double b) {
  const double s = a + b, bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}
Pair two_diff(double a, double b) {
  return two_sum(a, -b);
}
Pair two_product(double a, double b) {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

/// Exact sum of at most `kMax` doubles. Components are non-zero, do not overlap, and grow in magnitude.
template <int kMax>
class Expansion {
 public:
  void add(double x) {
    if (x == 0) return;
    int n = 0;
    for (int i = 0; i < n_; ++i) {
      const Pair s = two_sum(x, part_[i]);
      if (s.error != 0) part_[n++] = s.error;  // n <= i: never overwrites a part still to be read
      x = s.value;
    }
    if (x != 0) part_[n++] = x;
    n_ = n;
  }
  void add_product(double x, double y) {
    if (x == 0 || y == 0) return;
    const Pair p = two_product(x, y);
    add(p.error), add(p.value);
  }
  void add_product(double x, double y, double z) {
    if (x == 0 || y == 0 || z == 0) return;
    const Pair p = two_product(x, y);
    add_product(p.error, z), add_product(p.value, z);
  }
  [[nodiscard]] int sign() const { return n_ == 0 ? 0 : sign_of(part_[n_ - 1]); }

 private:
  int n_ = 0;
  double part_[kMax];
};

template <int kMax>
void add_product(Expansion<kMax>& e, const Pair& x, const Pair& y, double sign) {
  for (const double a : {x.error, x.value})
    for (const double b : {y.error, y.value}) e.add_product(sign * a, b);
}

template <int kMax>
void add_product(Expansion<kMax>& e, const Pair& x, const Pair& y, const Pair& z, double sign) {
  for (const double a : {x.error, x.value})
    for (const double b : {y.error, y.value})
      for (const double c : {z.error, z.value}) e.add_product(sign * a, b, c);
}

}  // namespace

int orient3d_exact(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  Pair u[3], v[3], w[3];
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = two_diff(b[i], a[i]);
    v[i] = two_diff(c[i], a[i]);
    w[i] = two_diff(d[i], a[i]);
  }
  Expansion<6 * 8 * 4> det;  // 6 terms of 8 products of doubles, 4 doubles each
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    add_product(det, u[i], v[j], w[k], 1);
    add_product(det, u[j], v[i], w[k], -1);
  }
  return det.sign();
}

int orient2d_exact(const Vec3d& a, const Vec3d& b, const Vec3d& c, int axis) {
  const std::size_t i = std::size_t(axis + 1) % 3, j = std::size_t(axis + 2) % 3;
  Expansion<2 * 4 * 2> det;
  add_product(det, two_diff(b[i], a[i]), two_diff(c[j], a[j]), 1);
  add_product(det, two_diff(b[j], a[j]), two_diff(c[i], a[i]), -1);
  return det.sign();
}

}  // namespace bp::detail
