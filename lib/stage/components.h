#pragma once
#include <cstdint>

#include "lib/meshing/lattice_mesh.h"

namespace bp {

/// A proxy inside a solid shrinks; a part of it may, in theory, pass through itself and come out inside out, outside of
/// what it was in. Takes away the closed components that face inwards and that no other surrounds, decided exactly;
/// cavities stay. Returns the number of triangles taken away.
std::uint64_t drop_inverted_components(LatticeMesh& mesh);

}  // namespace bp
