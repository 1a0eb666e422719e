#include "lib/exact/wide_predicates.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bp {

namespace {

constexpr int kLeastExponent = -1074;  // every finite double is a whole multiple of 2^-1074

/// A whole number of any size, as a sign and a magnitude.
class Wide {
 public:
  Wide() = default;
  /// Makes x in units of 2^-1074.
  explicit Wide(double x) : negative_(x < 0) {
    int exponent = 0;
    auto mantissa = std::uint64_t(std::ldexp(std::frexp(std::abs(x), &exponent), 53));
    int shift = exponent - 53 - kLeastExponent;
    if (shift < 0) mantissa >>= -shift, shift = 0;  // denormal: the bits shifted out are 0
    const auto first = std::size_t(shift) / 32;
    const int rest = shift % 32;
    const std::uint64_t low = mantissa << rest;
    digits_.assign(first + 3, 0);
    digits_[first] = std::uint32_t(low);
    digits_[first + 1] = std::uint32_t(low >> 32);
    digits_[first + 2] = rest > 0 ? std::uint32_t(mantissa >> (64 - rest)) : 0;
    trim();
  }

  friend Wide operator-(Wide a) {
    a.negative_ = !a.negative_;
    return a;
  }
  friend Wide operator+(const Wide& a, const Wide& b) {
    if (a.negative_ == b.negative_) return sum(a, b);
    return is_less(a, b) ? difference(b, a) : difference(a, b);
  }
  friend Wide operator-(const Wide& a, const Wide& b) { return a + -b; }
  friend Wide operator*(const Wide& a, const Wide& b) {
    Wide p;
    p.negative_ = a.negative_ != b.negative_;
    p.digits_.assign(a.digits_.size() + b.digits_.size(), 0);
    for (std::size_t i = 0; i < a.digits_.size(); ++i) {
      std::uint64_t carry = 0;
      for (std::size_t k = 0; k < b.digits_.size(); ++k) {
        carry += std::uint64_t(a.digits_[i]) * b.digits_[k] + p.digits_[i + k];
        p.digits_[i + k] = std::uint32_t(carry);
        carry >>= 32;
      }
      p.digits_[i + b.digits_.size()] = std::uint32_t(carry);
    }
    p.trim();
    return p;
  }
  [[nodiscard]] int sign() const { return digits_.empty() ? 0 : negative_ ? -1 : 1; }

 private:
  [[nodiscard]] std::uint32_t digit(std::size_t i) const { return i < digits_.size() ? digits_[i] : 0; }
  void trim() {
    while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
  }
  /// Compares magnitudes.
  static bool is_less(const Wide& a, const Wide& b) {
    if (a.digits_.size() != b.digits_.size()) return a.digits_.size() < b.digits_.size();
    return std::lexicographical_compare(a.digits_.rbegin(), a.digits_.rend(), b.digits_.rbegin(), b.digits_.rend());
  }
  /// Adds magnitudes, and takes the sign of a.
  static Wide sum(const Wide& a, const Wide& b) {
    Wide s;
    s.negative_ = a.negative_;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < std::max(a.digits_.size(), b.digits_.size()) + 1; ++i) {
      carry += std::uint64_t(a.digit(i)) + b.digit(i);
      s.digits_.push_back(std::uint32_t(carry));
      carry >>= 32;
    }
    s.trim();
    return s;
  }
  /// Subtracts magnitudes, and takes the sign of a. |a| must not be less than |b|.
  static Wide difference(const Wide& a, const Wide& b) {
    Wide d;
    d.negative_ = a.negative_;
    std::int64_t borrow = 0;
    for (std::size_t i = 0; i < a.digits_.size(); ++i) {
      borrow += std::int64_t(a.digit(i)) - b.digit(i);
      d.digits_.push_back(std::uint32_t(borrow));
      borrow >>= 32;
    }
    d.trim();
    return d;
  }

  std::vector<std::uint32_t> digits_;  // the least digit first; the last one is not 0
  bool negative_ = false;
};

/// Returns component `i` of q - p.
Wide along(const WidePoint& p, const WidePoint& q, std::size_t i) {
  return Wide(q.at[i]) - Wide(p.at[i]);
}

}  // namespace

int orient3d(const WidePoint& a, const WidePoint& b, const WidePoint& c, const WidePoint& d) {
  Wide sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    sum = sum + (along(a, b, j) * along(a, c, k) - along(a, b, k) * along(a, c, j)) * along(a, d, i);
  }
  return sum.sign();
}

int orient2d(const WidePoint& a, const WidePoint& b, const WidePoint& c, int axis) {
  const std::size_t i = std::size_t(axis + 1) % 3, j = std::size_t(axis + 2) % 3;
  return (along(a, b, i) * along(a, c, j) - along(a, b, j) * along(a, c, i)).sign();
}

}  // namespace bp
