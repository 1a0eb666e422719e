#pragma once
#include <functional>

#include "lib/enclosed/enclosed.h"
#include "lib/quads/cell_quads.h"

/// Cages that keep limbs apart: quads are removed where they are needed least, and limbs stay as they are.
namespace bp {

enum class Thinning {
  strips,  ///< removes strips, and single quads only where no strip can be removed: regular
  singles  ///< removes strips and single quads as they come: reaches fewer quads where many thin limbs cross the axes
};

/// Receives how many of the quads are gone, and how many shall go. It may be empty, and may throw.
using ThinningSteps = std::function<void(std::uint64_t done, std::uint64_t total)>;

struct Thinned {
  CellQuads cage;            ///< no triangles: too few quads can be removed
  bool is_hopeless = false;  ///< holes and parts keep far too many quads, in a mesh of smaller cubes all the more
};

/// Removes strips of quads (detail/strips.h) from `cage` until it has at most `faces` triangles, and evens it out in
/// between. Each step is checked exactly, so the result is closed, 2-manifold and embedded, holds `enclosed` under
/// either diagonal of each quad, and has the parts and holes that `cage` has. With a plane it is its own mirror image.
/// Deterministic. Throws Cancelled if the caller's work is to stop. Cost: the sweeps of a few meshes as large as
/// `cage`, and some exact steps for each quad.
[[nodiscard]] Thinned thinned(CellQuads cage, const Enclosed& enclosed, std::uint64_t faces,
                              const std::optional<MirrorPlane>& plane, Thinning thinning,
                              const ThinningSteps& steps = {});

}  // namespace bp
