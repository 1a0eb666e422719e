#include "lib/geometry/triangle_totals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/vec3.h"
#include "lib/store/content_hash.h"
#include "lib/store/hex.h"

namespace bp {

namespace {

ResultKey hash_of(TriangleD t) {
  for (Vec3d& p : t) {
    for (double& c : p) c = std::isnan(c) ? std::numeric_limits<double>::quiet_NaN() : c + 0.0;
  }
  if (t[0] == t[0] && t[1] == t[1] && t[2] == t[2])
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  static_assert(sizeof(TriangleD) == 72);
  return content_hash(std::as_bytes(std::span(&t, 1)));
}

}  // namespace

void TriangleTotals::add(std::span<const TriangleD> batch) {
  for (const TriangleD& t : batch) {
    const auto [high, low] = hash_of(t).words;
    checksum_low += low;
    checksum_high += high + (checksum_low < low ? 1 : 0);
    ++triangles;
    const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
    const double twice_area = std::sqrt(dot(normal, normal));
    if (!std::isfinite(twice_area)) continue;
    if (bounds.empty()) sum_ = SignedVolume(t[0]);
    for (const Vec3d& p : t) bounds.add(p);
    area += twice_area / 2;
    sum_.add(t);
  }
  volume = sum_.value();
}

std::string TriangleTotals::checksum() const {
  return hex_of(checksum_high, checksum_low);
}

Bounds3d bounds_of(TriangleSource& scene) {
  Bounds3d bounds;
  scene.rewind();
  for (std::vector<TriangleD> chunk; scene.read(chunk);) {
    for (const TriangleD& t : chunk)
      for (const Vec3d& p : t) bounds.add(p);
  }
  return bounds;
}

}  // namespace bp
