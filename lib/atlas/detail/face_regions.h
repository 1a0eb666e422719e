#pragma once
#include <vector>

#include "lib/mesh/lattice_mesh.h"

namespace bp {

/// Groups the faces of a mesh by their directions.
class FaceRegions {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t(0);

  explicit FaceRegions(const LatticeMesh& mesh);

  /// Returns all faces in parts that are joined by edges and look about one way. Large parts are cut first, then the
  /// rest. A part has no smaller neighbour that looks its way.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> cut() const;
  /// Returns the parts of `faces` that edges join.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> joined(const std::vector<std::uint32_t>& faces) const;

  [[nodiscard]] const Vec3d& normal(std::uint32_t face) const { return normals_[face]; }  ///< of length 1, or 0
  /// Returns the mean normal by area, of length 1; (0, 0, 1) if it is 0.
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
  // Across the edge from corner k to the next; kNone if there is none.
  std::vector<std::array<std::uint32_t, 3>> neighbours_;
};

}  // namespace bp
