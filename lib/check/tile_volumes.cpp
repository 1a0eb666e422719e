#include "lib/check/tile_volumes.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "lib/core/vec3.h"
#include "lib/exact/expansion.h"
#include "lib/exact/predicates.h"

// A point p is in a box (centre c, half-axes a_i) if |(p - c) . n_i| <= |a_i . n_i| for each i, where n_i is the cross
// product of the other two (Cramer's rule). Both sides are sums of products of the file's numbers; expansions give
// their exact signs. A filter in doubles decides most points.

namespace bp {

namespace {

constexpr int kMostTerms = 28;  // terms of a transformed corner's coordinate, less that of a centre
// Relative to the sum of magnitudes: more than all roundings of a sum of 700 products.
constexpr double kFilter = 1e-12;
constexpr double kSafe = 1e-12;  // relative error of a rounded length, at most

/// A number as a sum of doubles, exactly.
class Terms {
 public:
  Terms() = default;
  explicit Terms(double x) { add(x); }
  void add(double x) {
    if (x != 0) all_[n_++] = x;
  }
  void add_product(double x, double y) {
    const ExactPair p = two_product(x, y);
    add(p.value), add(p.error);
  }
  [[nodiscard]] std::span<const double> all() const { return {all_.data(), n_}; }
  [[nodiscard]] bool is_zero() const {
    Expansion<kMostTerms> sum;
    for (const double x : all()) sum.add(x);
    return sum.sign() == 0;
  }
  [[nodiscard]] double rounded() const {
    double sum = 0;
    for (const double x : all()) sum += x;
    return sum;
  }

 private:
  std::array<double, kMostTerms> all_{};
  std::size_t n_ = 0;
};

using Point = std::array<Terms, 3>;

/// The sign of a sum of products, added one after the other.
class SignOfSum {
 public:
  void add(const Terms& a, const Terms& b, double sign = 1) {
    for (const double x : a.all())
      for (const double y : b.all()) add(sign * x, y);
  }
  void add_dot(const Point& a, const Point& b, double sign = 1) {
    for (std::size_t k = 0; k < 3; ++k) add(a[k], b[k], sign);
  }
  void add(double x, double y) {
    const double p = x * y;
    sum_ += p;
    magnitude_ += std::abs(p);
    products_.emplace_back(x, y);
  }
  [[nodiscard]] int sign() const {
    if (sum_ > kFilter * magnitude_) return 1;
    if (-sum_ > kFilter * magnitude_) return -1;
    Expansion<kAnyLength> exact;
    for (const auto& [x, y] : products_) exact.add_product(x, y);
    return exact.sign();
  }

 private:
  double sum_ = 0, magnitude_ = 0;
  std::vector<std::pair<double, double>> products_;
};

Point exact_point(const Vec3d& p) {
  return {Terms(p[0]), Terms(p[1]), Terms(p[2])};
}

Point cross_of(const Vec3d& a, const Vec3d& b) {
  Point n;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    n[k].add_product(a[i], b[j]);
    n[k].add_product(-a[j], b[i]);
  }
  return n;
}

Point minus(Point p, const Vec3d& centre) {
  for (std::size_t k = 0; k < 3; ++k) p[k].add(-centre[k]);
  return p;
}

/// Returns m applied to the sum of some points; m is by columns.
Point placed(const Transform& m, std::span<const Vec3d> sum) {
  Point out;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (const Vec3d& p : sum) out[k].add_product(m[4 * j + k], p[j]);
    }
    out[k].add(m[12 + k]);
  }
  return out;
}

/// Returns |a . n| <= b . m, where b . m is not negative.
bool at_most(const Point& a, const Point& n, const Point& b, const Point& m) {
  for (const double sign : {-1.0, 1.0}) {
    SignOfSum rest;
    rest.add_dot(b, m);
    rest.add_dot(a, n, sign);
    if (rest.sign() < 0) return false;
  }
  return true;
}

int sign_of_dot(const Point& a, const Point& b) {
  SignOfSum sum;
  sum.add_dot(a, b);
  return sum.sign();
}

Point negated(const Point& p) {
  Point out;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double x : p[k].all()) out[k].add(-x);
  }
  return out;
}

/// Returns whether a box without thickness holds the point: a rectangle, a segment or a point, whose axes are
/// orthogonal; any other holds nothing.
bool flat_holds(const TileBox& box, const Point& d) {
  std::vector<Vec3d> axes;
  for (const Vec3d& a : box.axes) {
    if (a != Vec3d{}) axes.push_back(a);
  }
  for (const Vec3d& a : axes) {
    for (const Vec3d& b : axes) {
      if (&a != &b && sign_of_dot(exact_point(a), exact_point(b)) != 0) return false;
    }
    if (!at_most(d, exact_point(a), exact_point(a), exact_point(a))) return false;
  }
  if (axes.empty()) return d[0].is_zero() && d[1].is_zero() && d[2].is_zero();
  if (axes.size() == 2) return sign_of_dot(d, cross_of(axes[0], axes[1])) == 0;
  for (std::size_t k = 0; k < 3; ++k) {  // on the line along the only axis
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    SignOfSum off;
    off.add(d[i], Terms(axes[0][j]));
    off.add(d[j], Terms(axes[0][i]), -1);
    if (off.sign() != 0) return false;
  }
  return true;
}

bool in_range(const Vec3d& p) {
  return std::all_of(p.begin(), p.end(),
                     [](double x) { return x == 0 || (std::abs(x) > 1e-60 && std::abs(x) < 1e60); });
}
bool in_range(const TileBox& box) {
  return in_range(box.centre) &&
         std::all_of(box.axes.begin(), box.axes.end(), [](const Vec3d& a) { return in_range(a); });
}

/// A box with the normals of its sides; its axes point to their side of them.
struct BoxSides {
  explicit BoxSides(const TileBox& from) : box(from) {
    for (std::size_t i = 0; i < 3; ++i) {
      axes[i] = exact_point(box.axes[i]);
      normals[i] = cross_of(box.axes[(i + 1) % 3], box.axes[(i + 2) % 3]);
    }
    const int sign = sign_of_dot(axes[0], normals[0]);
    flat = sign == 0;
    if (sign < 0) {
      for (Point& a : axes) a = negated(a);
    }
  }
  const TileBox box;
  std::array<Point, 3> axes, normals;
  bool flat = false;
};

bool box_holds(const BoxSides& sides, const Point& p) {
  const Point d = minus(p, sides.box.centre);
  if (sides.flat) return flat_holds(sides.box, d);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!at_most(d, sides.normals[i], sides.axes[i], sides.normals[i])) return false;
  }
  return true;
}

/// Returns whether each side is farther from the centre than the radius. `radius`: exact, or rounded up.
bool box_holds(const BoxSides& sides, const Point& centre, double radius) {
  if (radius == 0) return box_holds(sides, centre);
  if (sides.flat) return false;
  const Point d = minus(centre, sides.box.centre);
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& n = sides.normals[i];
    const Vec3d about{n[0].rounded(), n[1].rounded(), n[2].rounded()};
    Point length;  // length of the normal, in its first coordinate
    const auto axis = std::find_if(about.begin(), about.end(), [](double x) { return x != 0; });
    if (std::count(about.begin(), about.end(), 0.0) == 2) {
      const double sign = *axis < 0 ? -1 : 1;
      for (const double x : n[std::size_t(axis - about.begin())].all()) length[0].add(sign * x);
    } else {
      length[0].add((1 + kSafe) * bp::length(about));
    }
    for (const double sign : {-1.0, 1.0}) {
      SignOfSum rest;
      rest.add_dot(sides.axes[i], n);
      rest.add_dot(d, n, sign);
      rest.add(length[0], Terms(radius), -1);
      if (rest.sign() < 0) return false;
    }
  }
  return true;
}

/// Returns whether the ball holds p. `inner`: radius of a ball around p that must be inside as a whole.
bool ball_holds(const TileSphere& ball, const Point& p, double inner) {
  Terms reach(ball.radius);
  reach.add(-inner);
  if (!(ball.radius >= inner)) return false;
  const Point d = minus(p, ball.centre);
  SignOfSum rest;
  rest.add(reach, reach);
  rest.add_dot(d, d, -1);
  return rest.sign() >= 0;
}

/// Returns the corner of a box, as a sum.
std::array<Vec3d, 4> corner_of(const TileBox& box, std::size_t i) {
  std::array<Vec3d, 4> sum{box.centre};
  for (std::size_t k = 0; k < 3; ++k) sum[k + 1] = ((i >> k & 1) != 0 ? 1.0 : -1.0) * box.axes[k];
  return sum;
}

}  // namespace

class VolumeProof::Parts {
 public:
  explicit Parts(const TileVolume& volume) : volume_(volume) {
    in_range_ = (!volume.box || in_range(*volume.box)) && (!volume.sphere || in_range(volume.sphere->centre));
    if (volume.box && in_range_) sides_.emplace(*volume.box);
  }
  [[nodiscard]] bool holds(const Point& p, double radius) const {
    return in_range_ && (!sides_ || box_holds(*sides_, p, radius)) &&
           (!volume_.sphere || ball_holds(*volume_.sphere, p, radius));
  }
  /// Decides in doubles, with bounds on their errors. False: perhaps not.
  [[nodiscard]] bool surely_holds(const Vec3d& p) const {
    if (!in_range_ || !sides_ || sides_->flat || volume_.sphere) return false;
    const Vec3d d = p - sides_->box.centre;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d &a = sides_->box.axes[i], &b = sides_->box.axes[(i + 1) % 3], &c = sides_->box.axes[(i + 2) % 3];
      const Vec3d n = cross(b, c);
      double magnitude = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        magnitude += (std::abs(d[k]) + std::abs(a[k])) * (std::abs(b[u] * c[v]) + std::abs(b[v] * c[u]));
      }
      if (!(std::abs(dot(d, n)) + kFilter * magnitude <= std::abs(dot(a, n)))) return false;
    }
    return true;
  }

 private:
  const TileVolume volume_;
  std::optional<BoxSides> sides_;
  bool in_range_ = true;
};

VolumeProof::VolumeProof(const TileVolume& volume) : parts_(std::make_unique<Parts>(volume)) {}
VolumeProof::~VolumeProof() = default;

bool VolumeProof::holds(const Vec3d& p) const {
  return in_range(p) && (parts_->surely_holds(p) || parts_->holds(exact_point(p), 0));
}

bool VolumeProof::holds(const TileVolume& inner, const Transform& m) const {
  if (inner.box) {
    if (!in_range(*inner.box)) return false;
    for (std::size_t i = 0; i < 8; ++i) {
      if (!parts_->holds(placed(m, corner_of(*inner.box, i)), 0)) return false;
    }
  }
  if (!inner.sphere) return true;
  const double scale = largest_scale(m), radius = inner.sphere->radius * (scale == 1 ? 1 : scale * (1 + kSafe));
  return in_range(inner.sphere->centre) && parts_->holds(placed(m, {&inner.sphere->centre, 1}), radius);
}

double beyond(const TileVolume& volume, const Vec3d& p) {
  double worst = 0;
  if (volume.box) {
    const Vec3d d = p - volume.box->centre;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d n = cross(volume.box->axes[(i + 1) % 3], volume.box->axes[(i + 2) % 3]);
      const double height = dot(volume.box->axes[i], n);
      const double along = height != 0 ? std::abs(dot(d, n) / height) : std::abs(dot(d, n)) > 0 ? HUGE_VAL : 0;
      worst = std::max(worst, along - 1);
    }
  }
  if (volume.sphere) worst = std::max(worst, length(p - volume.sphere->centre) / volume.sphere->radius - 1);
  return worst;
}

}  // namespace bp
