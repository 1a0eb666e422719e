#pragma once
#include <memory>
#include <vector>

#include "lib/device/backend.h"
#include "lib/levels/lod_level.h"

/// bplod's work: a chain of levels of detail from one solid. The scene is voxelized once; each level is closed at a
/// scale of its own, coarser ones on conservative reductions of the voxels (lib/volume/reduce.h), and meshed to its
/// target. A bounding level strictly encloses the scene by itself; it need not enclose the level before. A fitted one
/// encloses nothing.
namespace bp {

class LodChain {
 public:
  /// `solid` holds the bricks of `header`, a solid layer. Keeps references to `backends`.
  /// Throws bad_input if it is empty, out_of_resource if the memory does not suffice for the scene's outside.
  LodChain(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends, LodOptions options);
  ~LodChain();
  LodChain(const LodChain&) = delete;
  LodChain& operator=(const LodChain&) = delete;

  /// Triangles of the dense surface of the solid: what budgets are measured against.
  [[nodiscard]] std::uint64_t dense_faces() const;
  /// Length of the longest side of the solid, in voxels.
  [[nodiscard]] std::int64_t longest_side_vox() const;

  /// Makes the levels of all targets, which come finest first. Each is the best (detail/best_level.h) of what is
  /// proposed for it:
  ///   - of a bounding level, the scene's box, prism or hull (detail/convex_levels.h); nothing else is proposed where
  ///     one of these is exact;
  ///   - a mesh around the scene with fewer faces, where these are 50 for each of its parts and holes: the surface of a
  ///     scene that is a closed one, for the first level; the mesh that the first level was halfway, for others;
  ///   - else closings: at the least scale, from an eighth of first_scale() on (a half in a fit), that leaves each part
  ///     and hole so many faces, or at first_scale(). Where parts and holes take more faces than there are, twice the
  ///     scale is tried, on coarser voxels where the budget allows, until there are enough or the scale is half the
  ///     scene. Of simple scenes all scales up to twice first_scale() are proposed;
  ///   - of fewer than 32 faces, the mesh of least volume around the best closing.
  /// No level needs another one, but for the mesh that they begin from: so they are made at the same time, as far as
  /// memory and threads allow. Throws as close_stream() and mesh_stream().
  [[nodiscard]] std::vector<LodLevel> make(const std::vector<LodTarget>& targets);
  [[nodiscard]] LodLevel make(const LodTarget& target) { return std::move(make(std::vector{target}).front()); }

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
