#pragma once
#include <cstdint>

#include "lib/simplify/region_size.h"
#include "lib/simplify/shape_limits.h"

/// The parameters of tightening (tighten.h), and its counts.
namespace bp {

struct TightenParams : ShapeLimits {
  int sweeps = 4;            ///< most sweeps that move all vertices together
  int final_sweeps = 3;      ///< most sweeps afterwards that move each vertex as far as it goes alone
  double least_gain = 5e-4;  ///< sweeps of a kind end when one gains less than this share of the volume
  bool stops_early = false;  ///< vertices do not move alone if the last of the first sweeps gained less than that
  /// The volume for that share, lattice units cubed; 0: that of the mesh, which must be whole.
  double volume = 0;
  std::uint64_t faces_per_region = kFacesPerRegion;  ///< as in SimplifyParams
  /// The most that a flip of a thin face's edge may add at the end, lattice units cubed; 0: none is flipped then.
  double most_of_flip = 0;
};

struct TightenCounts {
  std::uint64_t sweeps = 0, moves = 0, flips = 0, tries = 0;
  double volume_before = 0, volume_after = 0;  ///< lattice units cubed
  double volume_of_flips = 0;                  ///< of volume_after: what flips of thin faces have added
};

}  // namespace bp
