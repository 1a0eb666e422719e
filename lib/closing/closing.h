#pragma once
#include "lib/grid/bit_box.h"
#include "lib/grid/orientation_field.h"
#include "lib/grid/scale_field.h"
#include "lib/grid/stream.h"

/// The spatially varying closing, after [CB17] §3.3, Alg. 1-2 (docs/references.md), exact in integers. With G the
/// voxels of the input, r(p) = floor(S(p)), w(p) = ceil(S(p)^2):
///   D  = { p : exists g in G with max|p-g| <= r(p) }  (cube)   or   { p : exists g in G with |p-g|^2 < w(p) }  (ball),
///        united with G (which matters for the ball where S = 0).
///        Where cubes are turned, in_oriented_cube() of p's rotation and S(p) decides (lib/closing/rotation.h).
///   Dc = { q not in D : a 6-neighbour of q is in D }
///   E  = G  united with  { p in D : no q in Dc has |p-q|^2 < w(q) }
/// Hence G ⊆ E ⊆ D: a closing always encloses its input. S < 1 is the identity. Everything outside the grid is empty.
namespace bp {

struct ClosingParams {
  StructuringElement element = StructuringElement::cube;
  const OrientationField* orientation = nullptr;  ///< rotations of cubes; null: cubes stand along the axes
  /// Memory for the rows of turned cubes of a tile. At least turned_cubes_bytes() are used. It changes no result.
  std::size_t cube_bytes = 0;

  [[nodiscard]] bool turned() const { return orientation != nullptr && element == StructuringElement::cube; }
  /// Adds the parameters to the key of a kept result. Levels, whose results are kept, take no orientation.
  template <class Hash>
  void add_to(Hash& hash) const {
    hash.add(element);
  }
};

/// Returns how far an element of scale `s`, cube or ball, reaches along an axis, in voxels.
[[nodiscard]] std::int32_t element_reach(Scale s, const ClosingParams& params = {});

/// Returns the least memory that close_tile() takes for the rows of turned cubes that reach so far along an axis.
[[nodiscard]] std::size_t turned_cubes_bytes(std::int32_t reach);

/// The voxels of context around a tile that make its interior exact: ceil(s1) + 1 + ceil(s2). s1 is the largest scale
/// of any voxel whose erosion ball can reach the tile. s2 is the largest scale in the region that then decides about
/// the contour (docs/pipeline.md, "Halo").
struct Halo {
  std::int32_t erosion_vox = 0;   ///< D and Dc must be exact up to this distance from the tile
  std::int32_t dilation_vox = 0;  ///< G must be known this much farther from the tile
  [[nodiscard]] std::int32_t total_vox() const { return erosion_vox + dilation_vox; }
};
[[nodiscard]] Halo halo_of(const VoxelBox& tile, const ScaleField& scale, const GridFrame& frame,
                           const ClosingParams& params = {});

/// Closes the interior of a tile on the calling thread.
///   solid     G over the tile and its halo; voxels outside its box are empty
///   scale     S over interior.grown(halo.erosion_vox), at least
///   interior  the tile; `closed` is reset to it
///   scratch   reused between calls; one per thread (lib/closing/closing_scratch.h)
/// The cost follows the band D minus G. There is none if the halo holds no solid voxel or the tile is full.
class ClosingScratch;
void close_tile(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                const VoxelBox& interior, BitBox& closed, ClosingScratch& scratch);

}  // namespace bp
