#pragma once
#include "io/scene/detail/ply/ply_header.h"
#include "io/scene/raw_source.h"

namespace bp {

/// Binary PLY as most programs write it: vertices of one size, then faces with one list. Blocks of faces are decoded in
/// parallel, each with the part of the vertices that it needs. If that part is large, all vertices are held as they
/// stand in the file, or read through block caches if SceneOptions::memory_bytes has no room for them. Null if the
/// header describes anything else, or promises more than the file holds: that is for the general reader.
[[nodiscard]] RawSourcePtr open_packed_ply(SceneFilePtr file, const SceneOptions& options, const PlyHeader& header);

}  // namespace bp
