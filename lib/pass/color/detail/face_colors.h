#pragma once
#include "lib/core/disjoint_sets.h"
#include "lib/mesh/lattice_mesh.h"
#include "lib/pass/color/scene_colors.h"

namespace bp {

using Rgb = std::array<double, 3>;  ///< as LinearColor

/// The pull of a fit towards the mean, as a share of its weights. It bounds the fit where samples are few.
constexpr double kTowardsMean = 0.05;

/// The colours over a face, as sums over samples.
struct FaceColors {
  std::array<double, 6> products{};  ///< of the corners' weights: 00 11 22 01 12 20
  std::array<double, 3> mass{};      ///< weights, by corner
  std::array<Rgb, 3> sums{};         ///< weights times colours, by corner
  Rgb squares{};                     ///< of the colours
  Rgb low{65535, 65535, 65535}, high{};

  [[nodiscard]] double area() const { return mass[0] + mass[1] + mass[2]; }
  /// Makes all samples count so many times as much.
  void scale(double times) {
    for (double& x : products) x *= times;
    for (double& x : mass) x *= times;
    for (Rgb& sum : sums)
      for (double& x : sum) x *= times;
    for (double& x : squares) x *= times;
  }
};

[[nodiscard]] std::vector<FaceColors> face_colors(const LatticeMesh& mesh, const NearbyColors& colors);

/// Returns groups of corners (3 * triangle + place) that share a colour. They are the corners at a vertex, unless the
/// colours of the faces differ at the edges between them by more than they vary within the faces.
[[nodiscard]] DisjointSets color_groups(const LatticeMesh& mesh, const std::vector<FaceColors>& faces);

}  // namespace bp
