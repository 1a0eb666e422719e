#pragma once
#include <cstdint>
#include <optional>

#include "lib/grid/scale_field.h"

/// The target of a level of detail, and the scale and the voxels that follow from it.
namespace bp {

/// The target of a level. If it has no scale, the scale is chosen. For faces it is a quarter of the edge that `faces`
/// equilateral triangles over the scene's surface would have; smaller scales are tried first, from an eighth of it on
/// (a half for a fit). For an error, it is a quarter of the error.
struct LodTarget {
  std::uint64_t faces = 0;            ///< budget of faces; 0: none
  double error_world = 0;             ///< largest distance of a point of the level to the scene, scene units; 0: none
  std::optional<double> scale_world;  ///< closing radius to begin with, scene units; at least the chain's least scale
  bool keep_voxels = false;           ///< the voxels are not doubled for this level, since the user named their size
};

/// Triangles of the dense surface for each face of a finest level or of a tile. With fewer, it shows the steps of
/// voxels.
constexpr std::uint64_t kDensePerFace = 100;
constexpr std::uint64_t kFacesOfTetrahedron = 4;  ///< no closed surface has fewer for each part and handle
/// A budget never doubles the voxels, nor chooses larger ones, below this many triangles of the dense surface. Meshing
/// so many takes one or two seconds, and larger voxels would add more error and volume than the budget does.
constexpr double kLeastDenseFaces = 500000;
/// Voxels in a length that is asked for: the target's error, which holds the voxels' diagonal, the closing and the
/// simplification; or the length of a rule by shape, which is measured to within two voxels.
constexpr double kVoxelsPerLength = 8;
/// Scales in the target's error, of which the cube's dilation reaches sqrt(3), or in the edge of its faces.
constexpr double kScalesPerLength = 4;
/// The least scale that a budget chooses, before smaller scales are tried. Closing below one voxel changes nothing.
constexpr double kLeastScaleVox = 1 + kBeyondWholeVox;

/// The facts about a scene that decide at which scale and on which voxels a level is tried first.
struct LodGround {
  double voxel = 0, diagonal = 0;     ///< edge of a voxel of the solid, and diagonal of the scene; scene units
  std::uint64_t dense_faces = 0;      ///< triangles of the dense surface of the solid
  std::int64_t longest_side_vox = 0;  ///< longest side of the solid, in voxels
};

/// Returns the scale that follows from the target's budget or error, scene units, and at least `least`.
[[nodiscard]] double first_scale(const LodGround& ground, const LodTarget& target, double least);
/// Returns how often the voxels are doubled: while the target leaves enough of them, and the scale is at least a voxel.
/// The result is at least `before`, the number at a smaller scale of the same level.
[[nodiscard]] int reductions_for(const LodGround& ground, const LodTarget& target, double scale, int before);
/// Returns the finest scale that occurs in a level of `scale`, so that its voxels must be fine enough for it. `field`:
/// as in LodOptions.
[[nodiscard]] double finest_scale(const std::optional<ScalePlan>& field, double scale);

}  // namespace bp
