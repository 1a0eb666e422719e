#pragma once
#include "lib/closing/closing_scratch.h"
#include "lib/closing/detail/ball_transform.h"
#include "lib/closing/detail/chessboard.h"
#include "lib/closing/detail/cube_dilation.h"
#include "lib/closing/detail/oriented_dilation.h"

namespace bp {

struct ClosingScratch::Parts {
  BitBox dilation;                          ///< D
  BitBox inner;                             ///< voxels that are in D for sure, without computing a distance
  detail::ColumnBits seeds, contour, band;  ///< by columns: G or Dc, Dc, and D minus G
  detail::CubeDilation cube;
  detail::VaryingCubeDilation varying;
  detail::OrientedDilation oriented;
  detail::BallTransform ball;
};

}  // namespace bp
