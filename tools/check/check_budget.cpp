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
// Of what the proxy leaves, the reader of the scenes has a third.
constexpr std::uint64_t kAllParts = 24, kReaderParts = kAllParts / 3;

/// The limit that has room for `held` bytes and, in one of `parts` of the rest, for what a step named that had none of
/// it: `named` is the limit that would do if nothing else were there.
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
  return scenes_ > 1 ? 3 : 1;  // the reader's third, or all
}

void CheckBudget::refuse_proxy(const NeedsMemory& e, const std::vector<std::string>& scenes,
                               const SceneOptions& options) const {
  const MemoryLimit limit = UsableMemory(memory_, kMeshProgram).limit;
  std::uint64_t least = e.memory_bytes();
  for (const std::string& scene : scenes) {
    SceneOptions nothing = options;  // so that it is refused before it takes anything
    nothing.memory_bytes = kReaderParts;
    nothing.document = {kAllParts / parts_of_document(), 1, limit};  // beside the reader as it will be
    try {
      if (scene != "-") (void)open_scene(scene, nothing);
    } catch (const Error& more) {  // of another kind: is told once the proxy fits
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
