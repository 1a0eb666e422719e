#include "lib/closing/ball_dilation.h"

#include "lib/closing/detail/ball_dilation.h"
#include "lib/closing/detail/rows.h"

namespace bp {

namespace detail {

/// Voxels in the cube inscribed in the least ball are in without computing a distance. Voxels outside of the cube
/// around the largest ball are out. Between them, the distance to the solid decides.
void dilate_by_balls(const BitBox& solid, const VoxelBox& occupied, const BallRule& rule, std::int32_t least,
                     ClosingScratch::Parts& s, BitBox& out) {
  const std::int32_t reach = ball_reach(rule.bound), inscribed = ball_reach(std::max(1, (least + 2) / 3));
  s.cube.run(solid, reach, out);
  s.inner.reset(out.box());
  s.cube.run(solid, inscribed, s.inner);
  const VoxelBox& box = out.box();
  s.band.reset(box);
  for_each_row(box, [&](std::int32_t y, std::int32_t z) {
    const std::uint64_t *outer = out.row(y, z), *inner = s.inner.row(y, z);
    std::uint64_t* band = s.band.slice(0, z) + (y - box.min.y);
    for (std::int32_t i = 0; i < s.band.columns(); ++i)
      band[std::size_t(i) * s.band.column_stride()] = outer[i] & ~inner[i];
  });
  s.seeds.reset(intersect(occupied, whole_words(box.grown(reach))));
  for_each_row(s.seeds.box(), [&](std::int32_t y, std::int32_t z) {
    const std::uint64_t* g = solid.row(y, z) + (s.seeds.box().min.x - solid.box().min.x) / 64;
    std::uint64_t* seeds = s.seeds.slice(0, z) + (y - s.seeds.box().min.y);
    for (std::int32_t i = 0; i < s.seeds.columns(); ++i) seeds[std::size_t(i) * s.seeds.column_stride()] = g[i];
  });
  s.ball.run(s.seeds, rule, s.band);
  for_each_row(box, [&](std::int32_t y, std::int32_t z) {
    std::uint64_t* d = out.row(y, z);
    const std::uint64_t *inner = s.inner.row(y, z), *reached = s.band.slice(0, z) + (y - box.min.y);
    for (std::int32_t i = 0; i < s.band.columns(); ++i)
      d[i] = inner[i] | reached[std::size_t(i) * s.band.column_stride()];
  });
}

}  // namespace detail

void dilate_by_ball(const BitBox& solid, std::int32_t bound, BitBox& out, ClosingScratch& scratch) {
  const VoxelBox occupied = detail::occupied_bounds(solid, out.box().grown(detail::ball_reach(bound)));
  detail::dilate_by_balls(solid, occupied, {detail::BallScale::uniform, bound, nullptr}, bound, scratch.parts(), out);
}

}  // namespace bp
