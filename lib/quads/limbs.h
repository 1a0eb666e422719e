#pragma once
#include <memory>
#include <vector>

#include "lib/grid/stream.h"
#include "lib/mesh/lattice_mesh.h"

/// Counts the limbs of a model, and those that stay apart in a cage.
///
/// Everything is measured on cubes, 128 along the longest side. The root is the cube that lies deepest inside. Ways
/// lead through cubes inside. The cubes whose way from the root is longer than t fall into parts. A limb is a part that
/// grows by at least 3 % of the diagonal, and a tenth of its way, from its tip (its cube farthest from the root) until
/// it meets the part of a farther tip, while t shrinks. Its length is the way from its tip to where it meets another
/// limb. A limb is apart in a cage if, in the cage, the part within half its length of its tip holds no other tip.
namespace bp {

class Limbs {
 public:
  /// Finds the limbs of all voxels. Cost: some ten milliseconds.
  explicit Limbs(const BrickShelf& voxels);
  ~Limbs();
  Limbs(const Limbs&) = delete;
  Limbs& operator=(const Limbs&) = delete;

  [[nodiscard]] std::size_t count() const;
  /// Returns the tips of the limbs that are not apart in a cage around the voxels, lattice units.
  [[nodiscard]] std::vector<LatticeCoord> joined(const LatticeMesh& cage) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
