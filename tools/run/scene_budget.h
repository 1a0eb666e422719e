#pragma once
#include "lib/core/memory_share.h"

namespace bp {

/// What the description of a scene may take of --memory while nothing else does: all that the program and its threads
/// leave. `program`: as UsableMemory. Of several scenes one is opened while the triangles of others wait: a fifth.
/// again: it is opened once more, while other things of it are in memory; then it has a fifth, too.
[[nodiscard]] MemoryShare document_budget(std::uint64_t memory, std::uint64_t program, std::size_t scenes,
                                          bool again = false);

}  // namespace bp
