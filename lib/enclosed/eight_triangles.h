#pragma once
#include "lib/mesh/lanes.h"

namespace bp {

/// The rounded corners of eight triangles side by side, used to find triangles that are surely clear of a change.
struct EightTriangles {
  FourFloats corners[3][3][2];  ///< [corner][axis][half], lattice units
};

}  // namespace bp
