#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/grid_frame.h"

/// The scale field S: closing radius at each voxel. Described in scene units, sampled on a coarse lattice (one sample
/// every 8 voxels, 1/16 voxel), interpolated in integers, so that no float decides a voxel (design: docs/pipeline.md,
/// "The closing").
namespace bp {

using Scale = std::uint16_t;  ///< 1/16 voxel

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

/// The nearest multiple of 1/16 voxel; `scale` is in scene units and fits.
[[nodiscard]] Scale scale_of(double scale, const GridFrame& frame);

enum class ScaleMode : std::uint8_t { set, increase, decrease, erase };
enum class ScaleShape : std::uint8_t { box, path, view };

/// One rule of a scale field; lengths in scene units. With t the distance of a point to the shape, beyond `radius`,
/// and s the goal (`scale`, or the base of the field for erase), it makes of the scale S there
///   without `support`   S' = S, but at most s + slope t, and at least s - slope t
///   with `support`      S' = (1 - gamma(t)) S + gamma(t) s: a brush stroke of [CB17] Appendix A, if radius = s
///   of a view           S' = min(s, per_distance t)
/// and then: increase takes the larger of S and S', decrease the smaller one, set and erase S'.
struct ScaleRule {
  static constexpr double kNoSupport = -1;
  ScaleShape shape = ScaleShape::path;
  ScaleMode mode = ScaleMode::set;
  std::vector<Vec3d> points;    ///< of a box: min and max; else a path: one point, or straight lines from each to the
                                ///< next
  double radius = 0;            ///< the rule has its full effect so far around the shape
  double support = kNoSupport;  ///< sigma of a brush stroke; 0: the scale jumps
  double per_distance = 0;      ///< of a view
  double scale = 0;             ///< of a view: the most; erase ignores it
  std::string name;             ///< for people; may be empty
  friend bool operator==(const ScaleRule&, const ScaleRule&) = default;
};

/// In the box the scale is `scale`, and jumps at its sides.
[[nodiscard]] ScaleRule box_rule(const Vec3d& min, const Vec3d& max, double scale);
/// The brush of [CB17] Appendix A at one position; `base` is that of the field, where an erase goes back to.
[[nodiscard]] ScaleRule stroke_rule(ScaleMode mode, const Vec3d& position, double support, double target, double base);

struct ScaleField {
  double base = 0;               ///< scene units
  double slope = kDefaultSlope;  ///< the scale changes by at most so much per unit of length, but for brush strokes
  std::vector<ScaleRule> rules;  ///< applied in order
  friend bool operator==(const ScaleField&, const ScaleField&) = default;

  /// Below 1, the distance to the scene minus S has no place where it stands still: a closing has no islands.
  static constexpr double kDefaultSlope = 0.5;

  [[nodiscard]] bool constant() const { return rules.empty(); }
  /// S at a point, scene units: the definition, in doubles.
  [[nodiscard]] double evaluate(const Vec3d& p) const;
  /// S there after the base and after each rule; the last one is evaluate().
  [[nodiscard]] std::vector<double> steps(const Vec3d& p) const;

  struct Range {
    double least = 0, most = 0;
  };
  /// Bounds of S within `radius` of a point. Visits all rules.
  [[nodiscard]] Range range(const Vec3d& centre, double radius) const;
  /// The rules that may change S within `radius` of a point: evaluates to the same there, to the last bit.
  [[nodiscard]] ScaleField near(const Vec3d& centre, double radius) const;
  /// True if S is at least `scale` all along the straight line from a to b; scene units. Decided by bounds of S over
  /// ever shorter pieces; where these do not tell for one of `shortest` or less, S at its ends does. Cost: a bound,
  /// which visits all rules, or some per change of S along the line.
  [[nodiscard]] bool reaches_along(const Vec3d& a, const Vec3d& b, double scale, double shortest) const;
  /// Samples that interpolate S over all voxels of `box`. Depends on `box` only through its extent: tilings agree.
  [[nodiscard]] ScaleLattice sample(const GridFrame& frame, const VoxelBox& box) const;
  /// Upper bound of S anywhere, 1/16 voxel. Throws bad_argument if a scale is negative, not finite, or beyond 4095
  /// voxels, or another number is out of range.
  [[nodiscard]] Scale upper_bound(const GridFrame& frame) const;
  /// The base and the scales of all rules times `factor`; shapes, slope and supports stay.
  [[nodiscard]] ScaleField scaled(double factor) const;
};

/// A rule that is measured on the voxels of a scene, and becomes boxes (lib/pass/measure). Widths and thicknesses are
/// those of cubes, lib/volume/openings.h. The lengths stay where other scales are multiplied.
struct ShapeRule {
  enum class Kind : std::uint8_t {
    thickness,  ///< openings beside thin parts stay open
    gap         ///< openings stay open from a width on, narrower ones close
  };
  Kind kind = Kind::thickness;
  double length = 0;                ///< scene units: parts up to so thick are thin; openings from so wide on stay open
  double least = 0;                 ///< of thickness, scene units: no scale becomes smaller
  ScaleMode mode = ScaleMode::set;  ///< of gap; increase: only what closes, decrease: only what stays open
  std::string name;
  friend bool operator==(const ShapeRule&, const ShapeRule&) = default;
};

/// An entry of a file of rules, and the rules of the field that it becomes.
struct RuleEntry {
  std::size_t rules = 1;           ///< so many, one after the other
  std::optional<ShapeRule> shape;  ///< the entry is measured; until then it is no rule
  friend bool operator==(const RuleEntry&, const RuleEntry&) = default;
};

/// What a file of rules says. The rules of `field` are those of `entries`, in this order.
struct ScalePlan {
  ScaleField field;
  std::vector<RuleEntry> entries;
  std::string orientation{};  ///< of cubes, as JSON; may be empty
  friend bool operator==(const ScalePlan&, const ScalePlan&) = default;
};

/// What the rules of a file refer to. In streams all lengths are numbers, in scene units, and no rule names a part.
struct RuleContext {
  double diagonal = 0, voxel = 0;  ///< scene units; 0: not known, lengths are numbers only
  /// Boxes of the parts of the scene whose name or material matches; throws bad_input or bad_argument. Empty: none are
  /// known.
  std::function<std::vector<Bounds3d>(const std::string& pattern)> parts;
  /// The file may say something of the orientation of cubes.
  bool may_orient = false;
};

/// Rules as JSON (docs/bpscale.1.md). Throws bad_input with the key at fault.
[[nodiscard]] ScalePlan parse_scale_rules(const std::string& json, const std::string& name, const RuleContext& context);
/// The same of a stream's header, where nothing is left to be measured.
[[nodiscard]] ScaleField parse_scale_field(const std::string& json, const std::string& name);
[[nodiscard]] std::string to_json(const ScaleField& field);  ///< canonical: same field, same text
[[nodiscard]] std::string to_json(const ScalePlan& plan);    ///< shapes as in files, with lengths as numbers

}  // namespace bp
