#pragma once
#include "io/scene/detail/ply/ply_header.h"
#include "io/scene/raw_source.h"

namespace bp {

/// Opens a binary PLY as most programs write it: vertices of one size, then faces with one list. Blocks of faces are
/// decoded in parallel, each with the part of the vertices that it needs. If that part is large, all vertices are held
/// as they are in the file, or read through block caches if SceneOptions::memory_bytes has no room for them. Returns
/// null if the header describes anything else, or promises more than the file holds: then the general reader is used.
[[nodiscard]] RawSourcePtr open_packed_ply(SceneFilePtr file, const SceneOptions& options, const PlyHeader& header);

}  // namespace bp
