#pragma once
#include <optional>
#include <vector>

#include "lib/levels/lod_level.h"
#include "lib/pass/hide/hidden_pass.h"

/// One mesh that lies strictly within what a scene hides from every eye outside (lib/pass/hide/hidden_pass.h).
namespace bp {

/// The user's wishes for an occluder.
struct OccluderRequest {
  std::uint64_t faces = 0;            ///< 0: chosen by the parts that the scene hides
  std::optional<double> scale_world;  ///< scale at which openings are closed, scene units; none: the best of several
  HiddenOptions hidden;               ///< all but the scale
  /// hidden_scene() gives up, and returns nothing hidden, as soon as no scale can hide more voxels than this.
  double more_than_voxels = 0;
};

/// The faces that are chosen if none are asked for: kOccluderFaces, or kOccluderFacesOfPart for each part if that is
/// more, up to kMostOccluderFaces.
constexpr std::uint64_t kOccluderFaces = 100, kOccluderFacesOfPart = 24, kMostOccluderFaces = 2400;

/// Returns the scales that are tried if none is asked for, scene units, from 0. `header`: the header of the scene's
/// voxels.
[[nodiscard]] std::vector<double> occluder_scales(const StreamHeader& header);
/// Returns the scales of openings that may be applied to the hidden voxels, from 0. The search ends when a larger one
/// holds less.
[[nodiscard]] std::vector<double> occluder_openings(const StreamHeader& header);

/// The hidden voxels of a scene at a scale.
struct HiddenScene {
  double scale_world = 0;  ///< openings narrower than twice this are closed
  HiddenVoxels voxels;     ///< count 0: the scene hides nothing
  struct Tried {
    double scale_world = 0;
    std::uint64_t hidden_voxels = 0;
  };
  std::vector<Tried> tried;  ///< the scales that were tried, from 0; empty if one was asked for
};

/// Returns what the scene hides at the scale that is asked for. Without one, it takes the least scale, up to a
/// sixteenth of the scene's diagonal, that hides 0.95 of what the best one does. Scales at which the closing makes no
/// room are left out (possible_rooms.h), and scales that cannot hide as much as one that was tried: a closing bounds
/// what it and all smaller ones hide. `touched` holds the bricks of `header`. `pass`: the name of the work in reports
/// of progress. Throws as close_stream().
[[nodiscard]] HiddenScene hidden_scene(const StreamHeader& header, BrickShelf& touched, Backends& backends,
                                       const OccluderRequest& request, const char* pass);

/// The factor by which the ground must multiply what is hidden.
constexpr double kGroundGains = 1.25;
/// Returns whether a scene hides a quarter more if it stands on the ground, as many buildings without a floor do.
[[nodiscard]] bool gains_on_ground(std::uint64_t on_ground, std::uint64_t without);
/// Returns false if a scene of such voxels cannot hide a quarter more on the ground, since it would have to fill more
/// than its bounds.
[[nodiscard]] bool may_gain_on_ground(const StreamHeader& header, std::uint64_t without);

struct MadeOccluder {
  LodLevel level;                 ///< error_world: NaN, not measured
  double opening_world = 0;       ///< parts of the hidden voxels narrower than twice this are left out
  std::uint64_t faces_asked = 0;  ///< the number asked for or chosen
};

/// Returns a limit on memory at which make_occluder() has enough for its first mesh, which is the largest.
[[nodiscard]] std::uint64_t occluder_limit(const StreamHeader& header, const HiddenScene& hidden,
                                           const OccluderRequest& request);
/// Returns a limit on memory at which hidden_scene() and make_occluder() most likely have enough, before anything is
/// closed: the voxels of the scene are walls with two sides, and what they hide has the surface of one.
[[nodiscard]] std::uint64_t occluder_limit_before(const StreamHeader& header, BrickShelf& touched,
                                                  const OccluderRequest& request);
/// Makes the mesh inside the hidden voxels, which must not be empty. Small and narrow parts are left out if the faces
/// cover more of the silhouettes without them.
[[nodiscard]] MadeOccluder make_occluder(const StreamHeader& header, const HiddenScene& hidden, Backends& backends,
                                         const OccluderRequest& request);

}  // namespace bp
