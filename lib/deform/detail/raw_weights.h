#pragma once
#include <vector>

#include "lib/deform/cage.h"
#include "lib/deform/detail/wide.h"

namespace bp::detail {

/// Memory of raw_weights(), kept from call to call.
struct RawScratch {
  struct alignas(8 * kWide) Vertex {
    WideVec toward;   ///< the unit vector from the point
    Wide per_length;  ///< one over the distance
    Wide sum;         ///< the weight
  };
  struct alignas(8 * kWide) Edge {
    WideVec across;  ///< cross product of its ends' unit vectors
    WideVec mean;    ///< its part of mean vectors
  };
  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
};

/// The mean value weights of kWide points, not divided by their sum, as sums of scratch.vertices. `points` are in the
/// unit of the cage. Bit k of the result: point k lies so near to a vertex, an edge or a face, or in line with so thin
/// a face, that its weights are not to be trusted.
unsigned raw_weights(const Cage& cage, const WideVec& points, RawScratch& scratch);

/// The same for one point, in extended precision and without the trust. Slow.
void raw_weights_slowly(const Cage& cage, const Vec3d& point, std::vector<double>& sums);

}  // namespace bp::detail
