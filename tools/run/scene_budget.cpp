#include "tools/run/scene_budget.h"

#include <fmt/format.h>

#include "tools/run/memory_shares.h"

namespace bp {

DocumentBudget document_budget(std::uint64_t memory, std::uint64_t program, std::size_t scenes) {
  const UsableMemory usable(memory, program);
  const std::uint64_t share = scenes > 1 ? 5 : 1;
  DocumentBudget budget;
  budget.bytes = usable.bytes / share;
  budget.enough_for = [=](std::uint64_t missing) {
    const std::uint64_t needed = usable.bytes + missing * share;
    return fmt::format(" to at least {} MiB", ((needed > usable.fixed ? needed + usable.fixed : 2 * needed) >> 20) + 1);
  };
  return budget;
}

}  // namespace bp
