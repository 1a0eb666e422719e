#include "lib/quads/limb_cage.h"

#include "lib/quads/quad_cage.h"

namespace bp {

namespace {

/// A cage of small cubes: the edge of a cube in units (cell_quads.h), and how it is thinned out.
struct FineCage {
  std::int32_t units;
  Thinning thinning;
};
// The first keeps loops of edges. The second has smaller cubes, which hold narrower gaps, and takes longer.
constexpr FineCage kFineCages[] = {{2, Thinning::strips}, {1, Thinning::singles}};

}  // namespace

LatticeMesh cage_with_limbs(const BrickShelf& voxels, const GridFrame& frame, const Enclosed& enclosed,
                            std::uint64_t faces, const std::optional<MirrorPlane>& plane, const Limbs& model,
                            CageFit& fit, const ThinningSteps& steps) {
  LatticeMesh best;
  const auto propose = [&](const CellQuads& quads) {
    if (quads.mesh.triangles.empty()) return;
    LatticeMesh cage = shrunk_cage(quads, enclosed, plane);
    CageFit fit_of_cage = model.fit(cage);
    if (!best.triangles.empty() && !fit_of_cage.is_better_than(fit)) return;
    best = std::move(cage);
    fit = std::move(fit_of_cage);
  };
  propose(cell_quads(voxels, frame, faces, plane));
  if (best.triangles.empty()) return {};
  for (const FineCage& fine : kFineCages) {
    if (fit.joined.empty()) break;
    const Thinned thin =
        thinned(cube_quads(voxels, frame, fine.units, plane), enclosed, faces, plane, fine.thinning, steps);
    if (thin.is_hopeless) break;
    propose(thin.cage);
  }
  return best;
}

}  // namespace bp
