#pragma once
#include <cmath>
#include <optional>

#include "lib/core/vec3.h"
#include "lib/image/render_options.h"

namespace bp {

/// An orthographic camera: x to the right and y down in samples; depth away from the viewer, in samples, too.
class Camera {
 public:
  explicit Camera(const RenderOptions& o) : axes_(o.up) {
    const double a = o.azimuth * (M_PI / 180), e = o.elevation * (M_PI / 180);
    right_ = {std::cos(a), std::sin(a), 0};
    forward_ = {-std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), -std::sin(e)};  // from the viewer
    up_ = {-std::sin(a) * std::sin(e), std::cos(a) * std::sin(e), std::cos(e)};
  }

  /// Sets the point of the scene that all results are relative to. It keeps precision far from the scene's origin.
  void look_at(const Vec3d& p) { origin_ = p; }

  /// Returns right, up, forward of a point of the scene, in scene units from the point of look_at().
  [[nodiscard]] Vec3d seen(const Vec3d& p) const {
    return along_axes({p[0] - origin_[0], p[1] - origin_[1], p[2] - origin_[2]});
  }

  /// Fits these bounds of seen() into width x height samples, with a margin.
  void fit(const Bounds3d& bounds, int width, int height) {
    const double w = bounds.max[0] - bounds.min[0], h = bounds.max[1] - bounds.min[1];
    const double scale = 0.92 * std::min(width / w, height / h);
    scale_ = std::isfinite(scale) && scale > 0 ? scale : 1;
    for (std::size_t i = 0; i < 3; ++i) centre_[i] = bounds.min[i] / 2 + bounds.max[i] / 2;
    middle_x_ = width / 2.0, middle_y_ = height / 2.0;
  }

  /// Enlarges by `factor`, after fit(), with `centre`, a point of the scene, in the middle.
  void zoom(double factor, const std::optional<Vec3d>& centre) {
    scale_ *= factor;
    if (centre) centre_ = seen(*centre);
  }

  [[nodiscard]] Vec3d project(const Vec3d& p) const {
    const Vec3d d = seen(p);
    return {middle_x_ + scale_ * (d[0] - centre_[0]), middle_y_ - scale_ * (d[1] - centre_[1]),
            scale_ * (d[2] - centre_[2])};
  }

  /// Returns the point of the scene that is projected to p.
  [[nodiscard]] Vec3d unproject(const Vec3d& p) const {
    const Vec3d d{centre_[0] + (p[0] - middle_x_) / scale_, centre_[1] + (middle_y_ - p[1]) / scale_,
                  centre_[2] + p[2] / scale_};
    Vec3d v{};
    for (std::size_t i = 0; i < 3; ++i) v[i] = d[0] * right_[i] + d[1] * up_[i] + d[2] * forward_[i];
    v = bp::turned(v, UpAxis::z, axes_);
    return {origin_[0] + v[0], origin_[1] + v[1], origin_[2] + v[2]};
  }

  /// Returns right, down, away from the viewer of a direction, at its length.
  [[nodiscard]] Vec3d turned(const Vec3d& direction) const {
    const Vec3d d = along_axes(direction);
    return {d[0], 0 - d[1], d[2]};
  }

  [[nodiscard]] double samples_per_unit() const { return scale_; }

 private:
  [[nodiscard]] Vec3d along_axes(const Vec3d& d) const {
    const Vec3d v = bp::turned(d, axes_, UpAxis::z);
    return {dot(v, right_), dot(v, up_), dot(v, forward_)};
  }
  static double dot(const Vec3d& a, const Vec3d& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

  UpAxis axes_;
  Vec3d right_{}, up_{}, forward_{}, origin_{}, centre_{};
  double scale_ = 1, middle_x_ = 0, middle_y_ = 0;
};

}  // namespace bp
