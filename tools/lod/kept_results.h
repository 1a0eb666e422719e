#pragma once
#include <memory>

#include "lib/store/result_store.h"
#include "tools/lod/build_options.h"

/// The folder of --cache.
namespace bp {

/// Null if `path` is empty. A cache that others fill may be read-only: then `read_only` says why, later. To fill it, or
/// to resume, it must take what is put.
[[nodiscard]] std::unique_ptr<ResultStore> open_kept_results(const BuildOptions& options, const std::string& path,
                                                             std::string& read_only);

/// What is there; nothing is added. The folder need not be there.
[[nodiscard]] std::unique_ptr<ResultStore> look_up_kept_results(const std::string& path);

/// What is said of a --cache that only other builds of the program have filled: its results are of no use; else empty.
[[nodiscard]] std::string cache_note(const BuildOptions& options);

}  // namespace bp
