#include "lib/geometry/signed_volume.h"

#include <fmt/format.h>

#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr double kLeftOver = 1e-9;   // of the area: the area vectors of a closed surface add up to at most this
constexpr double kOfNormal = 2e-15;  // of the product of a triangle's edges: its area may be rounding below that

}  // namespace

void SignedVolume::add(const TriangleD& t) {
  const Vec3d u = t[1] - t[0], v = t[2] - t[0], normal = cross(u, v);
  six_volumes_ += dot(t[0] - origin_, normal);
  two_areas_ = two_areas_ + normal;
  two_area_ += length(normal);
  rounding_ += kOfNormal * length(u) * length(v);
}

void SignedVolume::add(const SignedVolume& v) {
  six_volumes_ += v.six_volumes_;
  two_areas_ = two_areas_ + v.two_areas_;
  two_area_ += v.two_area_;
  rounding_ += v.rounding_;
}

std::optional<double> SignedVolume::value() const {
  if (!(length(two_areas_) <= kLeftOver * two_area_ + rounding_)) return {};
  return six_volumes_ / 6;
}

std::string volume_text(const std::optional<double>& volume) {
  if (!volume) return "none: the surface is open, or faces both ways";
  return fmt::format("{:.9g}{}", *volume, *volume < 0 ? ": the faces point inwards" : "");
}

}  // namespace bp
