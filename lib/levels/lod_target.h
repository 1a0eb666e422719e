#pragma once
#include <cstdint>
#include <optional>

#include "lib/closing/closing.h"

/// What a level of a chain (lod_chain.h) is asked to be, and the scale and the voxels that follow.
namespace bp {

/// What a level is asked to be. With no scale, faces decide it: a quarter of the edge that `faces` equilateral
/// triangles over the scene's surface would have, or half of that where the closing leaves few parts and holes
/// then, twice as many for a fit; and an error: a quarter of it.
struct LodTarget {
  std::uint64_t faces = 0;            ///< 0: none
  double error_world = 0;             ///< largest distance of a point of the level to the scene, scene units; 0: none
  std::optional<double> scale_world;  ///< closing radius to begin with, scene units; never below the level before's
  /// Of `faces`: scale and voxels are so many times finer than for equilateral triangles. Flat regions take few.
  double detail = 1;
  bool keep_voxels = false;  ///< they are not doubled for this level: somebody named them
};

/// Triangles of the dense surface below which voxels are not doubled, nor chosen, for a budget: they take a second or
/// two, and larger voxels cost more error and volume than the budget does.
constexpr double kLeastDenseFaces = 500000;
constexpr double kVoxelsPerError = 8;  ///< the error holds the voxels' diagonal, the closing and the simplification
constexpr double kScalesPerError = 4;  ///< the cube's dilation reaches sqrt(3) scales
constexpr double kLeastScaleVox = 1 + kBeyondWholeVox;  ///< that a budget leads to; below 1, closing is the identity

/// What decides at which scale, and on which voxels, a level is tried first.
struct LodGround {
  double voxel = 0, diagonal = 0;     ///< of the solid; scene units
  std::uint64_t dense_faces = 0;      ///< triangles of the dense surface of the solid
  std::int64_t longest_side_vox = 0;  ///< of the solid
};

/// The scale, scene units, before it is halved, at least `last`, that of the level before.
[[nodiscard]] double first_scale(const LodGround& ground, const LodTarget& target, double last);
/// How often the voxels are doubled: while the target leaves enough of them, and the scale is not below one. At least
/// `before` times.
[[nodiscard]] int reductions_for(const LodGround& ground, const LodTarget& target, double scale, int before);

}  // namespace bp
