#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "lib/core/up_axis.h"
#include "lib/mesh/box_group.h"
#include "lib/mesh/lattice_mesh.h"

namespace bp {

/// Measures how much occluders cover: draws their silhouettes in orthographic views from all around, from the horizon
/// up to 50 degrees above it, as eyes see buildings.
class Silhouettes {
 public:
  static constexpr std::size_t kViews = 24;
  static constexpr int kSide = 192;  ///< pixels

  /// `box`: holds all meshes to be drawn; lattice units.
  Silhouettes(const LatticeBox& box, UpAxis up);

  /// Returns the size of the mesh's silhouette over that of the box, as a mean over all views. Only comparisons of such
  /// shares mean something. Cost: a millisecond for some hundred triangles.
  [[nodiscard]] double share(const LatticeMesh& mesh) const;

 private:
  static constexpr std::size_t kWordsOfRow = kSide / 64;
  using Picture = std::array<std::uint64_t, std::size_t(kSide) * kWordsOfRow>;  // a bit is a pixel
  struct View {
    Vec3d right, down;     // of unit length
    double pixels_of_box;  // the size of the box's silhouette
  };
  using Flat = std::array<double, 2>;  // pixels
  [[nodiscard]] Flat flat(const View& view, const Vec3d& p) const;
  [[nodiscard]] std::uint64_t pixels_of(const View& view, const LatticeMesh& mesh) const;
  static void fill(const std::array<Flat, 3>& corners, Picture& picture);

  std::array<View, kViews> views_;
  Vec3d centre_;
  double pixels_;  // per lattice unit
};

}  // namespace bp
