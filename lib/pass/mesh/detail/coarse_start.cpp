#include "lib/pass/mesh/detail/coarse_start.h"

#include <algorithm>
#include <cmath>

#include "lib/surface/repair.h"
#include "lib/volume/reduce.h"

namespace bp {

namespace {

/// Returns the largest edge of coarse voxels, scene units; 0: none. A ball of radius S, or a cube, holds every voxel of
/// that edge whose middle it holds. For cubes an edge of S would suffice, but the proxy would have no room for
/// tightening then.
double largest_voxel(const StreamHeader& header) {
  constexpr double kPerCube = 1.25;
  if (!header.has_closing || !header.scale.constant()) return 0;
  const bool straight = header.element == StructuringElement::cube && header.orientation.empty();
  return header.scale.base / (straight ? kPerCube : std::sqrt(3.0));
}

}  // namespace

CoarseStart coarse_start(const BrickShelf& meshed, const StreamHeader& header, std::uint64_t dense_faces,
                         const ShelfFactory& make_shelf) {
  CoarseStart start;
  GridFrame frame = header.frame;
  const double most = largest_voxel(header);
  while (2 * frame.voxel <= most) {
    auto coarse = make_shelf();
    reduce(start.voxels ? *start.voxels : meshed, frame, *coarse);
    repair_contacts(*coarse);
    const GridFrame larger = reduced(frame);
    if (count_faces(ShelfSurface(*coarse, larger)) < dense_faces) break;
    frame = larger;
    start.voxels = std::move(coarse);
  }
  if (start.voxels) start.surface = std::make_unique<ShelfSurface>(*start.voxels, frame);
  start.voxel = frame.voxel;
  return start;
}

bool CoarseStarts::has_flat_sides(std::uint64_t faces) const {
  constexpr std::uint64_t kFewPerFace = 16;
  return header.scene.triangles > 0 && header.scene.triangles <= kFewPerFace * faces;
}

CoarseStart CoarseStarts::first(std::uint64_t faces) const {
  constexpr std::uint64_t kDenseOfFlat = 200000;
  const std::uint64_t dense = kCoarseDensePerFace * faces;
  return coarse_start(meshed, header, has_flat_sides(faces) ? std::max(dense, kDenseOfFlat) : dense, make_shelf);
}

}  // namespace bp
