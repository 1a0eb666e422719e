#pragma once
#include <memory>

#include "lib/store/result_store.h"
#include "tools/lod/build_options.h"

/// Opens the folder of --cache.
namespace bp {

/// Opens the cache for reading and writing; null without --cache. If the cache turns out to be read-only or its disk
/// full, `fault` gets the reason later. With --tiles that is an error instead, since such a run is only to fill it.
[[nodiscard]] std::unique_ptr<ResultStore> open_kept_results(const BuildOptions& options, std::string& fault);

/// Opens the cache for reading only. The folder need not exist.
[[nodiscard]] std::unique_ptr<ResultStore> look_up_kept_results(const std::string& path);

/// Returns whether there is a cache that this build has filled before.
[[nodiscard]] bool has_own_results(const BuildOptions& options);

/// Returns the note for a cache that only other builds have filled; empty if none is needed.
[[nodiscard]] std::string cache_note(const BuildOptions& options);

}  // namespace bp
