#include <random>

#include "lib/exact/predicates.h"
#include "tests/catch.h"

using namespace bp;

namespace {

/// Sign of the determinant for integers up to 2^50 in magnitude times powers of two, by 128-bit and long carries: the
/// coordinates are doubles that hold integers, differences fit 2^51, so terms need 153 bits. Kept as base 2^32 digits.
class BigInt {
 public:
  explicit BigInt(std::int64_t v = 0) : negative_(v < 0) {
    for (std::uint64_t m = negative_ ? 0 - std::uint64_t(v) : std::uint64_t(v); m != 0; m >>= 32)
      digits_.push_back(std::uint32_t(m));
  }
  friend BigInt operator*(const BigInt& a, const BigInt& b) {
    BigInt r;
    r.digits_.assign(a.digits_.size() + b.digits_.size(), 0);
    for (std::size_t i = 0; i < a.digits_.size(); ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < b.digits_.size() || carry != 0; ++j) {
        const std::uint64_t d = j < b.digits_.size() ? b.digits_[j] : 0;
        carry += r.digits_[i + j] + std::uint64_t(a.digits_[i]) * d;
        r.digits_[i + j] = std::uint32_t(carry);
        carry >>= 32;
      }
    }
    r.negative_ = a.negative_ != b.negative_;
    return r.trim();
  }
  friend BigInt operator-(const BigInt& a, const BigInt& b) { return a + b.negated(); }
  friend BigInt operator+(const BigInt& a, const BigInt& b) {
    if (a.negative_ == b.negative_) return BigInt(a.negative_, add(a.digits_, b.digits_));
    const bool a_larger = larger(a.digits_, b.digits_);
    return a_larger ? BigInt(a.negative_, subtract(a.digits_, b.digits_))
                    : BigInt(b.negative_, subtract(b.digits_, a.digits_));
  }
  [[nodiscard]] int sign() const { return digits_.empty() ? 0 : negative_ ? -1 : 1; }

 private:
  using Digits = std::vector<std::uint32_t>;
  BigInt(bool negative, Digits d) : negative_(negative), digits_(std::move(d)) { trim(); }
  [[nodiscard]] BigInt negated() const { return BigInt(!negative_, digits_); }
  BigInt& trim() {
    while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
    return *this;
  }
  static bool larger(const Digits& a, const Digits& b) {
    if (a.size() != b.size()) return a.size() > b.size();
    return std::lexicographical_compare(b.rbegin(), b.rend(), a.rbegin(), a.rend());
  }
  static Digits add(const Digits& a, const Digits& b) {
    Digits r;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < std::max(a.size(), b.size()) || carry != 0; ++i) {
      carry += std::uint64_t(i < a.size() ? a[i] : 0) + (i < b.size() ? b[i] : 0);
      r.push_back(std::uint32_t(carry));
      carry >>= 32;
    }
    return r;
  }
  static Digits subtract(const Digits& a, const Digits& b) {  // a >= b
    Digits r;
    std::int64_t borrow = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const std::int64_t d = std::int64_t(a[i]) - (i < b.size() ? b[i] : 0) - borrow;
      borrow = d < 0;
      r.push_back(std::uint32_t(d));
    }
    return r;
  }
  bool negative_ = false;
  Digits digits_;
};

using IntPoint = std::array<std::int64_t, 3>;

int reference_orient3d(const IntPoint& a, const IntPoint& b, const IntPoint& c, const IntPoint& d) {
  BigInt sum;
  const std::size_t next[3] = {1, 2, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = next[i], k = next[j];
    const BigInt u_i(b[i] - a[i]), u_j(b[j] - a[j]), v_i(c[i] - a[i]), v_j(c[j] - a[j]), w(d[k] - a[k]);
    sum = sum + (u_i * v_j - u_j * v_i) * w;
  }
  return sum.sign();
}

int reference_orient2d(const IntPoint& a, const IntPoint& b, const IntPoint& c, int axis) {
  const std::size_t i = std::size_t(axis + 1) % 3, j = std::size_t(axis + 2) % 3;
  return (BigInt(b[i] - a[i]) * BigInt(c[j] - a[j]) - BigInt(b[j] - a[j]) * BigInt(c[i] - a[i])).sign();
}

Vec3d as_double(const IntPoint& p, double unit = 1) {
  return {double(p[0]) * unit, double(p[1]) * unit, double(p[2]) * unit};
}
LatticeCoord as_lattice(const IntPoint& p) {
  return {p[0], p[1], p[2]};
}

}  // namespace

TEST_CASE("orientation is positive on the side the normal points to", "[quick][core]") {
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  CHECK(orient3d(a, b, c, Vec3d{0, 0, 1}) == 1);
  CHECK(orient3d(a, b, c, Vec3d{5, 7, -1e-80}) == -1);
  CHECK(orient3d(a, b, c, Vec3d{5, 7, 0}) == 0);
  CHECK(orient3d(LatticeCoord{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == 1);
  CHECK(orient3d_value(LatticeCoord{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}) == 30);
  CHECK(orient2d(a, b, c, 2) == 1);
  CHECK(orient2d(Vec3d{0, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, 0) == 1);
  CHECK(orient2d(Vec3d{0, 0, 0}, Vec3d{0, 0, 1}, Vec3d{1, 0, 0}, 1) == 1);
  CHECK(orient2d(LatticeCoord{0, 0, 0}, LatticeCoord{1, 0, 0}, LatticeCoord{0, 1, 0}, 2) == 1);
}

TEST_CASE("one unit in the last place decides an orientation", "[quick][core]") {
  const double far = 6e6, up = std::nextafter(far, 1e9), down = std::nextafter(far, 0.0);
  const Vec3d a{far, far, far}, b{far + 1, far + 2, far + 3}, c{far - 3, far + 1, far + 4};
  const Vec3d on{far + 5, far + 3, far + 2};  // a + 2 (b - a) - (c - a)
  CHECK(orient3d(a, b, c, on) == 0);
  const int above = orient3d(a, b, c, Vec3d{on[0], on[1], std::nextafter(on[2], 1e9)});
  const int below = orient3d(a, b, c, Vec3d{on[0], on[1], std::nextafter(on[2], 0.0)});
  CHECK(above == 1);
  CHECK(below == -1);
  CHECK(orient2d(Vec3d{0, 0, 0}, Vec3d{far, far, 0}, Vec3d{down, up, 0}, 2) == 1);
  CHECK(orient2d(Vec3d{0, 0, 0}, Vec3d{far, far, 0}, Vec3d{up, down, 0}, 2) == -1);
}

TEST_CASE("orientations of nearly flat tetrahedra equal big-integer arithmetic", "[quick][core]") {
  const int seed = GENERATE(range(0, 20));
  std::mt19937_64 random(std::uint64_t(seed) + 1);
  const int bits = 2 + 2 * seed;  // up to 40: the lattice's limit
  std::uniform_int_distribution<std::int64_t> coordinate(-(std::int64_t(1) << bits), std::int64_t(1) << bits);
  std::uniform_int_distribution<std::int64_t> small(-2, 2);
  int zeros = 0;
  for (int n = 0; n < 500; ++n) {
    IntPoint p[4];
    for (IntPoint& q : p) q = {coordinate(random), coordinate(random), coordinate(random)};
    if (n % 2 == 0)  // near the plane: a point of the line through two midpoints, moved by a little
      for (std::size_t i = 0; i < 3; ++i) {
        p[2][i] = 2 * (p[2][i] / 4), p[1][i] = 2 * (p[1][i] / 4), p[0][i] = 2 * (p[0][i] / 4);
        p[3][i] = (p[1][i] + p[2][i]) / 2 + (n % 4 == 0 ? 0 : small(random));
      }
    const int expected = reference_orient3d(p[0], p[1], p[2], p[3]);
    zeros += expected == 0;
    CHECK(orient3d(as_lattice(p[0]), as_lattice(p[1]), as_lattice(p[2]), as_lattice(p[3])) == expected);
    for (const double unit : {1.0, 0x1p-40, 0x1p-298, 0x1p250})
      CHECK(orient3d(as_double(p[0], unit), as_double(p[1], unit), as_double(p[2], unit), as_double(p[3], unit)) ==
            expected);
  }
  CHECK(zeros > 100);
}

TEST_CASE("turns of nearly collinear points equal big-integer arithmetic", "[quick][core]") {
  const int bits = GENERATE(3, 20, 30, 40);
  const int axis = GENERATE(0, 1, 2);
  std::mt19937_64 random(std::uint64_t(bits * 3 + axis));
  std::uniform_int_distribution<std::int64_t> coordinate(-(std::int64_t(1) << bits), std::int64_t(1) << bits);
  std::uniform_int_distribution<std::int64_t> small(-1, 1);
  int signs[3] = {};
  for (int n = 0; n < 1000; ++n) {
    IntPoint a, b, c;
    for (std::size_t i = 0; i < 3; ++i) {
      a[i] = 2 * (coordinate(random) / 2), b[i] = 2 * (coordinate(random) / 2);
      c[i] = (a[i] + b[i]) / 2 + small(random);
    }
    const int expected = reference_orient2d(a, b, c, axis);
    ++signs[expected + 1];
    CHECK(orient2d(as_lattice(a), as_lattice(b), as_lattice(c), axis) == expected);
    for (const double unit : {1.0, 0x1p-298})
      CHECK(orient2d(as_double(a, unit), as_double(b, unit), as_double(c, unit), axis) == expected);
  }
  CHECK(signs[0] > 50);
  CHECK(signs[1] > 50);
  CHECK(signs[2] > 50);
}

TEST_CASE("differences that are not exact doubles are decided exactly", "[quick][core]") {
  // Coordinates of very different size: b - a rounds. Scaled by 2^60 everything is an integer for the reference.
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> large(-(std::int64_t(1) << 50), std::int64_t(1) << 50), tiny(-3, 3);
  for (int n = 0; n < 2000; ++n) {
    const std::int64_t t = large(random) | 1;
    // p0 small, p1 and p2 huge and nearly parallel, p3 near their plane
    const IntPoint p0{tiny(random), tiny(random), tiny(random)};
    const IntPoint p1{t, 2 * t + tiny(random), 3 * t}, p2{-t, -2 * t, -3 * t + tiny(random)};
    const IntPoint p3{tiny(random), tiny(random), tiny(random)};
    const int expected = reference_orient3d(p0, p1, p2, p3);
    // one half of the points at 2^-8: differences need up to 62 bits
    const IntPoint q0{p0[0] * 256, p0[1] * 256, p0[2] * 256}, q3{p3[0] * 256, p3[1] * 256, p3[2] * 256};
    CHECK(orient3d(as_double(p0), as_double(p1), as_double(p2), as_double(p3)) == expected);
    const int fine =
        reference_orient3d(p0, {p1[0] * 256, p1[1] * 256, p1[2] * 256}, {p2[0] * 256, p2[1] * 256, p2[2] * 256}, q3);
    CHECK(orient3d(as_double(p0, 1 / 256.0), as_double(p1), as_double(p2), as_double(p3)) == fine);
    CHECK(orient3d(as_double(q0, 1 / 256.0), as_double(p1), as_double(p2), as_double(p3)) == expected);
  }
}

TEST_CASE("the lattice's extreme coordinates do not overflow", "[quick][core]") {
  const std::int64_t m = std::int64_t(1) << 40;
  CHECK(orient3d(LatticeCoord{-m, -m, -m}, {m, -m, -m}, {-m, m, -m}, {-m, -m, m}) == 1);
  CHECK(orient3d(LatticeCoord{m, m, m}, {-m, m, m}, {m, -m, m}, {m, m, -m}) == -1);
  CHECK(orient3d(LatticeCoord{m, m, -m}, {-m, m, m}, {m, -m, m}, {-m, -m, -m}) ==
        reference_orient3d({m, m, -m}, {-m, m, m}, {m, -m, m}, {-m, -m, -m}));
}

TEST_CASE("coordinates outside the domain of the predicates are recognised", "[quick][core]") {
  CHECK(in_predicate_domain(0.0));
  CHECK(in_predicate_domain(-0.0));
  CHECK(in_predicate_domain(1e-90));
  CHECK(in_predicate_domain(-1e90));
  CHECK_FALSE(in_predicate_domain(1e-91));
  CHECK_FALSE(in_predicate_domain(1e91));
  CHECK_FALSE(in_predicate_domain(std::nan("")));
  CHECK_FALSE(in_predicate_domain(HUGE_VAL));
}

TEST_CASE("three points on a line are collinear and nearly so are not", "[quick][core]") {
  const Vec3d a{0.1, 0.1, 0.1}, b{0.2, 0.2, 0.2}, c{0.4, 0.4, 0.4};
  CHECK(collinear(a, b, c));
  CHECK(collinear(a, a, b));
  CHECK_FALSE(collinear(a, b, Vec3d{0.4, 0.4, std::nextafter(0.4, 1.0)}));
}
