#pragma once
#include "lib/pass/close/close_pass.h"

/// What a scene hides from every eye outside, once openings narrower than twice a scale are closed: the ground of
/// occluders. With G the voxels that the scene touches, and E their closing:
///   O       what the outside reaches through faces of voxels not in E
///   C       what is neither in E nor in O: rooms behind what the closing closes
///   O'      what the outside reaches through faces of voxels not in G or C. So it has all that the closing adds in
///           corners, niches, alleys and openings; but no room behind them
///   T       voxels of G beside O', and those of G beside these; over faces, edges and corners: each point of the scene
///           that is seen from O' lies in these alone
///   hidden  all others
/// Without a scale it is what the scene encloses. docs/bounding.md says what follows; lib/check/hiding_recipe.h has it,
/// too.
namespace bp {

struct HiddenOptions {
  double scale_world = 0;  ///< scene units; below a voxel nothing is closed
  StructuringElement element = StructuringElement::cube;
  PassContext context;  ///< as in CloseOptions
};

struct HiddenVoxels {
  std::unique_ptr<BrickShelf> voxels;
  std::uint64_t count = 0;
};

/// G and what it encloses: all that is not in O' of scale 0. `touched`: the bricks of `header`, FillMode::none.
[[nodiscard]] std::unique_ptr<BrickShelf> enclosed_voxels(const StreamHeader& header, BrickShelf& touched,
                                                          Backends& backends, const HiddenOptions& options);

/// All that is not in O'. `enclosed`: enclosed_voxels(). Null if the closing makes no room: then it is `enclosed`.
[[nodiscard]] std::unique_ptr<BrickShelf> unreached_voxels(const StreamHeader& header, BrickShelf& enclosed,
                                                           Backends& backends, const HiddenOptions& options);

/// `unreached` without T.
[[nodiscard]] HiddenVoxels unseen_voxels(const BrickShelf& unreached, const BrickShelf& touched,
                                         const HiddenOptions& options);

/// All of that, one after the other. The result lies in the bricks of `header`. Out of core; at most four closings,
/// three of them of scale 0. Throws as close_stream().
[[nodiscard]] HiddenVoxels hidden_voxels(const StreamHeader& header, BrickShelf& touched, Backends& backends,
                                         const HiddenOptions& options);

/// The opening of `solid`: what is left of it where parts narrower than twice the scale go, as bpclose does. Null if
/// nothing is.
[[nodiscard]] std::unique_ptr<BrickShelf> opening(const StreamHeader& header, BrickShelf& solid, Backends& backends,
                                                  const HiddenOptions& options);

}  // namespace bp
