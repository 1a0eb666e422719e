#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "lib/store/scratch.h"

namespace bp {

/// Returns a store for chunks that are compressed with zstd, in memory while they fit in `memory_bytes`, then in a
/// scratch file in `temp_dir`, which is made when it is first needed. Dropped chunks free their memory; the scratch
/// file only grows. The index counts, about 100 bytes a chunk, but is never refused: 1 MiB for 10 GiB in chunks of 1
/// MiB. put() takes about 2 ms a MiB of triangles, get() 1 ms.
[[nodiscard]] std::unique_ptr<Scratch> make_scratch(std::uint64_t memory_bytes, const std::string& temp_dir);

}  // namespace bp
