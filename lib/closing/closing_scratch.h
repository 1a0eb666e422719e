#pragma once
#include "lib/closing/closing.h"
#include "lib/closing/detail/ball_transform.h"
#include "lib/closing/detail/chessboard.h"
#include "lib/closing/detail/cube_dilation.h"

/// Working memory of close_tile, kept between calls. One per thread.
namespace bp {

class ClosingScratch {
 public:
  BitBox dilation, inner;                   ///< D; what needs no distance to be in D
  detail::ColumnBits seeds, contour, band;  ///< G or Dc, by columns; D minus G, by columns
  detail::CubeDilation cube;
  detail::VaryingCubeDilation varying;
  detail::BallTransform ball;
};

}  // namespace bp
