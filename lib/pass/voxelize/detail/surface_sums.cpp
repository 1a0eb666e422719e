#include "lib/pass/voxelize/detail/surface_sums.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "lib/core/clones.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
}

/// Returns the bin of a distance: the double's exponent and three bits of its mantissa, so that a bin is an eighth of
/// an octave.
BP_INLINE std::size_t SurfaceSums::bin_of(double distance) {
  constexpr std::int64_t kFirstOctave = 1023 - 40;  // 2^-40 scene units and less: the middle bin
  const auto top = std::int64_t(std::bit_cast<std::uint64_t>(std::abs(distance)) >> 49);
  const std::int64_t i = std::clamp<std::int64_t>(top - kFirstOctave * kPerOctave, 0, kHalf);
  return std::size_t(kHalf + (distance < 0 ? -i : i));
}

void SurfaceSums::Axis::add(std::size_t i, const Bin& bin) {
  if (bin.bounds.empty()) return;
  if (bins.empty()) bins.resize(kBins);
  bins[i].area += bin.area;
  bins[i].bounds.merge(bin.bounds);
  begin = std::min(begin, i);
  end = std::max(end, i + 1);
}

/// Sums over triangles. Each vector has x, y, z, and the number that follows in memory, which is not used.
struct SurfaceSums::Lanes {
  typedef double Four __attribute__((vector_size(32)));
  struct Box {
    Four low = Four{} + kInfinity, high = Four{} - kInfinity;
    BP_INLINE void merge(const Box& b) {
      low = b.low < low ? b.low : low;
      high = high < b.high ? b.high : high;
    }
    [[nodiscard]] Bounds3d bounds() const { return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}; }
  };
  struct Run {  // consecutive triangles in one bin: neighbours in a file are neighbours in space
    std::size_t at = 0;
    double area = 0;
    Box box;
  };
  SurfaceSums& sums;
  Four origin, extent{}, normals{};
  double area = 0, volume = 0;
  Box box;
  std::array<Run, 3> runs{};

  explicit Lanes(SurfaceSums& s) : sums(s), origin{s.origin_[0], s.origin_[1], s.origin_[2], 0} {}

  void end_run(std::size_t axis) {
    const Run& run = runs[axis];
    sums.axes_[axis].add(run.at, {run.area, run.box.bounds()});
  }
  void end() {
    for (std::size_t k = 0; k < 3; ++k) end_run(k);
    sums.bounds_.merge(box.bounds());
    sums.area_ += area, sums.extent_ += extent[0] + extent[1] + extent[2], sums.volume_ += volume;
    sums.normals_ = sums.normals_ + Vec3d{normals[0], normals[1], normals[2]};
  }
  /// `corners`: nine coordinates, and a tenth number that is read and not used.
  BP_INLINE void add(const double* corners) {
    Four a, b, c;
    std::memcpy(&a, corners, sizeof a);
    std::memcpy(&b, corners + 3, sizeof b);
    std::memcpy(&c, corners + 6, sizeof c);
    Box here;
    here.low = a < b ? a : b;
    here.low = c < here.low ? c : here.low;
    here.high = a < b ? b : a;
    here.high = here.high < c ? c : here.high;
    box.merge(here);
    extent += here.high - here.low;
    const Four e = b - a, f = c - a;
    const Four e_yzx = __builtin_shufflevector(e, e, 1, 2, 0, 3), e_zxy = __builtin_shufflevector(e, e, 2, 0, 1, 3);
    const Four f_yzx = __builtin_shufflevector(f, f, 1, 2, 0, 3), f_zxy = __builtin_shufflevector(f, f, 2, 0, 1, 3);
    const Four normal = e_yzx * f_zxy - e_zxy * f_yzx;
    const Four square = normal * normal;
    const double area_here = std::sqrt(square[0] + square[1] + square[2]) / 2;
    area += area_here;
    if (!(area_here <= std::numeric_limits<double>::max())) return;
    const Four middle = ((a - origin) + (b - origin) + (c - origin)) / 3;
    for (std::size_t k = 0; k < 3; ++k) {
      Run& run = runs[k];
      const std::size_t at = bin_of(middle[k]);
      if (at != run.at) {
        end_run(k);
        run = {at, 0, {}};
      }
      run.area += area_here;
      run.box.merge(here);
    }
    const Four of_volume = (a - origin) * normal;
    volume += (of_volume[0] + of_volume[1] + of_volume[2]) / 6;
    normals += normal;
  }
  BP_CLONES static void add_all(const double* corners, std::size_t n, Lanes& lanes) {
    for (std::size_t i = 0; i < n; ++i) lanes.add(corners + 9 * i);
  }
};

void SurfaceSums::add(std::span<const TriangleD> triangles) {
  if (triangles.empty()) return;
  Lanes lanes(*this);
  const std::size_t n = triangles.size() - 1;
  Lanes::add_all(triangles[0][0].data(), n, lanes);
  double last[10]{};  // the last triangle, since no number follows it in memory
  std::memcpy(last, &triangles[n], sizeof(TriangleD));
  Lanes::add_all(last, 1, lanes);
  lanes.end();
}

void SurfaceSums::merge(const SurfaceSums& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = other.axes_[k].begin; i < other.axes_[k].end; ++i) axes_[k].add(i, other.axes_[k].bins[i]);
  }
  bounds_.merge(other.bounds_);
  area_ += other.area_;
  extent_ += other.extent_;
  volume_ += other.volume_;
  normals_ = normals_ + other.normals_;
}

void SurfaceSums::reset(const Vec3d& origin) {
  std::array<Axis, 3> axes = std::move(axes_);
  for (Axis& axis : axes) {
    for (std::size_t i = axis.begin; i < axis.end; ++i) axis.bins[i] = {};
    axis.begin = kBins, axis.end = 0;
  }
  *this = SurfaceSums(origin);
  axes_ = std::move(axes);
}

/// The division of an axis: the bins that hold nearly all of the area with the bins near them, and what lies beyond.
SurfaceSums::Split SurfaceSums::split(std::size_t k) const {
  const std::vector<Bin>& axis = axes_[k].bins;
  const double most = kStrayShare / 2 * area_;  // largest area beyond each end
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
    if (extent * kStrayStretch < bounds_.longest_side()) continue;  // this axis does not make the bounds large
    const Split at = split(k);
    if (at.part.empty() || extent <= kStrayStretch * (at.rest.max[k] - at.rest.min[k])) continue;
    for (std::size_t j = 0; j < 3; ++j) {  // the part at the end of one axis may stretch the others, too
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
