#pragma once
#include <string>

#include "io/files/file.h"
#include "samples/plant/site.h"

/// Writers that generate the site as they go: memory does not depend on its size.
namespace plant {

/// Binary little-endian PLY, every instance expanded, indices of 32 bits. Throws bp::Error (bad_argument) beyond 2^32
/// vertices.
void write_ply(const Site& site, bp::OutputFile& file);
/// The same site a day later: component number `changed`, in the order of the file, stands two metres higher.
/// Throws bp::Error (bad_argument) if there is none.
void write_changed_ply(const Site& site, std::uint64_t changed, bp::OutputFile& file);

/// GLB: each shape is a mesh once, placements are nodes (translation, or a matrix if turned or mirrored). Throws
/// bp::Error (bad_argument) beyond 4 GiB.
void write_glb(const Site& site, bp::OutputFile& file);

}  // namespace plant
