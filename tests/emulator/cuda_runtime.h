#pragma once
// The few parts of the CUDA runtime that gpu/ uses, on the host: kernels run block by block, every thread of a block as
// a fiber that gives way at barriers and warp collectives. Found before the real header by the emulated test program,
// so that the logic of every kernel is tested on machines without a GPU. Slow and sequential; finds wrong indices,
// missing barriers that a change of thread order reveals, and diverging collectives; knows nothing of memory ordering
// or speed.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <tuple>

#define BP_EMULATED_CUDA 1
#define __global__
#define __device__
#define __host__
#define __forceinline__ inline
#define __launch_bounds__(...)
#define __shared__ static
#define __restrict__ __restrict
#define __grid_constant__

using std::abs;
using std::max;
using std::min;

struct dim3 {
  unsigned x = 1, y = 1, z = 1;
  dim3(unsigned a = 1, unsigned b = 1, unsigned c = 1) : x(a), y(b), z(c) {}
};
struct uint2 {
  unsigned x, y;
};
struct uint4 {
  unsigned x, y, z, w;
};
struct int3 {
  int x, y, z;
};
struct ushort2 {
  unsigned short x, y;
};
inline uint2 make_uint2(unsigned x, unsigned y) {
  return {x, y};
}
inline uint4 make_uint4(unsigned x, unsigned y, unsigned z, unsigned w) {
  return {x, y, z, w};
}
inline int3 make_int3(int x, int y, int z) {
  return {x, y, z};
}
inline ushort2 make_ushort2(unsigned short x, unsigned short y) {
  return {x, y};
}

// ---- the running thread
namespace emulator {

unsigned exchange(unsigned mask, std::uint64_t value,
                  std::uint64_t* all);  ///< warp collective: every lane's value; returns lanes
void barrier();                         ///< __syncthreads
unsigned barrier_count(bool vote);      ///< the same; returns how many threads of the block voted for it
void* dynamic_shared();
void run(dim3 grid, dim3 block, std::size_t shared_bytes, const std::function<void()>& thread);
/// Order in which the threads of a block run between barriers: 0 ascending, 1 descending, else shuffled by this seed.
void set_thread_order(unsigned seed);
/// Bytes that cudaMalloc hands out before it reports out of memory.
void set_memory_limit(std::size_t bytes);
std::size_t memory_in_use();

}  // namespace emulator

extern dim3 threadIdx, blockIdx, blockDim, gridDim;  // of the running fiber

inline void __syncthreads() {
  emulator::barrier();
}
inline int __syncthreads_or(int predicate) {
  return emulator::barrier_count(predicate != 0) != 0;
}
inline int __syncthreads_and(int predicate) {
  return emulator::barrier_count(predicate == 0) == 0;
}
inline void __syncwarp(unsigned mask = 0xffffffffu) {
  std::uint64_t all[32];
  emulator::exchange(mask, 0, all);
}
inline unsigned __ballot_sync(unsigned mask, int predicate) {
  std::uint64_t all[32];
  const unsigned lanes = emulator::exchange(mask, predicate != 0, all);
  unsigned bits = 0;
  for (unsigned i = 0; i < 32; ++i) bits |= (lanes >> i & 1) && all[i] ? 1u << i : 0u;
  return bits;
}
inline int __any_sync(unsigned mask, int predicate) {
  return __ballot_sync(mask, predicate) != 0;
}
inline int __all_sync(unsigned mask, int predicate) {
  return __ballot_sync(mask, !predicate) == 0;
}
template <class T>
T __shfl_sync(unsigned mask, T value, int source) {
  static_assert(sizeof(T) <= 8);
  std::uint64_t all[32], raw = 0;
  std::memcpy(&raw, &value, sizeof(T));
  emulator::exchange(mask, raw, all);
  std::memcpy(&value, &all[unsigned(source) & 31], sizeof(T));
  return value;
}
template <class T>
T __shfl_xor_sync(unsigned mask, T value, int with) {
  return __shfl_sync(mask, value, int((threadIdx.x & 31) ^ unsigned(with)));
}
template <class T>
T __shfl_up_sync(unsigned mask, T value, unsigned delta) {
  const unsigned lane = threadIdx.x & 31;
  return __shfl_sync(mask, value, int(lane >= delta ? lane - delta : lane));
}
template <class T>
T __shfl_down_sync(unsigned mask, T value, unsigned delta) {
  const unsigned lane = threadIdx.x & 31;
  return __shfl_sync(mask, value, int(lane + delta < 32 ? lane + delta : lane));
}
template <class F>
unsigned emulated_reduce(unsigned mask, unsigned value, F f) {
  std::uint64_t all[32];
  const unsigned lanes = emulator::exchange(mask, value, all);
  for (unsigned i = 0; i < 32; ++i) {
    if (lanes >> i & 1) value = f(value, unsigned(all[i]));
  }
  return value;
}
inline unsigned __reduce_max_sync(unsigned mask, unsigned v) {
  return emulated_reduce(mask, v, [](unsigned a, unsigned b) { return a > b ? a : b; });
}
inline unsigned __reduce_min_sync(unsigned mask, unsigned v) {
  return emulated_reduce(mask, v, [](unsigned a, unsigned b) { return a < b ? a : b; });
}
inline unsigned __reduce_or_sync(unsigned mask, unsigned v) {
  return emulated_reduce(mask, v, [](unsigned a, unsigned b) { return a | b; });
}

// ---- atomics: threads never run at the same time
template <class T, class U>
T atomicAdd(T* p, U v) {
  const T old = *p;
  *p = T(old + T(v));
  return old;
}
template <class T>
T atomicOr(T* p, T v) {
  const T old = *p;
  *p = old | v;
  return old;
}
template <class T>
T atomicMax(T* p, T v) {
  const T old = *p;
  if (v > old) *p = v;
  return old;
}
template <class T>
T atomicMin(T* p, T v) {
  const T old = *p;
  if (v < old) *p = v;
  return old;
}

// ---- integer intrinsics
inline int __popc(unsigned v) {
  return __builtin_popcount(v);
}
inline int __popcll(unsigned long long v) {
  return __builtin_popcountll(v);
}
inline int __clz(int v) {
  return v ? __builtin_clz(unsigned(v)) : 32;
}
inline int __ffs(int v) {
  return __builtin_ffs(v);
}
inline int __ffsll(long long v) {
  return __builtin_ffsll(v);
}
inline unsigned __brev(unsigned v) {
  unsigned r = 0;
  for (int i = 0; i < 32; ++i) r |= (v >> i & 1) << (31 - i);
  return r;
}
inline unsigned __funnelshift_r(unsigned lo, unsigned hi, unsigned s) {
  return unsigned((std::uint64_t(hi) << 32 | lo) >> (s & 31));
}
inline unsigned __funnelshift_l(unsigned lo, unsigned hi, unsigned s) {
  return unsigned((std::uint64_t(hi) << 32 | lo) << (s & 31) >> 32);
}
inline unsigned __byte_perm(unsigned a, unsigned b, unsigned selector) {
  const std::uint64_t bytes = std::uint64_t(b) << 32 | a;
  unsigned r = 0;
  for (int i = 0; i < 4; ++i) r |= unsigned(bytes >> (8 * (selector >> (4 * i) & 7)) & 255) << (8 * i);
  return r;
}
template <class F>
unsigned emulated_halves(unsigned a, unsigned b, F f) {
  return (f(a & 0xffff, b & 0xffff) & 0xffff) | (f(a >> 16, b >> 16) & 0xffff) << 16;
}
inline unsigned __vadd2(unsigned a, unsigned b) {
  return emulated_halves(a, b, [](unsigned x, unsigned y) { return x + y; });
}
inline unsigned __vminu2(unsigned a, unsigned b) {
  return emulated_halves(a, b, [](unsigned x, unsigned y) { return x < y ? x : y; });
}
inline unsigned __vmaxu2(unsigned a, unsigned b) {
  return emulated_halves(a, b, [](unsigned x, unsigned y) { return x > y ? x : y; });
}
inline unsigned __viaddmin_u16x2(unsigned a, unsigned b, unsigned c) {
  return __vminu2(__vadd2(a, b), c);
}
inline unsigned __viaddmin_u32(unsigned a, unsigned b, unsigned c) {
  return a + b < c ? a + b : c;
}
template <class T>
T __ldg(const T* p) {
  return *p;
}

// ---- runtime
enum cudaError_t {
  cudaSuccess = 0,
  cudaErrorMemoryAllocation = 2,
  cudaErrorInsufficientDriver = 35,
  cudaErrorNoDevice = 100,
  cudaErrorInvalidDevice = 101,
  cudaErrorNoKernelImageForDevice = 209,
  cudaErrorLaunchFailure = 719
};

namespace emulator {
/// Results that the runtime returns from now on instead of cudaSuccess, to test failures.
struct Faults {
  cudaError_t device_count = cudaSuccess, code = cudaSuccess, launch = cudaSuccess, page_locked = cudaSuccess;
  int driver_version = 13000;  ///< 0: there is no driver
};
inline Faults faults;
}  // namespace emulator

enum cudaMemcpyKind { cudaMemcpyHostToDevice, cudaMemcpyDeviceToHost, cudaMemcpyDeviceToDevice, cudaMemcpyDefault };
using cudaStream_t = struct emulated_stream*;
using cudaEvent_t = struct emulated_event*;
struct cudaDeviceProp {
  char name[256];
  int major, minor, multiProcessorCount;
  std::size_t totalGlobalMem;
  int l2CacheSize;
};
struct cudaLaunchAttribute {};
struct cudaLaunchConfig_t {
  dim3 gridDim{}, blockDim{};  // NOLINT: the names of the runtime
  std::size_t dynamicSmemBytes = 0;
  cudaStream_t stream = nullptr;
  cudaLaunchAttribute* attrs = nullptr;
  unsigned numAttrs = 0;
};
constexpr unsigned cudaStreamNonBlocking = 1, cudaEventDisableTiming = 2, cudaEventDefault = 0;
constexpr int cudaFuncAttributeMaxDynamicSharedMemorySize = 8;

cudaError_t cudaMalloc(void** p, std::size_t bytes);
cudaError_t cudaFree(void* p);
cudaError_t cudaMallocHost(void** p, std::size_t bytes);
cudaError_t cudaFreeHost(void* p);
cudaError_t cudaMemGetInfo(std::size_t* free, std::size_t* total);
cudaError_t cudaGetDeviceProperties(cudaDeviceProp* p, int device);
inline cudaError_t cudaMemcpyAsync(void* to, const void* from, std::size_t n, cudaMemcpyKind, cudaStream_t) {
  if (n) std::memmove(to, from, n);
  return cudaSuccess;
}
inline cudaError_t cudaMemsetAsync(void* to, int v, std::size_t n, cudaStream_t) {
  if (n) std::memset(to, v, n);
  return cudaSuccess;
}
inline cudaError_t cudaGetDeviceCount(int* n) {
  *n = emulator::faults.device_count == cudaSuccess ? 1 : 0;
  return emulator::faults.device_count;
}
inline cudaError_t cudaDriverGetVersion(int* version) {
  *version = emulator::faults.driver_version;
  return cudaSuccess;
}
inline cudaError_t cudaSetDevice(int device) {
  return device == 0 ? cudaSuccess : cudaErrorInvalidDevice;
}
inline cudaError_t cudaGetDevice(int* device) {
  *device = 0;
  return cudaSuccess;
}
inline cudaError_t cudaStreamCreateWithFlags(cudaStream_t* s, unsigned) {
  *s = nullptr;
  return cudaSuccess;
}
inline cudaError_t cudaStreamDestroy(cudaStream_t) {
  return cudaSuccess;
}
inline cudaError_t cudaStreamSynchronize(cudaStream_t) {
  return cudaSuccess;
}
inline cudaError_t cudaDeviceSynchronize() {
  return cudaSuccess;
}
inline cudaError_t cudaEventCreateWithFlags(cudaEvent_t* e, unsigned) {
  *e = nullptr;
  return cudaSuccess;
}
inline cudaError_t cudaEventDestroy(cudaEvent_t) {
  return cudaSuccess;
}
inline cudaError_t cudaEventRecord(cudaEvent_t, cudaStream_t) {
  return cudaSuccess;
}
inline cudaError_t cudaEventSynchronize(cudaEvent_t) {
  return cudaSuccess;
}
inline cudaError_t cudaEventElapsedTime(float* ms, cudaEvent_t, cudaEvent_t) {
  *ms = 0;
  return cudaSuccess;
}
inline cudaError_t cudaGetLastError() {
  return cudaSuccess;
}
inline cudaError_t cudaPeekAtLastError() {
  return cudaSuccess;
}
inline const char* cudaGetErrorName(cudaError_t e) {
  switch (e) {
    case cudaSuccess:
      return "cudaSuccess";
    case cudaErrorMemoryAllocation:
      return "cudaErrorMemoryAllocation";
    case cudaErrorInsufficientDriver:
      return "cudaErrorInsufficientDriver";
    case cudaErrorNoDevice:
      return "cudaErrorNoDevice";
    case cudaErrorInvalidDevice:
      return "cudaErrorInvalidDevice";
    case cudaErrorNoKernelImageForDevice:
      return "cudaErrorNoKernelImageForDevice";
    case cudaErrorLaunchFailure:
      return "cudaErrorLaunchFailure";
  }
  return "unknown";
}
inline const char* cudaGetErrorString(cudaError_t e) {
  return cudaGetErrorName(e);
}
struct cudaFuncAttributes {};
template <class... P>
cudaError_t cudaFuncGetAttributes(cudaFuncAttributes*, void (*)(P...)) {
  return emulator::faults.code;
}
template <class... P>
cudaError_t cudaFuncSetAttribute(void (*)(P...), int, int) {
  return cudaSuccess;
}
template <class... P>
cudaError_t cudaOccupancyMaxActiveBlocksPerMultiprocessor(int* n, void (*)(P...), int, std::size_t) {
  *n = 2;
  return cudaSuccess;
}
template <class... P, class... A>
cudaError_t cudaLaunchKernelEx(const cudaLaunchConfig_t* c, void (*kernel)(P...), A&&... args) {
  if (emulator::faults.launch != cudaSuccess) return emulator::faults.launch;
  std::tuple<P...> values(std::forward<A>(args)...);
  emulator::run(c->gridDim, c->blockDim, c->dynamicSmemBytes, [&] { std::apply(kernel, values); });
  return cudaSuccess;
}
