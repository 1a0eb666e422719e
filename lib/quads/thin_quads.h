#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/quads/cell_quads.h"

/// Cages that keep limbs apart: quads are removed where they are needed least, and limbs stay as they are.
namespace bp {

enum class Thinning {
  strips,  ///< removes strips, and single quads only where no strip can be removed: regular
  singles  ///< removes strips and single quads as they come: reaches fewer quads where many thin limbs cross the axes
};

/// Removes strips of quads (detail/strips.h) from `cage` until it has at most `faces` triangles, and evens it out in
/// between. Each step is checked exactly, so the result is closed, 2-manifold and embedded, holds `enclosed` under
/// either diagonal of each quad, and has the parts and holes that `cage` has. With a plane it is its own mirror image.
/// Returns no triangles if too few can be removed. Deterministic. Cost: some exact steps for each quad.
[[nodiscard]] CellQuads thinned(CellQuads cage, const Enclosed& enclosed, std::uint64_t faces,
                                const std::optional<MirrorPlane>& plane, Thinning thinning);

}  // namespace bp
