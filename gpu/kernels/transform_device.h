#pragma once
#include "gpu/kernels/launch.h"
#include "gpu/kernels/packed_min.h"
#include "gpu/kernels/transform_args.h"

/// Code that the passes of the transform share. Device code only.
namespace bp {

constexpr int kPairs = 16;  ///< pairs of voxels in a word

/// Values of Packed16 or Packed32 at a place of the slab.
template <class P>
__device__ P* values_at(void* buffer, const TransformArgs& a, int wl, int z, int y) {
  return static_cast<P*>(buffer) +
         ((std::size_t(wl) * std::size_t(a.shape.nz) + std::size_t(z)) * std::size_t(a.shape.ny) + std::size_t(y)) *
             kPairs;
}

/// A unit of work, from its number in a list: word of the slab, and place along y and z in units of the list.
struct UnitCoord {
  int wl, y, z;
};
__device__ inline UnitCoord unit_at(std::uint32_t id, int words, int ny) {
  const std::uint32_t rest = id / std::uint32_t(words);
  return {int(id - rest * std::uint32_t(words)), int(rest % std::uint32_t(ny)), int(rest / std::uint32_t(ny))};
}

/// Calls f with a value of the packing that the bounds allow.
template <class F>
void with_packing(const TransformArgs& a, F f) {
  if (fits_16_bits(a.bounds)) {
    f(Packed16{});
  } else {
    f(Packed32{});
  }
}

}  // namespace bp
