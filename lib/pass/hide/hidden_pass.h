#pragma once
#include "lib/pass/close/close_pass.h"

/// The voxels that a scene hides from every eye outside, once openings narrower than twice a scale are closed: the
/// ground of occluders. With G the voxels that the scene touches, E their closing, and P the voxels that somebody
/// enters:
///   O       reached by the outside, or from P, through faces of voxels not in E
///   C       voxels neither in E nor in O: rooms behind closed openings
///   added   voxels of E that are not in G
///   gaps    added voxels in a run along an axis, of at most 2 sqrt(2) S added voxels, between two voxels of G:
///           openings, alleys, niches
///   R       added voxels that lie in no gap and are nearer to C than to O, along paths over faces of such voxels, at
///           most 2 ceil(S) long: what the closing adds along the edges of rooms
///   O'      P, and what the outside or P reach through faces of voxels not in G, C or R. So it has everything that the
///           closing adds in corners, niches, alleys and openings; but no room behind them
///   T       voxels of G next to O', and voxels of G next to these; over faces, edges and corners. Each point of the
///           scene that is seen from O' lies in T alone
///   hidden  all other voxels
/// Without a scale these are the voxels that the scene encloses. docs/bounding.md has the consequences;
/// lib/check/hiding_recipe.h has the definition, too.
namespace bp {

struct HiddenOptions {
  double scale_world = 0;  ///< scene units; below a voxel nothing is closed
  StructuringElement element = StructuringElement::cube;
  const BitBox* entered = nullptr;  ///< the set P (entered_rooms.h); null: none
  PassContext context;              ///< as in CloseOptions
};

struct HiddenVoxels {
  std::unique_ptr<BrickShelf> voxels;
  std::uint64_t count = 0;
};

/// Returns G and the voxels that it encloses: all that are not in O' of scale 0. `touched`: the bricks of `header`,
/// FillMode::none.
[[nodiscard]] std::unique_ptr<BrickShelf> enclosed_voxels(const StreamHeader& header, BrickShelf& touched,
                                                          Backends& backends, const HiddenOptions& options);

/// The closing at a scale.
struct ClosedVoxels {
  std::unique_ptr<BrickShelf> closed;  ///< E, with the voxels that G encloses
  std::unique_ptr<BrickShelf> filled;  ///< the same, and C
  bool has_rooms = false;              ///< C is not empty
  /// The number of filled voxels, without rooms that are entered. No more are hidden at this scale, nor at a smaller
  /// one: closings grow with the scale, up to a layer of voxels.
  std::uint64_t count = 0;
};
/// Makes the closing; below a voxel it is left out, and only counted. `enclosed`: enclosed_voxels().
[[nodiscard]] ClosedVoxels closed_voxels(const StreamHeader& header, BrickShelf& enclosed, Backends& backends,
                                         const HiddenOptions& options);

/// Returns all voxels that are not in O'. `closed`: closed_voxels() of `enclosed`, with rooms.
[[nodiscard]] std::unique_ptr<BrickShelf> unreached_voxels(const StreamHeader& header, const BrickShelf& enclosed,
                                                           ClosedVoxels closed, Backends& backends,
                                                           const HiddenOptions& options);
/// Returns the same of `enclosed`. Null if the closing makes no room; then they are `enclosed`.
[[nodiscard]] std::unique_ptr<BrickShelf> unreached_voxels(const StreamHeader& header, BrickShelf& enclosed,
                                                           Backends& backends, const HiddenOptions& options);

/// Returns `unreached` without T.
[[nodiscard]] HiddenVoxels unseen_voxels(const BrickShelf& unreached, const BrickShelf& touched,
                                         const HiddenOptions& options);

/// Does all of that, one after the other. The result lies in the bricks of `header`. Out of core; at most four
/// closings, three of them of scale 0. Throws as close_stream() does, and NeedsMemory if a tile of one brick, with 2 S
/// of voxels around it and the length of a gap, takes more than the memory.
[[nodiscard]] HiddenVoxels hidden_voxels(const StreamHeader& header, BrickShelf& touched, Backends& backends,
                                         const HiddenOptions& options);

/// Returns a limit on memory at which the sets around a closed opening fit; 0: not known.
[[nodiscard]] std::uint64_t hidden_limit(const StreamHeader& header, const HiddenOptions& options);

/// Returns the opening of `solid`: parts narrower than twice the scale go, as bpclose removes them. Null if nothing is
/// left.
[[nodiscard]] std::unique_ptr<BrickShelf> opening(const StreamHeader& header, BrickShelf& solid, Backends& backends,
                                                  const HiddenOptions& options);

}  // namespace bp
