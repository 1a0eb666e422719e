#include "tools/check/check_budget.h"

#include <algorithm>

#include "lib/core/error.h"
#include "tools/run/memory_shares.h"
#include "tools/run/scene_budget.h"

namespace bp {

namespace {

// Measured on a torus (half a vertex a triangle) and a heap of triangles (three): 393 and 55 bytes. The mesh, its
// welded copy, and the hierarchy and what it is built from; tables of edges and corners come and go before it.
constexpr std::uint64_t kBytesPerFace = 400, kBytesPerVertex = 64;

}  // namespace

CheckBudget::CheckBudget(std::uint64_t memory, std::size_t scenes)
    : memory_(memory), usable_(UsableMemory(memory, kMeshProgram).bytes), scenes_(scenes), share_(scenes > 0 ? 3 : 4) {}

SceneOptions CheckBudget::of_proxy() const {
  SceneOptions options;
  options.keep_extremes = true;
  options.memory_bytes = usable_ / 8;
  options.document = document_budget(memory_, kMeshProgram, 1);
  const MemoryLimit limit = UsableMemory(memory_, kMeshProgram).limit;
  options.mesh = {{usable_ / 4 * share_, double(share_) / 4, limit}, kBytesPerFace, kBytesPerVertex, "checking"};
  return options;
}

MemoryShare CheckBudget::of_scene_document() const {
  const std::uint64_t parts = scenes_ > 1 ? 3 : 1;  // the reader's third, or all
  return {std::max<std::uint64_t>(1, usable_ / parts), 1.0 / double(parts), UsableMemory(memory_, kMeshProgram).limit};
}

MemoryShare CheckBudget::of_scene() const {
  return {usable_ / 3 * 2, 2.0 / 3, UsableMemory(memory_, kMeshProgram).limit};
}

void CheckBudget::take(const std::vector<IndexedMesh>& proxy) {
  for (const IndexedMesh& level : proxy)
    usable_ -= std::min(usable_, level.triangles.size() * kBytesPerFace + level.vertices.size() * kBytesPerVertex);
}

}  // namespace bp
