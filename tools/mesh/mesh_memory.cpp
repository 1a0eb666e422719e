#include "tools/mesh/mesh_memory.h"

#include "io/store/scratch.h"
#include "tools/run/memory_shares.h"

namespace bp {

PieceMemory mesh_memory(const CommonOptions& common) {
  const MeshBudget budget(common.memory_bytes);
  PieceMemory memory;
  memory.waiting_bytes = budget.waiting;
  memory.work_bytes = budget.work;
  memory.limit = budget.limit;
  memory.waiting_share = MeshBudget::kWaitingShare;
  memory.work_share = MeshBudget::kWorkShare;
  memory.make_scratch = [store = budget.store, temp = common.temp] { return make_scratch(store, temp); };
  return memory;
}

}  // namespace bp
