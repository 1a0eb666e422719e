#pragma once
#include <cmath>

/// Expansion arithmetic. A number is an unevaluated sum of doubles that do not overlap, smallest first, so its sign is
/// that of the last one. The error-free transformations are due to Knuth and Dekker, the growing of expansions to
/// Shewchuk (docs/references.md: [Knu69] [Dek71] [She97]). The arithmetic is exact if nothing underflows or overflows.
/// It needs rounding to nearest and no contraction of a*b+c.
namespace bp {

/// The pair stands for value + error, exactly.
struct ExactPair {
  double value, error;
};

[[nodiscard]] inline ExactPair two_sum(double a, double b) {
  const double s = a + b, bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}
[[nodiscard]] inline ExactPair two_diff(double a, double b) {
  return two_sum(a, -b);
}
[[nodiscard]] inline ExactPair two_product(double a, double b) {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

/// Bits of doubles range from 2^-1074 to 2^1023, and components have distinct bits, so no expansion is longer than
/// this.
constexpr int kAnyLength = 2100;

/// An exact sum of at most `kMax` doubles, or of any number of finite ones if kMax >= kAnyLength. Components are
/// non-zero, do not overlap, and grow in magnitude.
template <int kMax>
class Expansion {
 public:
  void add(double x) {
    if (x == 0) return;
    int n = 0;
    for (int i = 0; i < n_; ++i) {
      const ExactPair s = two_sum(x, part_[i]);
      if (s.error != 0) part_[n++] = s.error;  // n <= i: it never overwrites a part that is still to be read
      x = s.value;
    }
    if (x != 0) part_[n++] = x;
    n_ = n;
  }
  void add_product(double x, double y) {
    if (x == 0 || y == 0) return;
    const ExactPair p = two_product(x, y);
    add(p.error), add(p.value);
  }
  void add_product(double x, double y, double z) {
    if (x == 0 || y == 0 || z == 0) return;
    const ExactPair p = two_product(x, y);
    add_product(p.error, z), add_product(p.value, z);
  }
  [[nodiscard]] int sign() const { return n_ == 0 ? 0 : part_[n_ - 1] > 0 ? 1 : -1; }

 private:
  int n_ = 0;
  double part_[kMax];
};

}  // namespace bp
