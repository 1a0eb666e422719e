#pragma once
#include <memory>

#include "lib/grid/stream.h"
#include "lib/surface/surface.h"

namespace bp {

/// A surface around voxels that are some times larger than those of the stream.
struct CoarseStart {
  std::unique_ptr<BrickShelf> voxels;
  std::unique_ptr<SurfaceSource> surface;  ///< null: the stream's voxels are large enough
  double voxel = 0;                        ///< edge, scene units
};

constexpr std::uint64_t kCoarseDensePerFace =
    40;  ///< dense faces for each of a proxy: with more it is as tight, but slower

/// What grows in place of the surface of `meshed`: a quarter of the dense faces or less, but at least so many. What
/// that adds is taken back by tightening. Outside of a closing every point lies in a ball of radius S, or a cube, that
/// is outside. It holds any voxel of S / root 3, or of S, in which the ball's middle lies. So such voxels close no gap
/// but a neck between two balls. Cost: reading the voxels.
[[nodiscard]] CoarseStart coarse_start(const BrickShelf& meshed, const StreamHeader& header, std::uint64_t dense_faces,
                                       const ShelfFactory& make_shelf);

/// The starts of a proxy of `faces` triangles. All must outlive it.
struct CoarseStarts {
  const BrickShelf& meshed;
  const StreamHeader& header;
  const ShelfFactory& make_shelf;

  /// Whether the scene is known to have few triangles for so many faces: it is of flat sides, as a rule.
  [[nodiscard]] bool has_flat_sides(std::uint64_t faces) const;
  /// A coarse one; for flat sides one of at least 200,000 dense faces, since tightening does not take all of the steps
  /// of larger voxels back there.
  [[nodiscard]] CoarseStart first(std::uint64_t faces) const;
};

}  // namespace bp
