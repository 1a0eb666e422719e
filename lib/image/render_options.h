#pragma once
#include <optional>

#include "lib/core/box.h"
#include "lib/core/up_axis.h"
#include "lib/image/image.h"
#include "lib/image/typeface.h"

namespace bp {

struct RenderOptions {
  int panel_width = 720, panel_height = 720;  ///< pixels; axes and labels come below
  double azimuth = 35;  ///< degrees that the viewer stands to the right of the front (-y of a z-up scene, +z of a y-up)
  double elevation = 22;  ///< degrees above the horizon
  UpAxis up = UpAxis::y;
  Bounds3d bounds;  ///< the part to show, scene units; empty: everything that is drawn, as large as it fits
  double zoom = 1;  ///< factor on the size at which everything fits
  std::optional<Vec3d> look_at{};  ///< point in the middle of every panel; none: the middle of the part to show
  Typeface* typeface = nullptr;    ///< for labels; null: none are drawn
  bool marks = false;  ///< draw axes and a ruler, in panels that are not too small, and lines between panels
  Color background{255, 255, 255}, ink{40, 44, 52};
};

}  // namespace bp
