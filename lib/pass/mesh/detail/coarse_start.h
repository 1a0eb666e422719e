#pragma once
#include <memory>

#include "lib/grid/stream.h"
#include "lib/surface/surface.h"

namespace bp {

/// A surface around voxels that are larger than those of the stream.
struct CoarseStart {
  std::unique_ptr<BrickShelf> voxels;
  std::unique_ptr<SurfaceSource> surface;  ///< null: the stream's voxels are large enough
  double voxel = 0;                        ///< edge, scene units
};

/// Dense faces for each face of a proxy: with more the proxy is as tight, but slower.
constexpr std::uint64_t kCoarseDensePerFace = 40;

/// Makes a coarse surface that replaces the surface of `meshed`. It has a quarter of the dense faces or less, but at
/// least `dense_faces`. Tightening removes the volume that it adds. The coarse voxels close no gap except a neck
/// between two balls: outside of a closing every point lies in a ball of radius S (or a cube) that is outside, and it
/// holds every voxel of edge S / root 3 (or S) in which its middle lies. Cost: reading the voxels.
[[nodiscard]] CoarseStart coarse_start(const BrickShelf& meshed, const StreamHeader& header, std::uint64_t dense_faces,
                                       const ShelfFactory& make_shelf);

/// Makes the starts of a proxy of `faces` triangles. All members must outlive it.
struct CoarseStarts {
  const BrickShelf& meshed;
  const StreamHeader& header;
  const ShelfFactory& make_shelf;

  /// Returns whether the scene has few triangles compared with `faces`: such a scene usually has flat sides.
  [[nodiscard]] bool has_flat_sides(std::uint64_t faces) const;
  /// Returns a coarse start. For flat sides it has at least 200,000 dense faces, since tightening cannot remove all
  /// steps of larger voxels there.
  [[nodiscard]] CoarseStart first(std::uint64_t faces) const;
};

}  // namespace bp
