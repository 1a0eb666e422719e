#pragma once
#include <functional>

#include "lib/core/coords.h"

namespace bp {

/// A place on the surface that a fit follows, lattice units.
struct FitPlace {
  Vec3d at;
  Vec3d normal{};  ///< unit normal of that surface there, to either side; zero if it is not known
  /// If that surface ends there, as at the rim of a plate: the unit direction outwards along the surface. Zero
  /// elsewhere.
  Vec3d end{};
};

/// Returns where a point of the dense surface at `p` should be, given the unit normal of the dense surface there;
/// lattice units. Several threads call it at a time.
using FitTarget = std::function<FitPlace(const Vec3d& p, const Vec3d& normal)>;

}  // namespace bp
