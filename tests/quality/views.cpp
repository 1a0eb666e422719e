#include "tests/quality/views.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/vec3.h"

namespace bp::quality {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

ViewAxes view_from(double azimuth, double elevation) {
  const double a = azimuth * kDegree, e = elevation * kDegree;
  const Vec3d back{std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)},
      right{std::cos(a), 0, -std::sin(a)};
  return {right, cross(back, right), -1.0 * back};
}

void add_ring(std::vector<ViewAxes>& views, double elevation) {
  constexpr double kStep = 30, kTurn = 360;
  for (double azimuth = 0; azimuth < kTurn; azimuth += kStep) views.push_back(view_from(azimuth, elevation));
}

}  // namespace

std::vector<ViewAxes> silhouette_views() {
  std::vector<ViewAxes> views;
  for (const double elevation : {0.0, 15.0, 45.0}) add_ring(views, elevation);
  return views;
}

std::vector<ViewAxes> all_views() {
  constexpr double kBelow = -45, kPole = 90;
  std::vector<ViewAxes> views = silhouette_views();
  add_ring(views, kBelow);
  views.push_back(view_from(0, kPole));
  views.push_back(view_from(0, -kPole));
  return views;
}

Picture::Picture(const ViewAxes& axes, const Bounds3d& bounds)
    : axes_(axes),
      triangle_(std::size_t(kSide) * kSide, kNothing),
      depth_(triangle_.size(), std::numeric_limits<double>::infinity()) {
  constexpr double kRoom = 1.15;
  centre_ = 0.5 * (bounds.min + bounds.max);
  const double radius = kRoom * length(bounds.max - bounds.min) / 2;
  if (radius > 0) pixels_per_unit_ = kSide / (2 * radius);
}

Vec3d Picture::projected(const Vec3d& p) const {
  const Vec3d d = p - centre_;
  constexpr double kMiddle = kSide / 2.0;
  return {kMiddle + pixels_per_unit_ * dot(d, axes_.right), kMiddle - pixels_per_unit_ * dot(d, axes_.up),
          dot(d, axes_.forward)};
}

void Picture::draw(const std::vector<TriangleD>& mesh) {
  for (std::size_t i = 0; i < mesh.size(); ++i) draw(mesh[i], std::uint32_t(i));
}

void Picture::draw(const TriangleD& t, std::uint32_t number) {
  const Vec3d a = projected(t[0]), b = projected(t[1]), c = projected(t[2]);
  const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  if (area == 0) return;
  const auto range = [](double p, double q, double r) {
    const double lo = std::min({p, q, r}) - 0.5, hi = std::max({p, q, r}) - 0.5;
    return std::pair(int(std::ceil(std::clamp(lo, 0.0, double(kSide)))),
                     int(std::floor(std::clamp(hi, -1.0, kSide - 1.0))));
  };
  const auto [x0, x1] = range(a[0], b[0], c[0]);
  const auto [y0, y1] = range(a[1], b[1], c[1]);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double u = ((b[0] - px) * (c[1] - py) - (b[1] - py) * (c[0] - px)) / area;
      const double v = ((c[0] - px) * (a[1] - py) - (c[1] - py) * (a[0] - px)) / area;
      if (u < 0 || v < 0 || u + v > 1) continue;
      const double depth = u * a[2] + v * b[2] + (1 - u - v) * c[2];
      if (depth >= depth_[index(x, y)]) continue;
      depth_[index(x, y)] = depth;
      triangle_[index(x, y)] = number;
    }
  }
}

Vec3d Picture::point(int x, int y) const {
  constexpr double kMiddle = kSide / 2.0;
  const double r = (x + 0.5 - kMiddle) / pixels_per_unit_, u = (kMiddle - y - 0.5) / pixels_per_unit_;
  return centre_ + r * axes_.right + u * axes_.up + depth_[index(x, y)] * axes_.forward;
}

}  // namespace bp::quality
