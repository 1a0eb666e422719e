#include "tools/run/scene_budget.h"

#include "tools/run/memory_shares.h"

namespace bp {

MemoryShare document_budget(std::uint64_t memory, std::uint64_t program, std::size_t scenes) {
  const UsableMemory usable(memory, program);
  const std::uint64_t parts = scenes > 1 ? 5 : 1;
  return {usable.bytes / parts, 1.0 / double(parts), usable.limit};
}

}  // namespace bp
