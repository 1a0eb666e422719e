#pragma once
#include <memory>

#include "lib/store/result_store.h"
#include "tools/lod/build_options.h"

/// The folder of --cache.
namespace bp {

/// Null without --cache. A cache may be read-only, or its disk full: then `fault` says why, later. A run of --tiles
/// must be able to fill it.
[[nodiscard]] std::unique_ptr<ResultStore> open_kept_results(const BuildOptions& options, std::string& fault);

/// What is there; nothing is added. The folder need not be there.
[[nodiscard]] std::unique_ptr<ResultStore> look_up_kept_results(const std::string& path);

/// Whether there is a cache that this build has filled before.
[[nodiscard]] bool has_own_results(const BuildOptions& options);

/// The note for a cache filled only by other builds; empty if none is needed.
[[nodiscard]] std::string cache_note(const BuildOptions& options);

}  // namespace bp
