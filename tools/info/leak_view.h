#pragma once
#include "lib/core/grid_frame.h"
#include "lib/volume/leaks.h"

namespace bp {

/// A direction from which a leak can be drawn.
struct LeakView {
  double azimuth = 0, elevation = 0;  ///< degrees, as in RenderOptions
  bool seen = false;                  ///< the opening is seen from there; else walls lie before it
};

/// Returns whether the opening is seen from a direction: whether a ray from its middle meets no wall.
[[nodiscard]] bool is_seen(const Leak& leak, const LeakView& view, const BitBox& walls, const GridFrame& frame);

/// Returns the direction from which the opening is seen best: at an angle, from outside, rather from above. If no
/// direction shows it, the one in which its way leads outside.
[[nodiscard]] LeakView view_of(const Leak& leak, const BitBox& walls, const GridFrame& frame);

}  // namespace bp
