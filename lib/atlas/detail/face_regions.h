#pragma once
#include <vector>

#include "lib/mesh/lattice_mesh.h"

namespace bp {

/// Faces of a mesh by what they look towards.
class FaceRegions {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t(0);

  explicit FaceRegions(const LatticeMesh& mesh);

  /// All faces, in parts that are joined by edges and look about one way. First the parts that are large, and then, of
  /// what these leave, the rest: a part has no neighbour that would look its way and is smaller for it.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> cut() const;
  /// The parts of `faces` that edges join.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> joined(const std::vector<std::uint32_t>& faces) const;

  [[nodiscard]] const Vec3d& normal(std::uint32_t face) const { return normals_[face]; }  ///< unit, or 0
  /// Mean normal by area, unit; (0, 0, 1) if it is 0.
  [[nodiscard]] Vec3d direction(const std::vector<std::uint32_t>& faces) const;

 private:
  struct Seed {
    std::uint32_t face;
    Vec3d direction;
  };
  void join(const LatticeMesh& mesh);
  void grow(const std::vector<Seed>& seeds, double least_cosine, std::uint32_t first_part,
            std::vector<std::uint32_t>& part) const;
  [[nodiscard]] std::vector<Seed> large_seeds(const std::vector<std::uint32_t>& by_area) const;

  std::vector<Vec3d> normals_;
  std::vector<double> areas_;
  std::vector<std::array<std::uint32_t, 3>> neighbours_;  // across the edge from corner k to the next, or kNone
};

}  // namespace bp
