#include "lib/image/surface_views.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr double kMargin = 1.125;       // of the bounds' diagonal, that a view shows
constexpr double kFullDepth = 1.0 / 8;  // of the diagonal

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

/// Draws into pixels with a depth and the number of a triangle. The first one of triangles at one depth stays.
template <class Pixel>
class DepthCanvas {
 public:
  DepthCanvas(std::vector<Pixel>& pixels, int side) : pixels_(pixels), side_(side) {}

  /// Corners: x and y in pixels, and depth.
  void draw(const std::array<Vec3d, 3>& t, std::uint32_t number) {
    const auto& [a, b, c] = t;
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if (area == 0 || !std::isfinite(area)) return;
    const int left = first(std::min({a[0], b[0], c[0]})), right = last(std::max({a[0], b[0], c[0]}));
    const int top = first(std::min({a[1], b[1], c[1]})), bottom = last(std::max({a[1], b[1], c[1]}));
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double u = ((b[0] - px) * (c[1] - py) - (c[0] - px) * (b[1] - py)) / area;
        const double v = ((c[0] - px) * (a[1] - py) - (a[0] - px) * (c[1] - py)) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        Pixel& pixel = pixels_[std::size_t(y) * std::size_t(side_) + std::size_t(x)];
        const auto depth = float(u * a[2] + v * b[2] + (1 - u - v) * c[2]);
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

}  // namespace

SurfaceViews::SurfaceViews(std::span<const TriangleD> triangles, const Bounds3d& bounds)
    : bounds_(bounds), normals_(normals_of(triangles)), views_(kViews) {
  parallel_for(std::int64_t(kViews),
               [&](std::int64_t i) { views_[std::size_t(i)] = drawn(triangles, std::size_t(i)); });
}

SurfaceViews::Pixels SurfaceViews::drawn(std::span<const TriangleD> triangles, std::size_t view) const {
  Pixels all(std::size_t(kSide) * kSide, {kNothing, 0});
  DepthCanvas canvas(all, kSide);
  const Axes axes(view);
  const Vec3d middle = 0.5 * (bounds_.min + bounds_.max);
  const double pixels = kSide / (kMargin * std::max(bounds_.diagonal(), std::numeric_limits<double>::min()));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::array<Vec3d, 3> seen;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d p = triangles[i][k] - middle;
      seen[k] = {kSide / 2.0 + pixels * dot(p, axes.right), kSide / 2.0 + pixels * dot(p, axes.down),
                 pixels * dot(p, axes.away)};
    }
    canvas.draw(seen, std::uint32_t(i));
  }
  return all;
}

double SurfaceViews::difference(std::span<const TriangleD> others) const {
  std::vector<double> different(kViews), shown(kViews);
  const std::vector<std::array<float, 3>> normals = normals_of(others);
  parallel_for(std::int64_t(kViews), [&](std::int64_t i) {
    const Pixels& own = views_[std::size_t(i)];
    const Pixels other = drawn(others, std::size_t(i));
    for (std::size_t p = 0; p < own.size(); ++p) {
      const bool here = own[p].depth < kNothing, there = other[p].depth < kNothing;
      shown[std::size_t(i)] += here || there;
      double part = here != there;
      if (here && there) {
        const double apart = std::abs(double(own[p].depth) - other[p].depth) / (kFullDepth * kSide / kMargin);
        part = std::min(1.0, std::max(apart, 1 - cosine(normals_[own[p].triangle], normals[other[p].triangle])));
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
