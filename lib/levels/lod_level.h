#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/closing/closing.h"
#include "lib/grid/scale_field.h"
#include "lib/pass/context.h"
#include "lib/pass/mesh/mesh_pass.h"

/// A level of detail, what it is asked to be, and what a chain of levels is made by (lod_chain.h).
namespace bp {

/// What a level is asked to be. With no scale, faces decide it: a quarter of the edge that `faces` equilateral
/// triangles over the scene's surface would have, or half of that where the closing leaves few parts and holes
/// then, twice as many for a fit; and an error: a quarter of it.
struct LodTarget {
  std::uint64_t faces = 0;            ///< 0: none
  double error_world = 0;             ///< largest distance of a point of the level to the scene, scene units; 0: none
  std::optional<double> scale_world;  ///< closing radius to begin with, scene units; at least the chain's least scale
  bool keep_voxels = false;           ///< they are not doubled for this level: somebody named them
};

/// Triangles of the dense surface below which voxels are not doubled, nor chosen, for a budget: they take a second or
/// two, and larger voxels cost more error and volume than the budget does.
constexpr double kLeastDenseFaces = 500000;
constexpr double kVoxelsPerError = 8;  ///< the error holds the voxels' diagonal, the closing and the simplification
constexpr double kScalesPerError = 4;  ///< the cube's dilation reaches sqrt(3) scales
/// That a budget leads to, before smaller scales are tried; below 1, closing is the identity.
constexpr double kLeastScaleVox = 1 + kBeyondWholeVox;

/// What decides at which scale, and on which voxels, a level is tried first.
struct LodGround {
  double voxel = 0, diagonal = 0;     ///< of the solid; scene units
  std::uint64_t dense_faces = 0;      ///< triangles of the dense surface of the solid
  std::int64_t longest_side_vox = 0;  ///< of the solid
};

/// Returns the scale of the target's own budget or error, scene units, and at least `least`.
[[nodiscard]] double first_scale(const LodGround& ground, const LodTarget& target, double least);
/// Returns how often the voxels are doubled: while the target leaves enough of them, and the scale is not below one. At
/// least `before` times: the number at a smaller scale of the same level.
[[nodiscard]] int reductions_for(const LodGround& ground, const LodTarget& target, double scale, int before);
/// The finest scale that the voxels of a level of `scale` have to tell; `field`: as in LodOptions.
[[nodiscard]] double finest_scale(const std::optional<ScalePlan>& field, double scale);

/// Bytes of each triangle of the scene that a fit follows: twice, and a hierarchy over them.
constexpr std::uint64_t kBytesOfFit = 400;

struct LodOptions {
  ClosingParams closing;
  MeshMode mode = MeshMode::bounding;  ///< bounding or fit
  Enclose enclose = Enclose::input;    ///< of bounding levels
  /// The scene's triangles, scene units: of Enclose::scene, and those that fits follow; without, these follow the
  /// closing.
  std::vector<TriangleD> scene;
  Rounding rounding;  ///< of the scene's triangles
  /// The scene is known to lie within the solid, which was reduced from finer voxels. These told so: in larger voxels a
  /// corner may lie so near to a side, as these are rounded, that the voxel beyond it would have been set.
  bool is_within = false;
  /// Voxels of the solid that hold a point of what the scene shows to the outside; null: those of its boundary.
  std::shared_ptr<const BrickShelf> surface;
  double least_scale_world = 0;  ///< no level is closed at less
  /// Where a level's scale is finer or coarser: times the level's scale over the base, which is above 0. Rules by shape
  /// are measured on the level's voxels, and keep their lengths. None: nowhere.
  std::optional<ScalePlan> field;
  /// The level that will be made first: a refusal for memory names a limit at which it fits, too.
  std::optional<LodTarget> first;
  std::optional<CageParams> cage;  ///< levels are cages of quads around the voxels as they are, of faces alone
  /// The memory is for tiles at work and, between them, for surfaces. The scene's outer surface and `scene` are
  /// subtracted from both.
  PassContext context;
};

/// A mesh that was proposed for a level.
struct TriedWay {
  /// box, prism, hull; surface: from the scene's own; finer: from the finest level, halfway; closing; least
  /// volume; cage
  std::string way;
  double scale_world = 0;  ///< of its closing
  std::uint64_t faces = 0;
  double volume = 0;       ///< scene units cubed
  double error_world = 0;  ///< NaN: so large that it was not measured to the end
};

struct LodLevel {
  LatticeMesh mesh;        ///< in the frame of its voxels
  double scale_world = 0;  ///< that it was closed at; 0: nothing was, as for boxes, hulls and the scene's own surface
  int reductions = 0;      ///< the voxels are 2^reductions times those of the solid
  int attempts = 0;        ///< scales, from the first one on, at which parts and holes left too many faces; and one
  bool reached = true;     ///< it has at most the faces asked for
  /// Upper bound of the distances that a viewer can see, scene units: from a point of the level to the outer surface of
  /// the scene, and from a point of that surface which lies outside the level (only of fits) to the level. Around
  /// triangles (Enclose::scene) the bound is too large by a 16th of a voxel of the solid or 0.1 % at most, of a fit to
  /// triangles as a rule by a voxel, else by three voxels and 4 %.
  double error_world = 0;
  double price = 0;  ///< by which it was chosen (detail/best_level.h); levels of a chain compare
  MeshCounts counts;
  std::vector<TriedWay> tried;  ///< in this order; the level is one of them
};

/// What a level holds, scene units cubed.
[[nodiscard]] inline double volume_of(const LodLevel& level) {
  return level.counts.levels.front().measures.volume;
}

/// Returns the limit on memory at which options.first fits, with all steps before it, if the scene has so many
/// triangles, which need not be in `options`. 0: not known. `solid` holds the bricks of `header`; `context` has all of
/// the memory. Asked for after a refusal; takes the memory of some bricks.
[[nodiscard]] std::uint64_t chain_limit(const StreamHeader& header, BrickShelf& solid, const LodOptions& options,
                                        const PassContext& context, std::uint64_t triangles);

}  // namespace bp
