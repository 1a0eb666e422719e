#include "tools/check/check_budget.h"

#include <algorithm>

#include "lib/core/error.h"
#include "tools/run/memory_shares.h"
#include "tools/run/scene_budget.h"

namespace bp {

namespace {

// Measured on a torus (half a vertex a triangle) and a heap of triangles (three): 393 and 55 bytes. They are the mesh,
// its welded copy, and the hierarchy with the data it is built from. Tables of edges and corners come and go before it.
constexpr std::uint64_t kBytesPerFace = 400, kBytesPerVertex = 64;
// The reader of the scenes gets a third of the memory that the proxy leaves.
constexpr std::uint64_t kAllParts = 24, kReaderParts = kAllParts / 3;

/// Returns the limit that has room for `held` bytes and for a step that gets one of `parts` of the rest. `named` is the
/// limit that the failed step gave, as if it had all memory for itself.
std::uint64_t limit_beside(const MemoryLimit& now, std::uint64_t held, std::uint64_t named, std::uint64_t parts) {
  const std::uint64_t rest = now.rest_bytes(), then = MemoryLimit{named, now.fixed_bytes}.rest_bytes();
  const std::uint64_t needed = held + parts * (then - std::min(then, rest));
  return now.with(needed - std::min(needed, rest), 1);
}

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

std::uint64_t CheckBudget::parts_of_document() const {
  return scenes_ > 1 ? 3 : 1;  // the reader's third, or everything
}

void CheckBudget::refuse_proxy(const NeedsMemory& e, const std::vector<std::string>& scenes,
                               const SceneOptions& options) const {
  const MemoryLimit limit = UsableMemory(memory_, kMeshProgram).limit;
  std::uint64_t least = e.memory_bytes();
  for (const std::string& scene : scenes) {
    SceneOptions nothing = options;  // the file is to be refused before any memory is taken
    nothing.memory_bytes = kReaderParts;
    nothing.document = {kAllParts / parts_of_document(), 1, limit};  // in addition to the reader, as it will be
    try {
      if (scene != "-") (void)open_scene(scene, nothing);
    } catch (const Error& more) {  // an error of another kind is reported once the proxy fits
      if (more.memory_bytes() > 0)
        least = std::max(least, limit_beside(limit, e.needed_bytes(), more.memory_bytes(), parts_of_document()));
    }
  }
  throw Error(e.code(), e.what(), e.remedies(), least);
}

MemoryShare CheckBudget::of_scene_document() const {
  const std::uint64_t parts = parts_of_document();
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
