#pragma once
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "lib/grid/stream.h"
#include "lib/mesh/lattice_mesh.h"

/// Counts the limbs of a model, and those that stay apart in a cage.
///
/// Everything is measured on cubes, 128 along the longest side. The root of a connected part of the model is the cube
/// that lies deepest in it. Ways lead from the roots through cubes inside. The cubes whose way is longer than t fall
/// into parts. The tip of such a part is its cube with the longest way. Its length is the way from the tip to t. Its
/// section is its cubes next to t. A limb is a part with a neck: at some t, before it meets the part of a farther tip,
/// its section is narrower than the part is long, and narrower than t. It is at least 3 % of the diagonal long there.
/// So corners of boxes are no limbs: they are wider than long unless they are sharper than 53 degrees.
///
/// The length of a limb is the way from its tip to where it meets another limb. In a cage, a connected part has the
/// deepest of the roots in it. A limb is apart if, in the cage, the part within half its length of its tip holds no
/// other tip.
namespace bp {

/// How well a cage fits a model.
struct CageFit {
  std::vector<LatticeCoord> joined;  ///< tips of the limbs that are not apart, lattice units
  std::int32_t reach = 0;            ///< the longest of the shortest ways in the cage to the model, thirds of a cube
  std::size_t cubes = 0;             ///< in the cage

  /// Fewer joined limbs are better, then a shorter reach, then a smaller volume.
  [[nodiscard]] bool is_better_than(const CageFit& other) const {
    return std::tuple(joined.size(), reach, cubes) < std::tuple(other.joined.size(), other.reach, other.cubes);
  }
};

class Limbs {
 public:
  /// Finds the limbs of a model. `grown`: its voxels with a margin around them, or the same voxels. Hollows that the
  /// margin closes off from the outside are inside of the model, too. Cost: some ten milliseconds.
  Limbs(const BrickShelf& model, const BrickShelf& grown);
  ~Limbs();
  Limbs(const Limbs&) = delete;
  Limbs& operator=(const Limbs&) = delete;

  [[nodiscard]] std::size_t count() const;
  /// Measures a cage around the voxels.
  [[nodiscard]] CageFit fit(const LatticeMesh& cage) const;
  /// Returns bytes that decide all results.
  [[nodiscard]] std::string key() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
