#include "tools/mesh/mesh_memory.h"

#include "io/store/chunk_store.h"
#include "tools/run/memory_shares.h"

namespace bp {

PieceMemory mesh_memory(const CommonOptions& common) {
  const MeshBudget budget(common.memory_bytes);
  PieceMemory memory;
  memory.waiting_bytes = budget.waiting;
  memory.work_bytes = budget.work;
  memory.limit_bytes = common.memory_bytes;
  memory.waiting_growth = budget.waiting_growth;
  memory.work_growth = budget.work_growth;
  memory.make_store = [store = budget.store, temp = common.temp] { return make_chunk_store(store, temp); };
  return memory;
}

}  // namespace bp
