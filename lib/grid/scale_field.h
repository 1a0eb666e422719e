#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "lib/core/grid_frame.h"

/// The scale field S: closing radius at each voxel. Described in scene units, sampled on a coarse lattice (one sample
/// every 8 voxels, 1/16 voxel), interpolated in integers, so that no float decides a voxel (design: docs/pipeline.md,
/// "The closing").
namespace bp {

using Scale = std::uint16_t;  ///< 1/16 voxel

enum class BrushMode : std::uint8_t { increase, decrease, erase };

/// One stroke of the brush of [CB17] Appendix A: S := mode(phi(x, S(x), target), S(x)).
struct BrushStroke {
  BrushMode mode = BrushMode::increase;
  Vec3d position{};    ///< scene units
  double support = 0;  ///< sigma, scene units
  double target = 0;   ///< s, scene units; erase ignores it and goes back to the base
  friend bool operator==(const BrushStroke&, const BrushStroke&) = default;
};

/// A box in which the scale is `scale`; later entries win over earlier ones.
struct ScaleBox {
  Vec3d min{}, max{};  ///< scene units
  double scale = 0;    ///< scene units
  friend bool operator==(const ScaleBox&, const ScaleBox&) = default;
};

/// Samples of S over a box of voxels: sample (i,j,k) is S at voxel 8 (origin + (i,j,k)).
struct ScaleLattice {
  Coord3<struct ScaleSpace, std::int32_t> origin{}, size{};  ///< in samples
  std::vector<Scale> samples;                                ///< x fastest
  Scale min = 0, max = 0;                                    ///< over the samples
  [[nodiscard]] bool constant() const { return min == max; }
  /// S at voxel p: trilinear in integers, weights 8 - f and f per axis, floor of the sum over 512.
  [[nodiscard]] Scale at(VoxelCoord p) const;
};

/// Radius of the cube, and squared-radius bound of the ball, at scale s: floor(S) and ceil(S^2) in voxels.
[[nodiscard]] BP_HD constexpr std::int32_t cube_radius(Scale s) {
  return s / kScaleOne;
}
[[nodiscard]] BP_HD constexpr std::int32_t ball_bound(Scale s) {
  return std::int32_t((std::uint32_t(s) * s + kScaleOne * kScaleOne - 1) / (kScaleOne * kScaleOne));
}

struct ScaleField {
  double base = 0;                   ///< scene units
  std::vector<BrushStroke> strokes;  ///< applied in order, after the boxes
  std::vector<ScaleBox> boxes;
  friend bool operator==(const ScaleField&, const ScaleField&) = default;

  [[nodiscard]] bool constant() const { return strokes.empty() && boxes.empty(); }
  /// S at a point, scene units: the definition, in doubles.
  [[nodiscard]] double evaluate(const Vec3d& p) const;
  /// True if S is at least `scale` all along the straight line from a to b; scene units. Decided by bounds of S over
  /// ever shorter pieces; where these do not tell for one of `shortest` or less, S at its ends does. Cost: a bound,
  /// which visits all strokes and boxes, or some per change of S along the line.
  [[nodiscard]] bool reaches_along(const Vec3d& a, const Vec3d& b, double scale, double shortest) const;
  /// Samples that interpolate S over all voxels of `box`. Depends on `box` only through its extent: tilings agree.
  [[nodiscard]] ScaleLattice sample(const GridFrame& frame, const VoxelBox& box) const;
  /// Upper bound of S anywhere, 1/16 voxel. Throws bad_argument if a scale is negative, not finite, or beyond 4095
  /// voxels.
  [[nodiscard]] Scale upper_bound(const GridFrame& frame) const;
};

/// JSON of `bpclose --field`: {"base": L, "strokes": [{"mode","position","support","target"}], "boxes":
/// [{"min","max","scale"}]}. Throws bad_input with the key at fault.
[[nodiscard]] ScaleField parse_scale_field(const std::string& json, const std::string& name);
[[nodiscard]] std::string to_json(const ScaleField& field);  ///< canonical: same field, same text

}  // namespace bp
