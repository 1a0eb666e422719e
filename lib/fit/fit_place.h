#pragma once
#include <functional>

#include "lib/core/coords.h"

namespace bp {

/// A place on the surface that a fit follows, lattice units.
struct FitPlace {
  Vec3d at;
  Vec3d normal{};  ///< of that surface there, unit, to either side; zero where it is not known
  /// Where that surface ends there, as at the rim of a plate: outwards, unit. Else zero.
  Vec3d end{};
};

/// Where a point of the dense surface at `p` should be, given the unit normal of the surface there; lattice units. Must
/// be callable by several threads at a time.
using FitTarget = std::function<FitPlace(const Vec3d& p, const Vec3d& normal)>;

}  // namespace bp
