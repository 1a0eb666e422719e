#include "tools/check/check_budget.h"

#include <algorithm>

#include "lib/core/error.h"
#include "tools/run/memory_shares.h"
#include "tools/run/scene_budget.h"

namespace bp {

namespace {

constexpr std::uint64_t kProgram = std::uint64_t(48) << 20;
// Measured on a torus (half a vertex a triangle) and a heap of triangles (three): 393 and 55 bytes. The mesh, its
// welded copy, and the hierarchy and what it is built from; tables of edges and corners come and go before it.
constexpr std::uint64_t kBytesPerFace = 400, kBytesPerVertex = 64;

}  // namespace

CheckBudget::CheckBudget(std::uint64_t memory, bool has_scene)
    : memory_(memory), usable_(UsableMemory(memory, kProgram).bytes), share_(has_scene ? 3 : 4) {}

SceneOptions CheckBudget::of_proxy() const {
  SceneOptions options;
  options.keep_extremes = true;
  options.memory_bytes = usable_ / 8;
  options.document = document_budget(memory_, kProgram, 1);
  const MemoryLimit limit = UsableMemory(memory_, kProgram).limit;
  options.mesh = {{usable_ / 4 * share_, double(share_) / 4, limit}, kBytesPerFace, kBytesPerVertex, "checking"};
  return options;
}

void CheckBudget::take(const std::vector<IndexedMesh>& proxy) {
  for (const IndexedMesh& level : proxy)
    usable_ -= std::min(usable_, level.triangles.size() * kBytesPerFace + level.vertices.size() * kBytesPerVertex);
}

}  // namespace bp
