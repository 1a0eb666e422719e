#pragma once
#include <span>
#include <vector>

#include "lib/deform/detail/scratch.h"

namespace bp::detail {

/// What Green coordinates need of a cage, in its unit.
struct GreenCage {
  std::vector<GreenFace> faces;
  std::vector<double> lengths;  ///< of edges
};
[[nodiscard]] GreenCage green_cage(const Cage& cage);

/// Green coordinates of kWide points, as sums and face_weights of scratch.green. `total` is the sum of the former: the
/// number of times that the cage winds around the point. Bit k of the result: point k lies so near to a vertex, an edge
/// or a face that its coordinates are not to be trusted.
unsigned green_weights(const CageView& cage, const WideVec& points, CoordinateScratch& scratch, Wide& total);

/// The same for one point, in extended precision and without the trust: first those of the vertices. Slow.
void green_weights_slowly(const Cage& cage, const CageView& view, const Vec3d& point, std::span<double> weights);

}  // namespace bp::detail
