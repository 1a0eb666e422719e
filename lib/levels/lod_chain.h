#pragma once
#include <memory>
#include <vector>

#include "lib/device/backend.h"
#include "lib/levels/lod_level.h"

/// Makes a chain of levels of detail from one solid, for bplod. The scene is voxelized once. A level is a closing at a
/// scale of its own, a simplified mesh, or the scene's hull, prism or box, whichever is best (make()). Closings at
/// larger scales use conservative reductions of the voxels (lib/volume/reduce.h). A bounding level strictly encloses
/// the scene, but not necessarily the level before. A fit encloses nothing.
namespace bp {

class LodChain {
 public:
  /// `solid` holds the bricks of `header`, which are a solid layer. Keeps a reference to `backends`. Throws bad_input
  /// if the solid is empty, and out_of_resource if the memory does not suffice for the scene's outside.
  LodChain(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends, LodOptions options);
  ~LodChain();
  LodChain(const LodChain&) = delete;
  LodChain& operator=(const LodChain&) = delete;

  /// Returns the triangles of the dense surface of the solid, from which budgets are derived.
  [[nodiscard]] std::uint64_t dense_faces() const;

  /// Makes the levels of all targets, which must be listed finest first. These meshes are proposed for each level, and
  /// the best one is kept (detail/best_level.h):
  ///   - for a bounding level, the scene's box, prism or hull (detail/convex_levels.h). If one of them is exact,
  ///     nothing else is proposed.
  ///   - a simplified mesh that encloses the scene, if the level has 50 faces for each of its parts and holes: for the
  ///     first level the scene's own surface, if it is closed; for others the mesh that the first level was halfway.
  ///   - else closings. The first scale is the least from an eighth of first_scale() on (a half for a fit) that leaves
  ///     50 faces for each part and hole, or first_scale(). If parts and holes need more faces than there are, twice
  ///     the scale is tried, on coarser voxels if the budget allows, until the faces suffice or the scale is half the
  ///     scene. For simple scenes the closings of all scales up to twice first_scale() are proposed.
  ///   - with fewer than 32 faces, the mesh of least volume around the best closing.
  /// Levels depend on no other level but for the mesh that they are simplified from. So they are made at the same time,
  /// as far as memory and threads allow. Throws as close_stream() and mesh_stream().
  [[nodiscard]] std::vector<LodLevel> make(const std::vector<LodTarget>& targets);
  [[nodiscard]] LodLevel make(const LodTarget& target) { return std::move(make(std::vector{target}).front()); }

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
