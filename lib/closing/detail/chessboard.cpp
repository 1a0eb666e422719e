// The chessboard distance F obeys, among the voxels q of the half space z(q) <= z(p),
//   F(p) = min( distance to the q in the slice of p,  1 + min of F over the 3 x 3 voxels below p ),
// because the first step from p towards a q of a lower slice may go down by one and sideways by up to one at once. The
// same holds for z(q) >= z(p) with the slices swept the other way, and one dimension down within a slice. A voxel is in
// the dilation if either of its two half-space distances is within its radius. So the two sweeps need not meet: each
// keeps the slice before, and sets bits. Distances stop at `far`, one more than the largest radius.
#include "lib/closing/detail/chessboard.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "lib/closing/detail/simd.h"

namespace bp::detail {

namespace {

constexpr std::int32_t kPad = 16;  // lanes before and after each row, always `far`

/// Sets to[i] to the least of to[i], far, and 1 + the least of from[i - 1 .. i + 1].
template <class T>
BP_INLINE void step_row(const T* from, T* to, std::int32_t n, T far) {
  for (std::int32_t i = 0; i < n; ++i) {
    const T m = std::min(std::min(from[i - 1], from[i]), from[i + 1]);
    to[i] = std::min(to[i], std::min(T(m + 1), far));
  }
}
template <class T>
BP_INLINE void min3_row(const T* a, const T* b, const T* c, T* to, std::int32_t n) {
  for (std::int32_t i = 0; i < n; ++i) to[i] = std::min(std::min(a[i], b[i]), c[i]);
}
template <class T>
BP_INLINE std::uint64_t within_word(const T* distance, const T* radius) {
  std::uint8_t yes[kLanes];
  for (int i = 0; i < kLanes; ++i) yes[i] = distance[i] <= radius[i] ? 255 : 0;
  return nonzero_bits(yes);
}
template <class T>
BP_INLINE std::uint64_t within_one(const T* distance, T radius) {
  std::uint8_t yes[kLanes];
  for (int i = 0; i < kLanes; ++i) yes[i] = distance[i] <= radius ? 255 : 0;
  return nonzero_bits(yes);
}

using Byte = std::uint8_t;
using Short = std::uint16_t;
BP_CLONES void step(const Byte* from, Byte* to, std::int32_t n, Byte far) {
  step_row(from, to, n, far);
}
BP_CLONES void step(const Short* from, Short* to, std::int32_t n, Short far) {
  step_row(from, to, n, far);
}
BP_CLONES void min3(const Byte* a, const Byte* b, const Byte* c, Byte* to, std::int32_t n) {
  min3_row(a, b, c, to, n);
}
BP_CLONES void min3(const Short* a, const Short* b, const Short* c, Short* to, std::int32_t n) {
  min3_row(a, b, c, to, n);
}
BP_CLONES std::uint64_t within(const Byte* distance, const Byte* radius) {
  return within_word(distance, radius);
}
BP_CLONES std::uint64_t within(const Short* distance, const Short* radius) {
  return within_word(distance, radius);
}
BP_CLONES std::uint64_t within(const Byte* distance, Byte radius) {
  return within_one(distance, radius);
}
BP_CLONES std::uint64_t within(const Short* distance, Short radius) {
  return within_one(distance, radius);
}

bool any(const std::uint64_t* words, std::int32_t n) {
  return std::any_of(words, words + n, [](std::uint64_t w) { return w != 0; });
}

/// Returns the first bit at or after `i` that is set (or clear, if `flip` is all ones); 64 * count if there is none.
std::int32_t next_bit(const std::uint64_t* words, std::int32_t count, std::int32_t i, std::uint64_t flip) {
  for (; i < 64 * count; i = (i | 63) + 1) {
    const std::uint64_t rest = (words[i / 64] ^ flip) >> (i % 64);
    if (rest != 0) return i + std::countr_zero(rest);
  }
  return 64 * count;
}

/// Writes distances along one row of bits: 0 at set bits, growing away from each run of them up to `far`.
template <class T>
void distances_along_row(const std::uint64_t* words, std::int32_t count, T far, T* row) {
  const std::int32_t n = 64 * count;
  std::fill_n(row, n, far);
  for (std::int32_t end = 0, begin = next_bit(words, count, 0, 0); begin < n; begin = next_bit(words, count, end, 0)) {
    for (std::int32_t x = begin - 1; x >= std::max(begin + 1 - far, end); --x) row[x] = std::min(row[x], T(begin - x));
    end = next_bit(words, count, begin, ~std::uint64_t(0));
    std::fill(row + begin, row + end, T(0));
    for (std::int32_t x = end; x < std::min(end + far - 1, n); ++x) row[x] = T(x - end + 1);
  }
}

}  // namespace

template <class T>
struct VaryingCubeDilation::Sweep {
  const BitBox& solid;
  const ScaleLattice& scale;
  const VoxelBox region;
  BitBox& out;
  VaryingCubeDilation& scratch;
  const T far;
  /// The region grown by the reach, without parts beyond both solid and region: no shortest path leads there.
  VoxelBox work{};
  VoxelBox seeds{};  ///< the part of the solid inside `work`
  std::size_t stride = 0, slice = 0;
  T *plane = nullptr, *now = nullptr, *before = nullptr, *lowest = nullptr, *radii = nullptr;

  Sweep(const BitBox& g, const ScaleLattice& s, const VoxelBox& v, std::int32_t r, BitBox& d, std::vector<T>& memory,
        VaryingCubeDilation& owner)
      : solid(g), scale(s), region(v), out(d), scratch(owner), far(T(r + 1)) {
    work = region.grown(r);
    work.min.x = region.min.x - (r + 63) / 64 * 64;
    work.max.x = region.max.x + (r + 63) / 64 * 64;
    work = intersect(work, hull(solid.box(), region));
    seeds = intersect(work, solid.box());
    stride = std::size_t(width() + 2 * kPad);
    slice = stride * std::size_t(height() + 2);  // a row of `far` below and above
    memory.assign(3 * slice + stride + kLanes, far);
    plane = memory.data();
    now = plane + slice;
    before = now + slice;
    lowest = before + slice;
    radii = lowest + stride;
  }
  [[nodiscard]] std::int32_t width() const { return work.max.x - work.min.x; }
  [[nodiscard]] std::int32_t height() const { return work.max.y - work.min.y; }
  /// Returns row y of a slice, counted from work.min.y; -1 and height() are allowed.
  [[nodiscard]] T* row(T* slice_, std::int32_t y) const { return slice_ + std::size_t(y + 1) * stride + kPad; }

  void run() {
    sweep(work.min.z, region.max.z, 1);
    sweep(work.max.z - 1, region.min.z - 1, -1);
  }

  void sweep(std::int32_t first, std::int32_t last, std::int32_t direction) {
    std::int32_t alive = 0;  // number of slices until the distances of the last solid voxels are all `far`
    for (std::int32_t z = first; z != last; z += direction) {
      const bool seeded = measure_slice(z);
      if (seeded) {
        if (alive == 0) std::fill_n(now, slice, far);
        alive = far;
      } else if (alive > 0) {
        --alive;
      }
      if (alive == 0) continue;
      std::swap(now, before);
      for (std::int32_t y = 0; y < height(); ++y) combine_row(y, seeded);
      if (z >= region.min.z && z < region.max.z) emit(z);
    }
  }

  /// Fills `plane` with the distances within slice z. Returns false, and leaves `plane`, if the slice holds no solid
  /// voxel.
  bool measure_slice(std::int32_t z) {
    if (z < seeds.min.z || z >= seeds.max.z) return false;
    const std::int32_t first = (seeds.min.x - solid.box().min.x) / 64, count = (seeds.max.x - seeds.min.x) / 64;
    bool seeded = false;
    for (std::int32_t y = seeds.min.y; y < seeds.max.y; ++y) {
      const std::uint64_t* words = solid.row(y, z) + first;
      if (!any(words, count)) continue;
      if (!seeded) std::fill_n(plane, slice, far);
      seeded = true;
      scratch.line_.assign(std::size_t(width() / 64), 0);
      std::copy_n(words, count, scratch.line_.data() + (seeds.min.x - work.min.x) / 64);
      distances_along_row(scratch.line_.data(), width() / 64, far, row(plane, y - work.min.y));
    }
    if (!seeded) return false;
    for (std::int32_t y = 1; y < height(); ++y) step(row(plane, y - 1), row(plane, y), width(), far);
    for (std::int32_t y = height() - 2; y >= 0; --y) step(row(plane, y + 1), row(plane, y), width(), far);
    return true;
  }

  void combine_row(std::int32_t y, bool seeded) {
    T* to = row(now, y);
    if (seeded) {
      std::copy_n(row(plane, y), width(), to);
    } else {
      std::fill_n(to, width(), far);
    }
    min3(row(before, y - 1) - 1, row(before, y) - 1, row(before, y + 1) - 1, lowest + kPad - 1, width() + 2);
    step(lowest + kPad, to, width(), far);
  }

  /// Sets the voxels of slice z that are within their radius. Bounds of the radii decide most words. Only if the
  /// distances straddle the bounds does each voxel look up its own radius.
  void emit(std::int32_t z) {
    std::int32_t cell = std::numeric_limits<std::int32_t>::min();
    for (std::int32_t y = region.min.y; y < region.max.y; ++y) {
      if (floor_div(y, kScaleStep) != cell) {
        cell = floor_div(y, kScaleStep);
        bound_radii(y, z);
      }
      const T* distance = row(now, y - work.min.y) + (region.min.x - work.min.x);
      std::uint64_t* words = out.row(y, z) + (region.min.x - out.box().min.x) / 64;
      for (std::int32_t x = 0; x < region.max.x - region.min.x; x += 64) {
        const ScaleRange& radius = scratch.bounds_[std::size_t(x / 64)];
        const std::uint64_t perhaps = within(distance + x, T(radius.max)) & ~words[x / 64];
        if (perhaps == 0) continue;
        const std::uint64_t surely = within(distance + x, T(radius.min));
        words[x / 64] |= surely;
        if ((perhaps & ~surely) == 0) continue;
        const std::int32_t x0 = region.min.x + x;
        scratch.scales_.set(scale, y, z, x0, x0 + 64);
        scratch.scales_.radii(x0, radii);
        words[x / 64] |= within(distance + x, radii);
      }
    }
  }

  /// Finds the least and largest radius of each word, for the rows of one cell of the lattice.
  void bound_radii(std::int32_t y, std::int32_t z) {
    scratch.bounds_.resize(std::size_t(region.max.x - region.min.x) / 64);
    for (std::size_t i = 0; i < scratch.bounds_.size(); ++i) {
      const std::int32_t x = region.min.x + 64 * std::int32_t(i);
      const ScaleRange s = scale_range(scale, {{x, y, z}, {x + 64, y + kScaleStep, z + 1}});
      scratch.bounds_[i] = {Scale(cube_radius(s.min)), Scale(cube_radius(s.max))};
    }
  }
};

void VaryingCubeDilation::run(const BitBox& solid, const ScaleLattice& scale, const VoxelBox& region, BitBox& out) {
  const VoxelBox all = intersect(region, out.box());
  for (std::int32_t z = all.min.z; z < all.max.z; ++z) {
    for (std::int32_t y = all.min.y; y < all.max.y; ++y)
      std::fill_n(out.row(y, z) + (all.min.x - out.box().min.x) / 64, (all.max.x - all.min.x) / 64, 0);
  }
  if (all.empty() || solid.box().empty()) return;
  const std::int32_t r = cube_radius(scale_range(scale, all).max);
  if (r + 2 <= 255) {
    Sweep<std::uint8_t>(solid, scale, all, r, out, bytes_, *this).run();
  } else {
    Sweep<std::uint16_t>(solid, scale, all, r, out, shorts_, *this).run();
  }
}

}  // namespace bp::detail
