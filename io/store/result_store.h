#pragma once
#include <functional>
#include <memory>
#include <string>

#include "lib/store/result_store.h"

namespace bp {

/// Opens results as files of a folder, DIR/ab/cdef..., named by their keys. The folder is made if it does not exist;
/// any number of processes may share it, on one machine or many. A file holds a magic number, the key, the size, an
/// XXH3-128 checksum and the bytes as one zstd frame; it has no name before it is complete. A file that is damaged,
/// truncated, or foreign is ignored by get() and replaced by put(). Throws `failed` if the folder cannot be made,
/// out_of_resource if it is full.
///   on_failure  called once, by put() on any thread, with the reason if a result cannot be written there; later
///               results are not kept. Without it put() throws.
[[nodiscard]] std::unique_ptr<ResultStore> open_result_store(
    const std::string& folder, std::function<void(const std::string& why)> on_failure = {});

}  // namespace bp
