#include "io/scene/detail/degenerate.h"

#include <cmath>
#include <span>

// A triangle has no area iff the cross product of two edges, n = (b - a) x (c - a), is zero in each component.
// First in doubles, with u = 2^-53. An edge component e = fl(b - a) has relative error u; so each product fl(e f) is
// off by at most (3u + O(u^2)) |e f| and their difference by u more of the result:
//   |n_computed - n_exact| <= 5 u (|e1 f2| + |e2 f1|).
// 8 u of the computed products is on the safe side of that: a component larger than it is not zero, and one such
// component settles that there is area. Only what is left is settled exactly, by expansions: unevaluated sums of
// doubles that do not overlap (Dekker 1971, Knuth 1969; Shewchuk 1997, Theorem 10: adding a double to an expansion
// keeps it one). An expansion is zero iff all its terms are. No step underflows or overflows: coordinates are whole
// multiples of 2^-352 (1e-90 > 2^-299, 53 bits), so differences are too, products and their rounding errors are
// multiples of 2^-704, and everything is below 2^602.

namespace bp {

namespace {

/// a + b = sum + error, exactly.
struct Sum {
  double value, error;
  Sum(double a, double b) : value(a + b) {
    const double of_b = value - a;
    error = (a - (value - of_b)) + (b - of_b);
  }
};

/// A sum of up to 16 doubles, kept exactly.
class Expansion {
 public:
  void add(double x) {
    for (int i = 0; i < size_; ++i) {
      const Sum s(x, terms_[i]);
      terms_[i] = s.error;
      x = s.value;
    }
    terms_[size_++] = x;
  }
  void add_product(double a, double b) {
    const double p = a * b;
    add(std::fma(a, b, -p));
    add(p);
  }
  void add_product(const Sum& a, const Sum& b) {
    add_product(a.error, b.error);
    add_product(a.error, b.value);
    add_product(a.value, b.error);
    add_product(a.value, b.value);
  }
  [[nodiscard]] bool zero() const {
    for (int i = 0; i < size_; ++i) {
      if (terms_[i] != 0) return false;
    }
    return true;
  }

 private:
  double terms_[16];
  int size_ = 0;
};

/// Returns whether component i of the cross product is exactly zero; j and k are the axes after i.
bool exactly_zero(const TriangleD& t, std::size_t j, std::size_t k) {
  const Sum ej(t[1][j], -t[0][j]), ek(t[1][k], -t[0][k]), fj(t[2][j], -t[0][j]), fk(t[2][k], -t[0][k]);
  Expansion n;
  n.add_product(ej, fk);
  const Sum minus_ek(-ek.value, -ek.error);
  n.add_product(minus_ek, fj);
  return n.zero();
}

}  // namespace

bool is_degenerate(const TriangleD& t) {
  constexpr double kSafe = 0x1p-50;  // 8 u
  double e[3], f[3];
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = t[1][i] - t[0][i];
    f[i] = t[2][i] - t[0][i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const double p = e[j] * f[k], q = e[k] * f[j];
    if (std::abs(p - q) > kSafe * (std::abs(p) + std::abs(q))) return false;
  }
  return exactly_zero(t, 1, 2) && exactly_zero(t, 2, 0) && exactly_zero(t, 0, 1);
}

}  // namespace bp
