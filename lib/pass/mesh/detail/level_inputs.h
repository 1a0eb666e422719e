#pragma once
#include "lib/pass/context.h"
#include "lib/pass/mesh/detail/ground.h"
#include "lib/pass/mesh/mesh_params.h"

namespace bp {

/// Distance by which a fit expects the scene's surface to lie inside the surface of the voxels, in extents of a voxel
/// along the normal. The mean is a half, for voxels that a surface touches and for their closing.
constexpr double kFitInset = 0.5;

/// The inputs that all levels of a stream share, and what follows from them.
struct LevelInputs {
  const StreamHeader& header;
  const MeshParams& params;
  const ShelfFactory& make_shelf;

  [[nodiscard]] bool inside() const { return params.mode == MeshMode::inside; }
  /// Returns whether a level of so many faces may begin with a coarse surface, since only the number of faces matters.
  [[nodiscard]] bool is_by_faces(std::uint64_t faces) const;
  /// Returns the limits of edges, which depend on the scale at their place; none if edge_factor is 0.
  [[nodiscard]] EdgeLimit edges_for(const GridFrame& frame) const;
  /// Returns the voxels near which edges may be long: those that a level encloses. Null: no edge may be longer than
  /// params.edge_factor allows.
  [[nodiscard]] const BrickShelf* near_of(const BrickShelf& voxels) const {
    return params.edges_by_shape && params.mode == MeshMode::bounding ? &voxels : nullptr;
  }
  /// Returns the memory that limits on edges take.
  [[nodiscard]] std::uint64_t edge_bytes(const GridFrame& frame, const BrickShelf* near) const;
};

/// Returns the limit on memory at which all steps of the first level fit; 0: not known. `triangles`: number of the
/// scene's triangles.
[[nodiscard]] std::uint64_t least_limit(const LevelInputs& in, const PieceMemory& pieces, const Shelves& shelves,
                                        std::uint64_t triangles);

}  // namespace bp
