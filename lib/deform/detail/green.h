#pragma once
#include <span>
#include <vector>

#include "lib/deform/cage.h"
#include "lib/deform/detail/scratch.h"

namespace bp::detail {

/// What Green coordinates need of the faces of a cage, in its unit.
struct GreenCage {
  struct Face {
    Vec3d normal{};                   ///< unit; 0 if it has no area: then all its coordinates are 0
    std::array<Vec3d, 3> out{};       ///< unit vectors in its plane, out of it across edge i
    std::array<double, 3> per{};      ///< one over the height of corner i
    std::array<double, 3> angle{};    ///< product of `out` of the other two edges
    double twice_area = 0, part = 0;  ///< part: 1 / 4 pi, or 0
  };
  std::vector<Face> faces;
  std::vector<double> lengths;  ///< of edges
};
[[nodiscard]] GreenCage green_cage(const Cage& cage);

/// Green coordinates of kWide points, as sums of green.vertices and as green.faces of the scratch. `total` is the sum
/// of those of the vertices: the number of times that the cage winds around the point. Bit k of the result: point k
/// lies so near to a vertex, an edge or a face that its coordinates are not to be trusted.
unsigned green_weights(const Cage& cage, const GreenCage& green, const WideVec& points, CoordinateScratch& scratch,
                       Wide& total);

/// The same for one point, in extended precision and without the trust: first those of the vertices. Slow.
void green_weights_slowly(const Cage& cage, const GreenCage& green, const Vec3d& point, std::span<double> weights);

}  // namespace bp::detail
