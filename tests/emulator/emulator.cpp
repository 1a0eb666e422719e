// Fibers for the emulated CUDA device: one per thread of the running block, switched by hand at collectives.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "tests/emulator/cuda_runtime.h"

dim3 threadIdx, blockIdx, blockDim, gridDim;

#if defined(__x86_64__)
// Saves the callee's registers on the running stack and continues on another: swapcontext without its system calls.
extern "C" void emulator_switch(void** from, void* to);
asm(R"(
.text
.globl emulator_switch
emulator_switch:
  pushq %rbp
  pushq %rbx
  pushq %r12
  pushq %r13
  pushq %r14
  pushq %r15
  movq %rsp, (%rdi)
  movq %rsi, %rsp
  popq %r15
  popq %r14
  popq %r13
  popq %r12
  popq %rbx
  popq %rbp
  ret
)");
#else
#include <ucontext.h>
#endif

namespace emulator {
namespace {

#if defined(__x86_64__)
/// A stack of its own, and where it stopped.
class Context {
 public:
  void prepare(char* stack, std::size_t bytes, void (*entry)()) {
    const std::uintptr_t end = (reinterpret_cast<std::uintptr_t>(stack) + bytes) / 16 * 16;
    void** top = reinterpret_cast<void**>(end);
    *--top = nullptr;                         // where entry would return to: it never does
    *--top = reinterpret_cast<void*>(entry);  // popped by ret; leaves the stack as a call would
    for (int i = 0; i < 6; ++i) *--top = nullptr;
    at_ = top;
  }
  void switch_to(Context& next) { emulator_switch(&at_, next.at_); }

 private:
  void* at_ = nullptr;
};
#else
class Context {
 public:
  void prepare(char* stack, std::size_t bytes, void (*entry)()) {
    getcontext(&at_);
    at_.uc_stack.ss_sp = stack;
    at_.uc_stack.ss_size = bytes;
    at_.uc_link = nullptr;
    makecontext(&at_, entry, 0);
  }
  void switch_to(Context& next) { swapcontext(&at_, &next.at_); }

 private:
  ucontext_t at_;
};
#endif

constexpr std::size_t kStackBytes = 64 * 1024;

struct Warp {
  std::uint64_t value[32], result[32];
  unsigned arrived = 0, result_lanes = 0, finished = 0, mask = 0;
  unsigned long generation = 0;
};

struct Fiber {
  Context context;
  std::unique_ptr<char[]> stack{new char[kStackBytes]};
  dim3 index;
  bool done = false;
};

struct Device {
  std::vector<std::unique_ptr<Fiber>> fibers;
  std::vector<Warp> warps;
  std::vector<unsigned> order;
  std::vector<std::uint64_t> shared;
  Context scheduler;
  const std::function<void()>* thread = nullptr;
  unsigned current = 0, live = 0, at_barrier = 0, votes = 0, vote_result = 0;
  unsigned long barrier_generation = 0, progress = 0;
  unsigned order_seed = 0;
  std::size_t limit = std::size_t(-1), used = 0;
  std::unordered_map<void*, std::size_t> sizes;
};
Device g;
std::mutex mutex;  // several threads of the host may use the device, one at a time

[[noreturn]] void die(const char* what) {
  std::fprintf(stderr, "emulated device: %s (block %u, thread %u)\n", what, blockIdx.x, g.current);
  std::abort();
}

void give_way() {
  g.fibers[g.current]->context.switch_to(g.scheduler);
}

void finish_collective(Warp& w) {
  std::copy(w.value, w.value + 32, w.result);
  w.result_lanes = w.arrived;
  w.arrived = 0;
  ++w.generation;
  ++g.progress;
}

void release_barrier() {
  g.at_barrier = 0;
  g.vote_result = g.votes;
  g.votes = 0;
  ++g.barrier_generation;
  ++g.progress;
}

void fiber_main() {
  (*g.thread)();
  Fiber& f = *g.fibers[g.current];
  f.done = true;
  --g.live;
  ++g.progress;
  Warp& w = g.warps[g.current / 32];
  w.finished |= 1u << (g.current & 31);
  if (w.arrived && (w.arrived | w.finished) == w.mask) die("a lane ended while others wait for it in a collective");
  if (g.at_barrier && g.at_barrier == g.live) release_barrier();
  give_way();
}

void run_block() {
  const unsigned n = unsigned(g.order.size());
  g.live = n;
  g.at_barrier = 0;
  for (Warp& w : g.warps) w = Warp{};
  for (unsigned i = 0; i < n; ++i) {
    Fiber& f = *g.fibers[i];
    f.done = false;
    f.context.prepare(f.stack.get(), kStackBytes, fiber_main);
  }
  while (g.live > 0) {
    const unsigned long before = g.progress;
    for (const unsigned i : g.order) {
      if (g.fibers[i]->done) continue;
      g.current = i;
      threadIdx = g.fibers[i]->index;
      g.scheduler.switch_to(g.fibers[i]->context);
    }
    if (g.progress == before && g.live > 0)
      die("threads wait for each other: a barrier or collective is not reached by all");
  }
}

}  // namespace

unsigned exchange(unsigned mask, std::uint64_t value, std::uint64_t* all) {
  Warp& w = g.warps[g.current / 32];
  const unsigned lane = g.current & 31;
  if (!(mask >> lane & 1)) die("a lane outside the mask takes part in a collective");
  const unsigned here = unsigned(std::min<std::size_t>(32, g.order.size() - g.current / 32 * 32));
  const unsigned present = here == 32 ? 0xffffffffu : (1u << here) - 1;
  if (w.arrived && w.mask != (mask & present)) die("lanes of a warp meet in collectives with different masks");
  w.mask = mask & present;
  if (w.mask & w.finished) die("a collective waits for a lane that has ended");
  w.value[lane] = value;
  w.arrived |= 1u << lane;
  const unsigned long generation = w.generation;
  if (w.arrived == w.mask) {
    finish_collective(w);
  } else {
    while (w.generation == generation) give_way();
  }
  std::copy(w.result, w.result + 32, all);
  return w.result_lanes;
}

void barrier() {
  const unsigned long generation = g.barrier_generation;
  if (++g.at_barrier == g.live) return release_barrier();
  while (g.barrier_generation == generation) give_way();
}

unsigned barrier_count(bool vote) {
  if (vote) ++g.votes;
  barrier();
  return g.vote_result;
}

void* dynamic_shared() {
  return g.shared.data();
}

void run(dim3 grid, dim3 block, std::size_t shared_bytes, const std::function<void()>& thread) {
  const std::lock_guard lock(mutex);
  const unsigned n = block.x * block.y * block.z;
  while (g.fibers.size() < n) g.fibers.push_back(std::make_unique<Fiber>());
  g.warps.resize((n + 31) / 32);
  g.order.resize(n);
  g.thread = &thread;
  blockDim = block;
  gridDim = grid;
  for (unsigned i = 0; i < n; ++i) g.order[i] = g.order_seed == 1 ? n - 1 - i : i;
  for (unsigned i = 0; g.order_seed > 1 && i < n; ++i) {
    std::swap(g.order[i], g.order[(i * 2654435761u + g.order_seed * 40503u) % n]);
  }
  for (unsigned z = 0; z < grid.z; ++z) {
    for (unsigned y = 0; y < grid.y; ++y) {
      for (unsigned x = 0; x < grid.x; ++x) {
        g.shared.assign(shared_bytes / 8 + 2, 0xabababababababab);  // poison: nothing may rely on zeros
        for (unsigned i = 0; i < n; ++i) {
          g.fibers[i]->index = dim3(i % block.x, i / block.x % block.y, i / (block.x * block.y));
        }
        blockIdx = dim3(x, y, z);
        run_block();
      }
    }
  }
}

void set_thread_order(unsigned seed) {
  g.order_seed = seed;
}
void set_memory_limit(std::size_t bytes) {
  g.limit = bytes;
}
std::size_t memory_in_use() {
  return g.used;
}

}  // namespace emulator

using emulator::g;

cudaError_t cudaMalloc(void** p, std::size_t bytes) {
  const std::lock_guard lock(emulator::mutex);
  if (g.used + bytes > g.limit) return cudaErrorMemoryAllocation;
  *p = std::malloc(bytes);
  std::memset(*p, 0xcd, bytes);  // poison
  g.used += bytes;
  g.sizes[*p] = bytes;
  return cudaSuccess;
}
cudaError_t cudaFree(void* p) {
  const std::lock_guard lock(emulator::mutex);
  if (p) {
    g.used -= g.sizes[p];
    g.sizes.erase(p);
  }
  std::free(p);
  return cudaSuccess;
}
cudaError_t cudaMallocHost(void** p, std::size_t bytes) {
  if (emulator::faults.page_locked != cudaSuccess) return emulator::faults.page_locked;
  *p = std::malloc(bytes);
  return cudaSuccess;
}
cudaError_t cudaFreeHost(void* p) {
  std::free(p);
  return cudaSuccess;
}
cudaError_t cudaMemGetInfo(std::size_t* free, std::size_t* total) {
  *total = g.limit == std::size_t(-1) ? std::size_t(16) << 30 : g.limit;
  *free = *total - g.used;
  return cudaSuccess;
}
cudaError_t cudaGetDeviceProperties(cudaDeviceProp* p, int) {
  *p = {};
  std::strcpy(p->name, "emulated");
  p->major = 9;
  p->multiProcessorCount = 2;
  p->totalGlobalMem = std::size_t(16) << 30;
  p->l2CacheSize = 1 << 20;
  return cudaSuccess;
}
