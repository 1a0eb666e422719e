#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/closing/closing.h"
#include "lib/grid/scale_field.h"
#include "lib/levels/lod_target.h"
#include "lib/pass/context.h"
#include "lib/pass/mesh/mesh_params.h"

/// A level of detail, and the options of a chain of levels (lod_chain.h).
namespace bp {

/// Bytes for each triangle of the scene that a fit follows: two copies, and a hierarchy over them.
constexpr std::uint64_t kBytesOfFit = 400;

struct LodOptions {
  ClosingParams closing;
  MeshMode mode = MeshMode::bounding;  ///< bounding or fit
  Enclose enclose = Enclose::input;    ///< for bounding levels
  /// The scene's triangles, scene units. With Enclose::scene they stay inside; a fit follows them. Without them a fit
  /// follows the closing.
  std::vector<TriangleD> scene;
  Rounding rounding;  ///< of the scene's triangles
  /// The scene is known to lie within the solid, which was reduced from finer voxels. It cannot be tested in the larger
  /// voxels: a corner may lie so near to a side of theirs that rounding puts it into the next voxel.
  bool is_within = false;
  /// The voxels of the solid that hold a point of what the scene shows to the outside; null: those of its boundary.
  std::shared_ptr<const BrickShelf> surface;
  double least_scale_world = 0;  ///< the least scale of any closing
  /// Rules that make a level's scale finer or coarser at some places. The field is multiplied by the level's scale over
  /// the field's base, which is above 0. Rules by shape are measured on the level's voxels, and keep their lengths.
  /// None: the scale is the same everywhere.
  std::optional<ScalePlan> field;
  /// The level that will be made first: a refusal for memory then also tells the limit at which this level fits.
  std::optional<LodTarget> first;
  /// Levels are cages of quads around the voxels, without a closing; only budgets of faces are possible.
  std::optional<CageParams> cage;
  /// The memory serves tiles at work and, between them, surfaces. The bytes of the scene's outer surface and of `scene`
  /// are subtracted from it.
  PassContext context;
};

/// A mesh that was proposed for a level, as reports list it.
struct TriedWay {
  /// One of: box, prism, hull; surface: simplified from the scene's own surface; finer: simplified from the finest
  /// level, halfway; closing; least volume; cage.
  std::string way;
  double scale_world = 0;  ///< of the mesh's closing
  std::uint64_t faces = 0;
  double volume = 0;       ///< scene units cubed
  double error_world = 0;  ///< NaN: too large to be measured to the end
};

struct LodLevel {
  LatticeMesh mesh;        ///< in the frame of its voxels
  double scale_world = 0;  ///< scale of the closing; 0: there was none, as for boxes, hulls and the scene's own surface
  int reductions = 0;      ///< the voxels are 2^reductions times those of the solid
  int attempts = 0;        ///< number of scales at which the level was closed, from first_scale() on
  bool reached = true;     ///< it has at most the budget's faces
  /// Upper bound of the distances that a viewer can see, scene units. These are the distances from a point of the level
  /// to the outer surface of the scene; for fits also those from a point of that surface outside the level to the
  /// level. The bound is too large by at most:
  ///   - around triangles (Enclose::scene), a 16th of a voxel of the solid or 0.1 %;
  ///   - for a fit to triangles, as a rule a voxel;
  ///   - else three voxels and 4 %.
  double error_world = 0;
  double price = 0;  ///< price by which it was chosen (detail/best_level.h); comparable between the levels of a chain
  MeshCounts counts;
  std::vector<TriedWay> tried;  ///< in the order of the proposals; the level is one of them
};

/// Returns the volume that a level holds, scene units cubed.
[[nodiscard]] inline double volume_of(const LodLevel& level) {
  return level.counts.levels.front().measures.volume;
}

/// Returns the limit on memory at which options.first fits, with all steps before it; 0: not known. `triangles`: number
/// of the scene's triangles, which need not be in `options`. `solid` holds the bricks of `header`; `context` has all of
/// the memory. Callers ask after a refusal; the call itself takes the memory of some bricks.
[[nodiscard]] std::uint64_t chain_limit(const StreamHeader& header, BrickShelf& solid, const LodOptions& options,
                                        const PassContext& context, std::uint64_t triangles);

}  // namespace bp
