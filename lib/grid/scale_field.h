#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/grid_frame.h"

/// The scale field S: the closing radius at each voxel. It is described in scene units, sampled on a coarse lattice
/// (one sample every 8 voxels, in 1/16 voxel) and interpolated in integers, so that no float decides a voxel
/// (docs/pipeline.md, "The scale field").
namespace bp {

using Scale = std::uint16_t;  ///< 1/16 voxel

/// Samples of S over a box of voxels: sample (i,j,k) is S at voxel 8 (origin + (i,j,k)).
struct ScaleLattice {
  Coord3<struct ScaleSpace, std::int32_t> origin{}, size{};  ///< in samples
  std::vector<Scale> samples;                                ///< x fastest
  Scale min = 0, max = 0;                                    ///< over the samples
  [[nodiscard]] bool constant() const { return min == max; }
  /// Returns S at voxel p: trilinear in integers, with weights 8 - f and f per axis, and the floor of the sum over 512.
  [[nodiscard]] Scale at(VoxelCoord p) const;
};

/// Return the radius of the cube, floor(S), and the bound of squared distances of the ball, ceil(S^2), in voxels at
/// scale s.
[[nodiscard]] BP_HD constexpr std::int32_t cube_radius(Scale s) {
  return s / kScaleOne;
}
[[nodiscard]] BP_HD constexpr std::int32_t ball_bound(Scale s) {
  return std::int32_t((std::uint32_t(s) * s + kScaleOne * kScaleOne - 1) / (kScaleOne * kScaleOne));
}

/// Scales of whole voxels are a trap: the erosion, by an open ball, stops one voxel short of what a cube has added, on
/// flat sides, too. The least scale above reaches as far, and its erosion takes that layer back.
constexpr double kBeyondWholeVox = 1.0 / kScaleOne;

constexpr double kMaxScaleVoxels = 4095;  ///< Scale holds no larger one

/// Returns the nearest multiple of 1/16 voxel. `scale` is in scene units, and at most kMaxScaleVoxels voxels.
[[nodiscard]] Scale scale_of(double scale, const GridFrame& frame);

enum class ScaleMode : std::uint8_t { set, increase, decrease, erase };
enum class ScaleShape : std::uint8_t { box, path, view };

/// One rule of a scale field; lengths are in scene units. Let t be the distance of a point to the shape, beyond
/// `radius`, and s the goal (`scale`, or the base of the field for erase). The rule makes S' of the scale S there:
///   without `support`   S' = S, but at most s + slope t, and at least s - slope t
///   with `support`      S' = (1 - gamma(t)) S + gamma(t) s: a brush stroke of [CB17] Appendix A, if radius = s
///   a view              S' = min(s, per_distance t)
/// Then increase takes the larger of S and S', decrease takes the smaller one, set and erase take S'.
struct ScaleRule {
  static constexpr double kNoSupport = -1;
  ScaleShape shape = ScaleShape::path;
  ScaleMode mode = ScaleMode::set;
  /// Corners of a box, min and max; otherwise a path: one point, or straight lines from each point to the next.
  std::vector<Vec3d> points;
  double radius = 0;            ///< the rule has its full effect so far around the shape
  double support = kNoSupport;  ///< sigma of a brush stroke; 0: the scale jumps
  double per_distance = 0;      ///< of a view
  double scale = 0;             ///< of a view: the largest scale; erase ignores it
  std::string name;             ///< for people; may be empty
  friend bool operator==(const ScaleRule&, const ScaleRule&) = default;
};

/// Returns a rule by which the scale in the box is `scale`, and jumps at its sides.
[[nodiscard]] ScaleRule box_rule(const Vec3d& min, const Vec3d& max, double scale);
/// Returns the brush of [CB17] Appendix A at one position. `base` is that of the field; an erase goes back to it.
[[nodiscard]] ScaleRule stroke_rule(ScaleMode mode, const Vec3d& position, double support, double target, double base);

struct ScaleField {
  double base = 0;               ///< scene units
  double slope = kDefaultSlope;  ///< the scale changes by at most so much per unit of length, except by brush strokes
  std::vector<ScaleRule> rules;  ///< applied in order
  friend bool operator==(const ScaleField&, const ScaleField&) = default;

  /// Below 1, the distance to the scene minus S has no stationary place, so a closing has no islands.
  static constexpr double kDefaultSlope = 0.5;

  [[nodiscard]] bool constant() const { return rules.empty(); }
  /// Returns S at a point, scene units. This is the definition, in doubles.
  [[nodiscard]] double evaluate(const Vec3d& p) const;
  /// Returns S at a point after the base and after each rule. The last one is evaluate().
  [[nodiscard]] std::vector<double> steps(const Vec3d& p) const;

  struct Range {
    double least = 0, most = 0;
  };
  /// Returns bounds of S within `radius` of a point. Visits all rules.
  [[nodiscard]] Range range(const Vec3d& centre, double radius) const;
  /// Returns the rules that may change S within `radius` of a point. The result evaluates to the same there, to the
  /// last bit.
  [[nodiscard]] ScaleField near(const Vec3d& centre, double radius) const;
  /// Returns samples that interpolate S over all voxels of `box`. The extent of `box` only cuts them, so tilings agree.
  [[nodiscard]] ScaleLattice sample(const GridFrame& frame, const VoxelBox& box) const;
  /// Returns an upper bound of S anywhere, 1/16 voxel. Throws bad_argument if a scale is negative, not finite, or
  /// beyond kMaxScaleVoxels, or if another number is out of range.
  [[nodiscard]] Scale upper_bound(const GridFrame& frame) const;
  /// Returns the field with the base and the scales of all rules times `factor`. Shapes, slope and supports stay.
  [[nodiscard]] ScaleField scaled(double factor) const;
};

/// A rule that is measured on the voxels of a scene and becomes boxes (lib/pass/measure). Widths and thicknesses are
/// those of cubes (lib/volume/openings.h). Its lengths stay when other scales are multiplied.
struct ShapeRule {
  enum class Kind : std::uint8_t {
    thickness,  ///< openings beside thin parts stay open
    gap         ///< openings of some width or more stay open, narrower ones close
  };
  Kind kind = Kind::thickness;
  double length = 0;  ///< scene units: thinner parts are thin; wider openings stay open
  double least = 0;   ///< of thickness, scene units: no scale becomes smaller
  /// Used by gap. increase: only openings that close change S, decrease: only those that stay open.
  ScaleMode mode = ScaleMode::set;
  std::string name;
  friend bool operator==(const ShapeRule&, const ShapeRule&) = default;
};

/// An entry of a file of rules, and the number of rules of the field that it becomes.
struct RuleEntry {
  std::size_t rules = 1;           ///< consecutive rules of the field
  std::optional<ShapeRule> shape;  ///< the entry is to be measured; until then it is no rule
  friend bool operator==(const RuleEntry&, const RuleEntry&) = default;
};

/// The content of a file of rules. The rules of `field` are those of `entries`, in this order.
struct ScalePlan {
  ScaleField field;
  std::vector<RuleEntry> entries;
  std::string orientation{};  ///< orientation of cubes, as JSON; may be empty
  friend bool operator==(const ScalePlan&, const ScalePlan&) = default;
};

/// The scene that the rules of a file refer to. In streams all lengths are numbers in scene units, and no rule names a
/// part.
struct RuleContext {
  double diagonal = 0, voxel = 0;  ///< scene units; 0: not known, so lengths must be numbers
  /// Returns boxes of the parts of the scene whose name or material matches; throws bad_input or bad_argument. An empty
  /// function: no parts are known.
  std::function<std::vector<Bounds3d>(const std::string& pattern)> parts;
  /// True if the file may give an orientation of cubes.
  bool may_orient = false;
};

/// Parses rules as JSON (docs/bpscale.1.md). Throws bad_input with the key at fault.
[[nodiscard]] ScalePlan parse_scale_rules(const std::string& json, const std::string& name, const RuleContext& context);
/// Parses the field in a stream's header, where nothing is left to be measured. Throws likewise.
[[nodiscard]] ScaleField parse_scale_field(const std::string& json, const std::string& name);
[[nodiscard]] std::string to_json(const ScaleField& field);  ///< canonical: same field, same text
[[nodiscard]] std::string to_json(const ScalePlan& plan);    ///< shapes as in files, with lengths as numbers

/// The part of a field that matters near a place. A field may have thousands of rules, and few of them are near.
struct ScalePart {
  std::vector<std::uint32_t> rules;  ///< numbers of the rules that may change S in the ball, rising
  ScaleField::Range range;           ///< of S in the ball
};

/// Returns the part of a field in a ball, scene units. `around`: the part of a ball that holds this one; null: all
/// rules are visited.
[[nodiscard]] ScalePart part_near(const ScaleField& field, const Vec3d& centre, double radius,
                                  const ScalePart* around = nullptr);

/// Returns ScaleField::evaluate(), to the last bit, in the ball of `part`.
[[nodiscard]] double evaluate(const ScaleField& field, const ScalePart& part, const Vec3d& p);

}  // namespace bp
