#pragma once
#include <cuda_runtime.h>

#include <cstddef>
#include <cstdint>

#include "gpu/kernels/cuda_check.h"
#include "gpu/kernels/tuning.h"

/// Kernel launches, and the few device idioms that all kernels share. Only .cu files and their headers include it.
namespace bp {

constexpr int kWarp = 32;
constexpr unsigned kAllLanes = 0xffffffffu;

/// Returns the number of blocks of kPassThreads for this many threads.
inline unsigned blocks_for(std::uint64_t threads) {
  return unsigned((threads + kPassThreads - 1) / kPassThreads);
}

/// Launches `kernel`. Throws Error if the launch is refused. With BP_DEBUG_SYNC=1 it waits, so that a fault names its
/// kernel.
template <class... P, class... A>
void launch(const char* name, void (*kernel)(P...), unsigned blocks, unsigned threads, std::size_t shared_bytes,
            cudaStream_t stream, A&&... args) {
  if (blocks == 0) return;
  cudaLaunchConfig_t config{};
  config.gridDim = dim3(blocks);
  config.blockDim = dim3(threads);
  config.dynamicSmemBytes = shared_bytes;
  config.stream = stream;
  check_launch(cudaLaunchKernelEx(&config, kernel, static_cast<P>(args)...), name, stream);
}

/// Returns shared memory whose size the launch gives.
__device__ inline void* dynamic_shared_memory() {
#ifdef BP_EMULATED_CUDA
  return emulator::dynamic_shared();
#else
  extern __shared__ uint4 bytes_of_the_block[];
  return bytes_of_the_block;
#endif
}

__device__ inline int lane_id() {
  return int(threadIdx.x) & (kWarp - 1);
}
__device__ inline unsigned warp_in_block() {
  return threadIdx.x / kWarp;
}
__device__ inline unsigned thread_in_grid() {
  return blockIdx.x * blockDim.x + threadIdx.x;
}

/// Returns the next item of a queue that all warps of the grid share. It is the same for every lane.
__device__ inline unsigned next_item(std::uint32_t* queue) {
  unsigned item = 0;
  if (lane_id() == 0) item = atomicAdd(queue, 1u);
  return __shfl_sync(kAllLanes, item, 0);
}

/// Returns places at the end of a list for the lanes with `wanted`, by one atomic per warp. All lanes of the warp must
/// call it.
__device__ inline unsigned place_in_list(bool wanted, std::uint32_t* count) {
  const unsigned mask = __ballot_sync(kAllLanes, wanted);
  unsigned first = 0;
  if (mask == 0) return first;
  if (lane_id() == 0) first = atomicAdd(count, unsigned(__popc(mask)));
  return __shfl_sync(kAllLanes, first, 0) + unsigned(__popc(mask & ((1u << lane_id()) - 1)));
}

/// Appends `value` of the lanes with `wanted`. All lanes of the warp must call it.
__device__ inline void append(bool wanted, std::uint32_t value, std::uint32_t* list, std::uint32_t* count) {
  const unsigned at = place_in_list(wanted, count);
  if (wanted) list[at] = value;
}

}  // namespace bp
