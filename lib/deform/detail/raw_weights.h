#pragma once
#include <vector>

#include "lib/deform/cage.h"
#include "lib/deform/detail/four.h"

namespace bp::detail {

/// Memory of raw_weights(), kept from call to call.
struct RawScratch {
  struct alignas(32) Vertex {
    FourVec toward;   ///< the unit vector from the point
    Four per_length;  ///< one over the distance
    Four sum;         ///< the weight
  };
  struct alignas(32) Edge {
    FourVec across;  ///< cross product of its ends' unit vectors
    FourVec mean;    ///< its part of mean vectors
  };
  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
};

/// The mean value weights of four points, not divided by their sum, as sums of scratch.vertices. `points` are in the
/// unit of the cage. Bit k of the result: point k lies so near to a vertex, an edge or a face, or in line with so thin
/// a face, that its weights are not to be trusted.
unsigned raw_weights(const Cage& cage, const FourVec& points, RawScratch& scratch);

/// The same for one point, in extended precision and without the trust. Slow.
void raw_weights_slowly(const Cage& cage, const Vec3d& point, std::vector<double>& sums);

}  // namespace bp::detail
