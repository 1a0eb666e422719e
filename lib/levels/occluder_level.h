#pragma once
#include "lib/levels/level_chain.h"
#include "lib/pass/hide/hidden_pass.h"

/// One mesh that lies strictly within what a scene hides from every eye outside (lib/pass/hide/hidden_pass.h).
namespace bp {

/// What an occluder is made from.
struct OccluderSource {
  /// `ground`: as if the scene stood on the ground.
  std::function<VoxelizedScene(bool ground)> voxelize;
  std::function<LevelRequest(const StreamHeader&)> request;  ///< faces and scale count; after voxelize()
  bool may_ground = false;                                   ///< the scene can be voxelized again, on the ground
  HiddenOptions hidden;                                      ///< all but the scale
};

/// Faces where none are asked for: these, or so many for each part where that is more, up to the most.
constexpr std::uint64_t kOccluderFaces = 100, kOccluderFacesOfPart = 24, kMostOccluderFaces = 2400;

/// The scales that are tried where none is asked for, scene units, from 0. `header`: of the scene's voxels.
[[nodiscard]] std::vector<double> occluder_scales(const StreamHeader& header);
/// The scales of openings that may be tried of what is hidden, from 0: the search ends where a larger one holds less.
[[nodiscard]] std::vector<double> occluder_openings(const StreamHeader& header);

struct MadeOccluder {
  VoxelizedScene scene;             ///< without its voxels
  LodLevel level;                   ///< error_world: NaN, not measured; no triangle if the scene hides nothing
  double scale_world = 0;           ///< openings narrower than twice this are closed
  bool ground = false;              ///< the scene stands on the ground
  std::uint64_t hidden_voxels = 0;  ///< 0: the scene hides nothing
  double opening_world = 0;         ///< of what is hidden, parts narrower than twice this are left out
  std::uint64_t faces_asked = 0;    ///< or chosen
  struct Tried {
    double scale_world = 0;
    std::uint64_t hidden_voxels = 0;
  };
  std::vector<Tried> tried;  ///< scales
};

/// Without a scale, openings are closed at the least scale, up to a sixteenth of the scene's diagonal, that hides 0.95
/// of what the best one does. A scene that hides a quarter more if it stands on the ground does so: many buildings have
/// no floor. Where the faces show more without small and narrow parts, these are left out.
[[nodiscard]] MadeOccluder make_occluder(const OccluderSource& source, Backends& backends, const LevelSteps& steps);

}  // namespace bp
