#pragma once
#include "lib/core/disjoint_sets.h"
#include "lib/mesh/lattice_mesh.h"
#include "lib/pass/color/scene_colors.h"

namespace bp {

using Rgb = std::array<double, 3>;  ///< as LinearColor

/// The pull of a fit towards the mean, in shares of its weights: where few samples tell, it stays bounded.
constexpr double kTowardsMean = 0.05;

/// The colours over a face, summed up over samples.
struct FaceColors {
  std::array<double, 6> products{};  ///< of the corners' weights: 00 11 22 01 12 20
  std::array<double, 3> mass{};      ///< weights, by corner
  std::array<Rgb, 3> sums{};         ///< weights times colours, by corner
  Rgb squares{};                     ///< of colours
  Rgb low{65535, 65535, 65535}, high{};

  [[nodiscard]] double area() const { return mass[0] + mass[1] + mass[2]; }
  /// Lets all samples count so many times as much.
  void scale(double times) {
    for (double& x : products) x *= times;
    for (double& x : mass) x *= times;
    for (Rgb& sum : sums)
      for (double& x : sum) x *= times;
    for (double& x : squares) x *= times;
  }
};

[[nodiscard]] std::vector<FaceColors> face_colors(const LatticeMesh& mesh, const NearbyColors& colors);

/// Corners (3 * triangle + place) that share a colour: those at a vertex, unless the colours of the faces differ at the
/// edges between them by more than they vary within the faces.
[[nodiscard]] DisjointSets color_groups(const LatticeMesh& mesh, const std::vector<FaceColors>& faces);

}  // namespace bp
