#include "lib/pass/mesh/detail/coarse_start.h"

#include "lib/surface/repair.h"
#include "lib/volume/reduce.h"

namespace bp {

namespace {

constexpr double kVoxelsPerScale = 2;  // a ball of radius S holds the voxel around its middle: at least root 3

}  // namespace

CoarseStart coarse_start(const BrickShelf& meshed, const StreamHeader& header, std::uint64_t dense_faces,
                         const ShelfFactory& make_shelf) {
  CoarseStart start;
  GridFrame frame = header.frame;
  const double most = header.has_closing && header.scale.constant() ? header.scale.base / kVoxelsPerScale : 0;
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
  return start;
}

}  // namespace bp
