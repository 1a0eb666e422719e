#include "lib/quads/limb_cage.h"

#include "lib/quads/quad_cage.h"
#include "lib/quads/thin_quads.h"

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
                            std::vector<LatticeCoord>& joined) {
  const CellQuads boxes = cell_quads(voxels, frame, faces, plane);
  if (boxes.mesh.triangles.empty()) return {};
  LatticeMesh best = shrunk_cage(boxes, enclosed, plane);
  joined = model.joined(best);
  for (const FineCage& fine : kFineCages) {
    if (joined.empty()) break;
    const CellQuads thin = thinned(cube_quads(voxels, frame, fine.units, plane), enclosed, faces, plane, fine.thinning);
    if (thin.mesh.triangles.empty()) continue;
    LatticeMesh cage = shrunk_cage(thin, enclosed, plane);
    std::vector<LatticeCoord> still_joined = model.joined(cage);
    if (still_joined.size() >= joined.size()) continue;
    best = std::move(cage);
    joined = std::move(still_joined);
  }
  return best;
}

}  // namespace bp
