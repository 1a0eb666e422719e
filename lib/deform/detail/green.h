#pragma once
#include <span>
#include <vector>

#include "lib/deform/detail/scratch.h"

namespace bp::detail {

/// The numbers of a cage for Green coordinates, in its unit.
struct GreenCage {
  std::vector<GreenFace> faces;
  std::vector<double> lengths;  ///< of edges
};
[[nodiscard]] GreenCage green_cage(const Cage& cage);

/// Computes Green coordinates of kWide points, as sums and face_weights of scratch.green. `total` is the sum of the
/// former: the number of times that the cage winds around the point. Bit k of the result says that point k lies so near
/// to a vertex, an edge or a face that its coordinates are unreliable.
unsigned green_weights(const CageView& cage, const WideVec& points, CoordinateScratch& scratch, Wide& total);

/// Computes them for one point, in extended precision and always reliably; the vertices come first. Slow.
void green_weights_slowly(const Cage& cage, const CageView& view, const Vec3d& point, std::span<double> weights);

}  // namespace bp::detail
