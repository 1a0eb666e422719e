#include "tools/run/scene_budget.h"

#include "tools/run/memory_shares.h"

namespace bp {

MemoryShare document_budget(std::uint64_t memory, std::uint64_t program, std::size_t scenes, bool again) {
  constexpr std::uint64_t kBeside = 5;
  const UsableMemory usable(memory, program);
  const std::uint64_t parts = scenes > 1 ? kBeside : 1;
  return {usable.bytes / parts, 1.0 / double(parts), usable.limit, again ? 1.0 / double(kBeside) : 0};
}

}  // namespace bp
