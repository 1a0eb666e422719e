#pragma once
#include <cuda_runtime.h>

#include <cstdint>

/// Two neighbouring voxels' squared distances in one value, and the step of the separable transforms on them:
/// min(best, value + d^2). Voxels x and x + 16 of a word share one, so that a ballot of each half gives 16 bits in
/// order.
namespace bp {

/// 16 bits each, while squared bounds stay below kLimit. A step is one instruction on Hopper (DPX), a few elsewhere.
struct Packed16 {
  std::uint32_t v;
  /// Farther than any bound. No step is longer: square() cuts it, and between cells in reach it is at most 167^2. kFar
  /// + kFar still fits 16 bits.
  static constexpr std::uint32_t kFar = 0x7fff;
  static constexpr std::uint32_t kLimit = 160u * 160u;  ///< bounds up to here are allowed

  __device__ static Packed16 far_away() { return {kFar | kFar << 16}; }
  __device__ static Packed16 of(std::uint32_t low, std::uint32_t high) { return {low | high << 16}; }
  /// Returns the entry of the table of squares for d^2.
  __device__ static std::uint32_t square(std::uint32_t d2) { return (d2 < kFar ? d2 : kFar) * 0x10001u; }
  __device__ void step(Packed16 from, std::uint32_t d2) { v = __viaddmin_u16x2(from.v, d2, v); }
  /// Steps with a number of its own for each half, below 2^15.
  __device__ void step_each(Packed16 from, std::uint32_t low_d2, std::uint32_t high_d2) {
    v = __viaddmin_u16x2(from.v, low_d2 | high_d2 << 16, v);
  }
  __device__ std::uint32_t low() const { return v & 0xffff; }
  __device__ std::uint32_t high() const { return v >> 16; }
};

/// 32 bits each, for larger scales.
struct Packed32 {
  uint2 v;
  static constexpr std::uint32_t kFar = 0x3fffffff;
  static constexpr std::uint32_t kLimit = kFar;

  __device__ static Packed32 far_away() { return {make_uint2(kFar, kFar)}; }
  __device__ static Packed32 of(std::uint32_t low, std::uint32_t high) { return {make_uint2(low, high)}; }
  __device__ static std::uint32_t square(std::uint32_t d2) { return d2; }
  __device__ void step(Packed32 from, std::uint32_t d2) {
    v.x = __viaddmin_u32(from.v.x, d2, v.x);
    v.y = __viaddmin_u32(from.v.y, d2, v.y);
  }
  __device__ void step_each(Packed32 from, std::uint32_t low_d2, std::uint32_t high_d2) {
    v.x = __viaddmin_u32(from.v.x, low_d2, v.x);
    v.y = __viaddmin_u32(from.v.y, high_d2, v.y);
  }
  __device__ std::uint32_t low() const { return v.x; }
  __device__ std::uint32_t high() const { return v.y; }
};

/// Return the largest and the least value of a warp, in all lanes: one instruction from compute capability 8.0 on, five
/// shuffles before.
__device__ inline std::uint32_t warp_max(std::uint32_t v) {
#if !defined(__CUDA_ARCH__) || __CUDA_ARCH__ >= 800
  return __reduce_max_sync(0xffffffffu, v);
#else
  for (int step = 16; step > 0; step /= 2) v = max(v, __shfl_xor_sync(0xffffffffu, v, step));
  return v;
#endif
}
__device__ inline std::uint32_t warp_min(std::uint32_t v) {
  return ~warp_max(~v);
}

}  // namespace bp
