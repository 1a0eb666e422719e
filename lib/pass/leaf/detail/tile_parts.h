#pragma once
#include <vector>

#include "lib/pass/leaf/detail/leaf_mesh.h"

namespace bp {

/// The parts of a tile: surface that is joined by edges and points. Parts without a point on the faces of the tile's
/// box may vanish.
class TileParts {
 public:
  using Index = LeafMesh::Index;
  /// `mesh`: that of `tile`, with all its faces. `box`: the tile's.
  TileParts(const LeafMesh& mesh, const SceneLeaf& tile, const Bounds3d& box);

  /// Returns whether a point must stay where it is.
  [[nodiscard]] bool stays(Index point) const { return stays_[point] != 0; }
  void let_stay(Index point) { stays_[point] = 1; }
  /// Returns what it costs to drop the cheapest part that may vanish: its area times its squared size, which compares
  /// with quadrics. Infinite if there is none.
  [[nodiscard]] double least_cost() const;
  /// Returns the faces that are left of that part, which may be none, and forgets the part.
  std::vector<Index> take_cheapest(const LeafMesh& mesh);
  /// Returns the triangles of `tile` in parts of which something is left in `mesh`, which the tile's has become, or in
  /// those that are gone; scene units.
  [[nodiscard]] std::vector<TriangleD> triangles_of(const SceneLeaf& tile, const LeafMesh& mesh, bool left) const;

 private:
  struct Part {
    double cost = 0;
    bool may_go = true;
    std::vector<Index> faces;
  };
  void find(const LeafMesh& mesh);
  [[nodiscard]] static bool is_left(const Part& part, const LeafMesh& mesh);

  std::vector<char> stays_;  // by point
  std::vector<Part> parts_;
  std::vector<std::size_t> may_go_;  // numbers of parts, the cheapest last
};

}  // namespace bp
