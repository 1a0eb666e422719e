// The halo of a tile T. |.| is the Euclidean distance, and ||.|| the Chebyshev distance, which is never larger.
// - E on T needs the voxels q of Dc with |p - q|^2 < w(q) for some p in T. Such a q is at t = ||q - T|| <= |p - q|, so
//   t <= reach(q) := floor(sqrt(w(q) - 1)). With e the largest t of any voxel with t <= reach, all of them lie in
//   T + e.
// - Dc on T + e needs D on T + (e + 1): `erosion_vox`.
// - D at p needs the voxels g of G within floor(S(p)) (cube) or reach(p) (ball) of p. With d the larger of both over
//   T + (e + 1), it needs G on T + (e + 1) + d: `dilation_vox` is d.
// Nothing else enters, so a solid cut to T + (e + 1 + d) gives the same E on T as the whole grid. Both bounds come from
// the samples: S at a voxel is at most the largest of the eight samples around it.
#include <algorithm>

#include "lib/closing/closing.h"
#include "lib/closing/detail/scale_row.h"
#include "lib/closing/rotation.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr std::int32_t kLeaf = 64;  // voxels: boxes up to this size are sampled, larger ones are split

std::int32_t reach_of(Scale s) {
  return detail::ball_reach(ball_bound(s));
}

/// Returns the Chebyshev distances from the tile to the nearest and to the farthest voxel of `box`.
struct Distance {
  std::int32_t nearest = 0, farthest = 0;
};
Distance distance(const VoxelBox& tile, const VoxelBox& box) {
  Distance d;
  for (int axis = 0; axis < 3; ++axis) {
    d.nearest = std::max({d.nearest, tile.min[axis] - (box.max[axis] - 1), box.min[axis] - (tile.max[axis] - 1)});
    d.farthest = std::max({d.farthest, tile.min[axis] - box.min[axis], box.max[axis] - tile.max[axis]});
  }
  return d;
}

/// Finds e by descending into those boxes around the tile that may still raise it.
class ErosionReach {
 public:
  ErosionReach(const VoxelBox& tile, const ScaleField& field, const GridFrame& frame)
      : tile_(tile), field_(field), frame_(frame) {}

  [[nodiscard]] std::int32_t find() {
    const std::int32_t most = reach_of(field_.upper_bound(frame_));
    VoxelBox root = tile_.grown(most);
    for (int axis = 0; axis < 3; ++axis) {  // whole cells of the lattice
      root.min[axis] = floor_div(root.min[axis], kScaleStep) * kScaleStep;
      root.max[axis] = ceil_div(root.max[axis], kScaleStep) * kScaleStep;
    }
    visit(root);
    return found_;
  }

 private:
  void raise(const Distance& d, std::int32_t reach) {
    if (d.nearest <= reach) found_ = std::max(found_, std::min(d.farthest, reach));
  }

  void visit(const VoxelBox& box) {
    const Distance d = distance(tile_, box);
    if (d.farthest <= found_) return;
    const Ball ball = around(box.grown(2 * kScaleStep));  // the samples of the box's voxels lie there
    const ScaleField here = field_.near(ball.centre, ball.radius);
    const std::int32_t bound = reach_of(scale_of(here.range(ball.centre, ball.radius).most, frame_));
    if (d.nearest > bound || bound <= found_) return;
    if (here.constant()) return raise(d, bound);
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis) {
      if (box.size()[axis] > box.size()[longest]) longest = axis;
    }
    if (box.size()[longest] <= kLeaf) return scan(box, here);
    VoxelBox lower = box, upper = box;
    lower.max[longest] = upper.min[longest] = box.min[longest] + box.size()[longest] / (2 * kScaleStep) * kScaleStep;
    visit(lower);
    visit(upper);
  }

  void scan(const VoxelBox& box, const ScaleField& here) {
    const ScaleLattice lattice = here.sample(frame_, box);
    for (std::int32_t z = box.min.z; z < box.max.z; z += kScaleStep) {
      for (std::int32_t y = box.min.y; y < box.max.y; y += kScaleStep) {
        for (std::int32_t x = box.min.x; x < box.max.x; x += kScaleStep) {
          const VoxelBox cell{{x, y, z}, {x + kScaleStep, y + kScaleStep, z + kScaleStep}};
          raise(distance(tile_, cell), reach_of(detail::scale_range(lattice, cell).max));
        }
      }
    }
  }

  struct Ball {
    Vec3d centre{};
    double radius = 0;
  };
  [[nodiscard]] Ball around(const VoxelBox& box) const {
    const std::int64_t unit = kLatticePerVoxel;
    const Vec3d a = frame_.world({box.min.x * unit, box.min.y * unit, box.min.z * unit}),
                b = frame_.world({box.max.x * unit, box.max.y * unit, box.max.z * unit});
    return {0.5 * (a + b), length(b - a) / 2};
  }

  const VoxelBox& tile_;
  const ScaleField& field_;
  const GridFrame& frame_;
  std::int32_t found_ = 0;
};

}  // namespace

Halo halo_of(const VoxelBox& tile, const ScaleField& scale, const GridFrame& frame, const ClosingParams& params) {
  Halo halo;
  halo.erosion_vox = ErosionReach(tile, scale, frame).find() + 1;
  const Scale largest =
      scale.constant() ? scale.upper_bound(frame) : scale.sample(frame, tile.grown(halo.erosion_vox)).max;
  halo.dilation_vox = element_reach(largest, params);
  return halo;
}

std::int32_t element_reach(Scale s, const ClosingParams& params) {
  return std::max({cube_radius(s), reach_of(s), params.turned() ? oriented_reach(*params.orientation, s) : 0});
}

}  // namespace bp
