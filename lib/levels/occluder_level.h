#pragma once
#include <optional>
#include <vector>

#include "lib/levels/lod_level.h"
#include "lib/pass/hide/hidden_pass.h"

/// One mesh that lies strictly within what a scene hides from every eye outside (lib/pass/hide/hidden_pass.h).
namespace bp {

/// What an occluder is asked to be.
struct OccluderRequest {
  std::uint64_t faces = 0;            ///< 0: chosen by the parts that the scene hides
  std::optional<double> scale_world;  ///< at which openings are closed, scene units; none: the best of several
  HiddenOptions hidden;               ///< all but the scale
};

/// Faces where none are asked for: these, or so many for each part where that is more, up to the most.
constexpr std::uint64_t kOccluderFaces = 100, kOccluderFacesOfPart = 24, kMostOccluderFaces = 2400;

/// The scales that are tried where none is asked for, scene units, from 0. `header`: of the scene's voxels.
[[nodiscard]] std::vector<double> occluder_scales(const StreamHeader& header);
/// The scales of openings that may be tried of what is hidden, from 0: the search ends where a larger one holds less.
[[nodiscard]] std::vector<double> occluder_openings(const StreamHeader& header);

/// What a scene hides at a scale.
struct HiddenScene {
  double scale_world = 0;  ///< openings narrower than twice this are closed
  HiddenVoxels voxels;     ///< count 0: the scene hides nothing
  struct Tried {
    double scale_world = 0;
    std::uint64_t hidden_voxels = 0;
  };
  std::vector<Tried> tried;  ///< scales; none if one was asked for
};

/// At the scale that is asked for; else at the least one, up to a sixteenth of the scene's diagonal, that hides 0.95 of
/// what the best one does. `touched` holds the bricks of `header`. `pass`: the name of the work for whoever is told of
/// the progress. Throws as close_stream().
[[nodiscard]] HiddenScene hidden_scene(const StreamHeader& header, BrickShelf& touched, Backends& backends,
                                       const OccluderRequest& request, const char* pass);

/// Whether a scene that stands on the ground hides a quarter more than without, as many buildings do that have no
/// floor.
[[nodiscard]] bool gains_on_ground(std::uint64_t on_ground, std::uint64_t without);
/// False if a scene of such voxels cannot hide a quarter more, wherever it stands: it would fill its bounds.
[[nodiscard]] bool may_gain_on_ground(const StreamHeader& header, std::uint64_t without);

struct MadeOccluder {
  LodLevel level;                 ///< error_world: NaN, not measured
  double opening_world = 0;       ///< of what is hidden, parts narrower than twice this are left out
  std::uint64_t faces_asked = 0;  ///< or chosen
};

/// The mesh inside of what a scene of `header` hides, which is something. Where its faces show more without small and
/// narrow parts, these are left out.
[[nodiscard]] MadeOccluder make_occluder(const StreamHeader& header, const HiddenScene& hidden, Backends& backends,
                                         const OccluderRequest& request);

}  // namespace bp
