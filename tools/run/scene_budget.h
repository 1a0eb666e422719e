#pragma once
#include "lib/core/memory_share.h"

namespace bp {

/// Returns the part of --memory that the description of a scene may take while nothing else takes memory: all that the
/// program and its threads leave. `program`: as in UsableMemory. With several scenes, one is opened while the triangles
/// of others wait: a fifth. `again`: the scene is opened once more while other parts of it are in memory: also a fifth.
[[nodiscard]] MemoryShare document_budget(std::uint64_t memory, std::uint64_t program, std::size_t scenes,
                                          bool again = false);

}  // namespace bp
