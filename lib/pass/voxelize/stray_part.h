#pragma once
#include "lib/core/box.h"

namespace bp {

/// A small part of a scene, by area, that lies far from the rest and makes the bounds large.
struct StrayPart {
  Bounds3d part, rest;  ///< scene units
  double share = 0;     ///< of the area
};
constexpr double kStrayShare = 0.01;  ///< of the area, at most
constexpr double kStrayStretch = 4;   ///< the bounds are longer than those of the rest by more than this factor

}  // namespace bp
