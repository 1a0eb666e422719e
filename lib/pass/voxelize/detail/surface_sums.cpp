#include "lib/pass/voxelize/detail/surface_sums.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "lib/core/vec3.h"

namespace bp {

/// The exponent of a double and three bits of its mantissa: bins are an eighth of an octave.
std::size_t SurfaceSums::bin_of(double distance) {
  constexpr std::int64_t kFirstOctave = 1023 - 40;  // 2^-40 scene units and less: the middle bin
  const auto top = std::int64_t(std::bit_cast<std::uint64_t>(std::abs(distance)) >> 49);
  const std::int64_t i = std::clamp<std::int64_t>(top - kFirstOctave * kPerOctave, 0, kHalf);
  return std::size_t(kHalf + (distance < 0 ? -i : i));
}

void SurfaceSums::add(std::span<const TriangleD> triangles) {
  if (axes_[0].empty()) axes_.fill(Axis(kBins));
  for (const TriangleD& t : triangles) {
    const Vec3d a = t[0] - origin_, b = t[1] - origin_, c = t[2] - origin_;
    const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
    const double area = length(normal) / 2;
    area_ += area;
    if (!std::isfinite(area)) continue;
    Bounds3d box;
    for (const Vec3d& p : t) box.add(p);
    for (std::size_t k = 0; k < 3; ++k) {
      Bin& bin = axes_[k][bin_of((a[k] + b[k] + c[k]) / 3)];
      bin.area += area;
      bin.bounds.merge(box);
    }
    bounds_.merge(box);
    volume_ += dot(a, cross(b, c)) / 6;
    normals_ = normals_ + normal;
  }
}

void SurfaceSums::merge(const SurfaceSums& other) {
  if (other.axes_[0].empty()) return;
  if (axes_[0].empty()) axes_.fill(Axis(kBins));
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < kBins; ++i) {
      axes_[k][i].area += other.axes_[k][i].area;
      axes_[k][i].bounds.merge(other.axes_[k][i].bounds);
    }
  }
  bounds_.merge(other.bounds_);
  area_ += other.area_;
  volume_ += other.volume_;
  normals_ = normals_ + other.normals_;
}

/// What lies along one axis: the bins that hold nearly all of the area, with what is near them, and what is beyond.
SurfaceSums::Split SurfaceSums::split(std::size_t k) const {
  const Axis& axis = axes_[k];
  const double most = kStrayShare / 2 * area_;  // at each end
  std::size_t first = 0, last = axis.size();
  for (double sum = axis[first].area; sum <= most && first + 1 < last; sum += axis[first].area) ++first;
  for (double sum = axis[last - 1].area; sum <= most && first + 1 < last; sum += axis[last - 1].area) --last;
  Split split;
  for (std::size_t i = first; i < last; ++i) split.rest.merge(axis[i].bounds);
  const double near = split.rest.max[k] - split.rest.min[k];
  const double low = split.rest.min[k] - near, high = split.rest.max[k] + near;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const Bin& bin = axis[i];
    if ((i >= first && i < last) || bin.bounds.empty()) continue;
    if (bin.bounds.min[k] >= low && bin.bounds.max[k] <= high) {
      split.rest.merge(bin.bounds);
    } else {
      split.part.merge(bin.bounds);
      split.area += bin.area;
    }
  }
  return split;
}

std::optional<StrayPart> SurfaceSums::stray() const {
  if (!(area_ > 0) || !std::isfinite(area_)) return {};
  StrayPart stray;
  stray.rest = bounds_;
  for (std::size_t k = 0; k < 3; ++k) {
    const double extent = bounds_.max[k] - bounds_.min[k];
    if (extent * kStrayStretch < bounds_.longest_side()) continue;  // this axis makes nothing large
    const Split at = split(k);
    if (at.part.empty() || extent <= kStrayStretch * (at.rest.max[k] - at.rest.min[k])) continue;
    for (std::size_t j = 0; j < 3; ++j) {  // what lies at the end of one axis may stretch the others, too
      stray.rest.min[j] = std::max(stray.rest.min[j], at.rest.min[j]);
      stray.rest.max[j] = std::min(stray.rest.max[j], at.rest.max[j]);
    }
    stray.part.merge(at.part);
    stray.share = std::max(stray.share, at.area / area_);
  }
  if (stray.part.empty() || stray.rest.empty()) return {};
  if (bounds_.longest_side() <= kStrayStretch * stray.rest.longest_side()) return {};
  return stray;
}

double SurfaceSums::volume() const {
  if (bounds_.empty()) return 0;
  const Vec3d middle = 0.5 * (bounds_.min + bounds_.max) - origin_;
  return volume_ - dot(middle, normals_) / 6;
}

}  // namespace bp
