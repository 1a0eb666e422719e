#include "lib/image/surface_views.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr double kMargin = 1.125;       // of the bounds' diagonal, that a view shows
constexpr double kFullDepth = 1.0 / 8;  // of the diagonal
/// Pixels along the square that a colour is the mean of: details that are smaller may move.
constexpr double kColorPixels = 3;

/// Returns the direction of a view: six along the axes, eight along diagonals.
Vec3d direction(std::size_t view) {
  Vec3d d{};
  if (view < 6) {
    d[view / 2] = view % 2 == 0 ? 1 : -1;
    return d;
  }
  for (std::size_t i = 0; i < 3; ++i) d[i] = (view - 6) >> i & 1 ? 1 : -1;
  return unit(d, d);
}

/// Right, down and away from the viewer.
struct Axes {
  Vec3d right, down, away;
  explicit Axes(std::size_t view) : away(direction(view)) {
    const Vec3d other = std::abs(away[2]) > 0.9 ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
    right = unit(cross(away, other), other);
    down = cross(away, right);
  }
};

/// Returns the normals of the triangles; zeros for one without area.
std::vector<std::array<float, 3>> normals_of(std::span<const TriangleD> triangles) {
  std::vector<std::array<float, 3>> normals;
  normals.reserve(triangles.size());
  for (const TriangleD& t : triangles) {
    const Vec3d n = unit(cross(t[1] - t[0], t[2] - t[0]), {});
    normals.push_back({float(n[0]), float(n[1]), float(n[2])});
  }
  return normals;
}

/// Returns the cosine between two surfaces that are seen from both sides.
double cosine(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return std::abs(double(a[0]) * b[0] + double(a[1]) * b[1] + double(a[2]) * b[2]);
}

/// A triangle as a view shows it: x and y in pixels, and depth.
using SeenTriangle = std::array<Vec3d, 3>;

/// Returns the shares of the corners at a pixel's middle; less than 0 outside, and none for a triangle without area.
std::optional<std::array<double, 3>> shares_at(const SeenTriangle& t, int x, int y) {
  const auto& [a, b, c] = t;
  const double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
  if (area == 0 || !std::isfinite(area)) return {};
  const double px = x + 0.5, py = y + 0.5;
  const double u = ((b[0] - px) * (c[1] - py) - (c[0] - px) * (b[1] - py)) / area;
  const double v = ((c[0] - px) * (a[1] - py) - (a[0] - px) * (c[1] - py)) / area;
  return std::array{u, v, 1 - u - v};
}

/// Returns the least and the largest x at which the triangle meets the horizontal line at y; {inf, -inf} if it does not
/// meet it.
std::array<double, 2> span_of(const SeenTriangle& t, double y) {
  std::array<double, 2> span{HUGE_VAL, -HUGE_VAL};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &p = t[k], &q = t[(k + 1) % 3];
    if (std::min(p[1], q[1]) > y || std::max(p[1], q[1]) < y) continue;
    const double part = p[1] == q[1] ? 0 : (y - p[1]) / (q[1] - p[1]);
    for (const double x : {p[0] + part * (q[0] - p[0]), p[1] == q[1] ? q[0] : p[0] + part * (q[0] - p[0])})
      span = {std::min(span[0], x), std::max(span[1], x)};
  }
  return span;
}

/// Draws into pixels with a depth and the number of a triangle. The first one of triangles at one depth stays.
template <class Pixel>
class DepthCanvas {
 public:
  DepthCanvas(std::vector<Pixel>& pixels, int side) : pixels_(pixels), side_(side) {}

  /// O(rows and pixels of the triangle).
  void draw(const SeenTriangle& t, std::uint32_t number) {
    const int top = first(std::min({t[0][1], t[1][1], t[2][1]})), bottom = last(std::max({t[0][1], t[1][1], t[2][1]}));
    for (int y = top; y <= bottom; ++y) {
      const std::array<double, 2> span = span_of(t, y + 0.5);
      const int right = last(span[1] + 1);  // a pixel more on both sides, since the span is rounded
      for (int x = first(span[0] - 1); x <= right; ++x) {
        const auto shares = shares_at(t, x, y);
        if (!shares) return;
        const auto& [u, v, w] = *shares;
        if (u < 0 || v < 0 || u + v > 1) continue;
        Pixel& pixel = pixels_[std::size_t(y) * std::size_t(side_) + std::size_t(x)];
        const auto depth = float(u * t[0][2] + v * t[1][2] + w * t[2][2]);
        if (depth < pixel.depth) pixel = {depth, number};
      }
    }
  }

 private:
  [[nodiscard]] int first(double x) const { return int(std::clamp(std::ceil(x - 0.5), 0.0, double(side_))); }
  [[nodiscard]] int last(double x) const { return int(std::clamp(std::floor(x - 0.5), -1.0, double(side_ - 1))); }
  std::vector<Pixel>& pixels_;
  int side_;
};

/// Returns how far two colours are apart: 1 for black and white.
double apart_of(const SurfaceViews::Color& a, const SurfaceViews::Color& b) {
  int most = 0;
  for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(int(a[i]) - int(b[i])));
  return most / 255.0;
}

/// Moves triangles into a view.
class Projection {
 public:
  Projection(std::size_t view, const Bounds3d& bounds, double pixels)
      : axes_(view), middle_(0.5 * (bounds.min + bounds.max)), pixels_(pixels) {}
  [[nodiscard]] SeenTriangle operator()(const TriangleD& t) const {
    SeenTriangle seen;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d p = t[k] - middle_;
      seen[k] = {SurfaceViews::kSide / 2.0 + pixels_ * dot(p, axes_.right),
                 SurfaceViews::kSide / 2.0 + pixels_ * dot(p, axes_.down), pixels_ * dot(p, axes_.away)};
    }
    return seen;
  }

 private:
  const Axes axes_;
  const Vec3d middle_;
  const double pixels_;
};

}  // namespace

SurfaceViews::SurfaceViews(std::span<const TriangleD> triangles, const Bounds3d& bounds, const ColorAt& color)
    : bounds_(bounds), normals_(normals_of(triangles)), views_(kViews), colors_(kViews) {
  parallel_for(std::int64_t(kViews), [&](std::int64_t i) {
    const auto view = std::size_t(i);
    views_[view] = drawn(triangles, view);
    if (color) colors_[view] = colors_of(triangles, view, views_[view], color);
  });
}

double SurfaceViews::pixels_per_unit() const {
  return kSide / (kMargin * std::max(bounds_.diagonal(), std::numeric_limits<double>::min()));
}

SurfaceViews::Pixels SurfaceViews::drawn(std::span<const TriangleD> triangles, std::size_t view) const {
  Pixels all(std::size_t(kSide) * kSide, {kNothing, 0});
  DepthCanvas canvas(all, kSide);
  const Projection projection(view, bounds_, pixels_per_unit());
  for (std::size_t i = 0; i < triangles.size(); ++i) canvas.draw(projection(triangles[i]), std::uint32_t(i));
  return all;
}

SurfaceViews::Colors SurfaceViews::colors_of(std::span<const TriangleD> triangles, std::size_t view,
                                             const Pixels& pixels, const ColorAt& color) const {
  Colors all(pixels.size());
  const Projection projection(view, bounds_, pixels_per_unit());
  const double side = kColorPixels / pixels_per_unit();
  for (std::size_t p = 0; p < pixels.size(); ++p) {
    if (!(pixels[p].depth < kNothing)) continue;
    const std::uint32_t i = pixels[p].triangle;
    const auto shares = shares_at(projection(triangles[i]), int(p % kSide), int(p / kSide));
    if (shares) all[p] = color(i, *shares, side);
  }
  return all;
}

double SurfaceViews::difference(std::span<const TriangleD> others, const ColorAt& color) const {
  std::vector<double> different(kViews), shown(kViews);
  const std::vector<std::array<float, 3>> normals = normals_of(others);
  parallel_for(std::int64_t(kViews), [&](std::int64_t i) {
    const Pixels& own = views_[std::size_t(i)];
    const Pixels other = drawn(others, std::size_t(i));
    const Colors& painted = colors_[std::size_t(i)];
    Colors other_painted;
    if (color && !painted.empty()) other_painted = colors_of(others, std::size_t(i), other, color);
    for (std::size_t p = 0; p < own.size(); ++p) {
      const bool here = own[p].depth < kNothing, there = other[p].depth < kNothing;
      shown[std::size_t(i)] += here || there;
      double part = here != there;
      if (here && there) {
        const double apart = std::abs(double(own[p].depth) - other[p].depth) / (kFullDepth * kSide / kMargin);
        part = std::max(apart, 1 - cosine(normals_[own[p].triangle], normals[other[p].triangle]));
        if (!other_painted.empty()) part = std::max(part, apart_of(painted[p], other_painted[p]));
        part = std::min(1.0, part);
      }
      different[std::size_t(i)] += part;
    }
  });
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < kViews; ++i) {
    if (!(shown[i] > 0)) continue;  // both are flat, and are seen from the side
    sum += different[i] / shown[i];
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

std::vector<std::uint32_t> SurfaceViews::shown() const {
  std::vector<char> is_shown(normals_.size(), 0);
  for (const Pixels& view : views_)
    for (const Pixel& pixel : view)
      if (pixel.depth < kNothing) is_shown[pixel.triangle] = 1;
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < is_shown.size(); ++i)
    if (is_shown[i]) all.push_back(i);
  return all;
}

}  // namespace bp
