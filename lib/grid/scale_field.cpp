// The scale field: a base and rules in their order, and its samples.
//
// The brush of [CB17] Appendix A has the kernel, with p the position, sigma the support and s the target of a stroke,
// and t = |x - p|:
//   phi(x, s_prev, s) = (1 - gamma(t)) s_prev + gamma(t) s
//   gamma(t) = 1 for t in [0, s[,  (1 - (t / sigma)^2)^2 for t in [s, s + sigma],  0 otherwise
// Read literally, gamma jumps at t = s, is not 0 at t = s + sigma, and exceeds 1 there when s > (sqrt 2 - 1) sigma, so
// that a stroke would overshoot its own target. We keep the three intervals and measure the middle one from its start:
//   gamma(t) = (1 - ((t - s) / sigma)^2)^2 for t in [s, s + sigma]
// which is 1 at s, 0 at s + sigma and smooth at both. Full effect reaches s because a ball of that radius is what the
// closing places at p. In erase mode the paper calls phi with s = s_base; so does the radius of full effect.
// A stroke along a path takes the distance to the path. Rules without a support are not in the paper.
//
// The scale changes by at most the slope per unit of length, because s + slope t and s - slope t do, and so do the
// larger and the smaller of two such functions.
#include "lib/grid/scale_field.h"

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

using NodeCoord = decltype(ScaleLattice::origin);
using Range = ScaleField::Range;
constexpr double kRounding = 1e-9;  // relative, of distances and scales
constexpr std::int32_t kBlock = 8;  // nodes along one side of a block whose nodes share one list of rules: 64 voxels

double distance(const Vec3d& a, const Vec3d& b) {
  return length(a - b);
}

double distance_to_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d ab = b - a;
  const double squared = dot(ab, ab);
  const double t = squared > 0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0;
  return distance(p, a + t * ab);
}

double distance_to_box(const Vec3d& p, const Vec3d& min, const Vec3d& max) {
  Vec3d d{};
  for (std::size_t i = 0; i < 3; ++i) d[i] = std::max({min[i] - p[i], p[i] - max[i], 0.0});
  return length(d);
}

/// Returns the distance from p to the shape, without the radius.
double distance_to(const ScaleRule& rule, const Vec3d& p) {
  const std::vector<Vec3d>& q = rule.points;
  if (rule.shape == ScaleShape::box) return distance_to_box(p, q[0], q[1]);
  double d = distance(p, q[0]);
  for (std::size_t i = 1; i < q.size(); ++i) d = std::min(d, distance_to_segment(p, q[i - 1], q[i]));
  return d;
}

/// Returns gamma at distance t of the shape.
double falloff(const ScaleRule& rule, double t) {
  if (t < rule.radius || t == 0) return 1;
  if (!(t < rule.radius + rule.support)) return 0;
  const double u = (t - rule.radius) / rule.support, v = 1 - u * u;
  return v * v;
}

/// Returns the scale after a rule, at distance t of its shape. It grows with the scale before. It stays between that
/// scale and the goal to the last bit, so that upper_bound() is a bound.
double applied(const ScaleField& field, const ScaleRule& rule, double t, double before) {
  const double goal = rule.mode == ScaleMode::erase ? field.base : rule.scale;
  double s = before;
  if (rule.shape == ScaleShape::view) {
    s = std::min(goal, rule.per_distance * t);
  } else if (rule.support == ScaleRule::kNoSupport) {
    const double give = field.slope * std::max(t - rule.radius, 0.0);
    s = std::max(goal - give, std::min(before, goal + give));
  } else if (const double gamma = falloff(rule, t); gamma > 0) {
    s = std::clamp((1 - gamma) * before + gamma * goal, std::min(before, goal), std::max(before, goal));
  }
  if (rule.mode == ScaleMode::increase) return std::max(s, before);
  return rule.mode == ScaleMode::decrease ? std::min(s, before) : s;
}

/// Returns the distances of the points of a ball to the shape.
Range distances_to(const ScaleRule& rule, const Vec3d& centre, double radius) {
  const double t = distance_to(rule, centre), slack = kRounding * (t + radius);
  return {std::max(t - radius - slack, 0.0), t + radius + slack};
}

/// Returns the range after a rule. As the distance grows, a rule moves scales one way: back to the scale before; a view
/// moves them upwards.
Range applied(const ScaleField& field, const ScaleRule& rule, const Range& t, const Range& s) {
  const auto at = [&](double distance, double before) { return applied(field, rule, distance, before); };
  return {std::min(at(t.least, s.least), at(t.most, s.least)), std::max(at(t.least, s.most), at(t.most, s.most))};
}

/// Returns true if the rule changes no scale of this range anywhere in the ball.
bool is_idle(const ScaleField& field, const ScaleRule& rule, const Range& t, const Range& s) {
  // The farther, the less such a rule changes.
  if (rule.shape != ScaleShape::view && rule.support == ScaleRule::kNoSupport) {
    const double goal = rule.mode == ScaleMode::erase ? field.base : rule.scale;
    const double give = field.slope * std::max(t.least - rule.radius, 0.0);
    if (goal - give <= s.least && goal + give >= s.most) return true;
  }
  for (const double distance : {t.least, t.most}) {
    for (const double before : {s.least, s.most}) {
      if (applied(field, rule, distance, before) != before) return false;
    }
  }
  return true;
}

/// Replaces the range of S in a ball by the range after a rule. Returns false if the rule changes nothing there.
bool move_range(const ScaleField& field, const ScaleRule& rule, const Vec3d& centre, double radius, Range& s) {
  const Range t = distances_to(rule, centre, radius);
  if (is_idle(field, rule, t, s)) return false;
  s = applied(field, rule, t, s);
  s = {s.least * (1 - kRounding), s.most * (1 + kRounding)};
  return true;
}

/// Calls body(rule) for each rule that may change S in the ball, in order. Returns S after the last rule.
template <class Body>
Range follow(const ScaleField& field, const Vec3d& centre, double radius, const Body& body) {
  Range s{field.base, field.base};
  for (const ScaleRule& rule : field.rules) {
    if (move_range(field, rule, centre, radius, s)) body(rule);
  }
  return s;
}

/// Returns the centre of the voxel that node `n` samples, scene units.
Vec3d node_world(const GridFrame& frame, std::int64_t x, std::int64_t y, std::int64_t z) {
  const std::int64_t step = std::int64_t(kScaleStep) * kLatticePerVoxel, half = kLatticePerVoxel / 2;
  return frame.world({x * step + half, y * step + half, z * step + half});
}

/// Returns the part of `field` that matters on these nodes.
ScaleField near_nodes(const ScaleField& field, const GridFrame& frame, NodeCoord first, NodeCoord count) {
  const Vec3d a = node_world(frame, first.x, first.y, first.z),
              b = node_world(frame, std::int64_t(first.x) + count.x - 1, std::int64_t(first.y) + count.y - 1,
                             std::int64_t(first.z) + count.z - 1);
  const Vec3d centre = 0.5 * (a + b);
  return field.near(centre, distance(centre, b));
}

/// Sets the samples [first, first + count) of the lattice.
void sample_nodes(const ScaleField& field, const GridFrame& frame, NodeCoord first, NodeCoord count,
                  ScaleLattice& lattice) {
  const NodeCoord origin = lattice.origin, size = lattice.size;
  for (std::int32_t z = first.z; z < first.z + count.z; ++z) {
    for (std::int32_t y = first.y; y < first.y + count.y; ++y) {
      Scale* row = &lattice.samples[(std::size_t(z) * std::size_t(size.y) + std::size_t(y)) * std::size_t(size.x)];
      for (std::int32_t x = first.x; x < first.x + count.x; ++x) {
        const Vec3d p =
            node_world(frame, std::int64_t(origin.x) + x, std::int64_t(origin.y) + y, std::int64_t(origin.z) + z);
        row[x] = scale_of(field.evaluate(p), frame);
      }
    }
  }
}

void check_scale(double scale, double voxel, const char* what) {
  if (!(scale >= 0) || !std::isfinite(scale))
    fail(ErrorCode::bad_argument, "a {} of {} is not a length from 0 up", what, scale);
  if (scale > kMaxScaleVoxels * voxel) {
    fail(ErrorCode::bad_argument, {Remedy::larger_voxels}, "a {} of {} is {:.0f} voxels, more than {:.0f}", what, scale,
         scale / voxel, kMaxScaleVoxels);
  }
}

void check_length(double x, const char* what) {
  if (!(x >= 0) || !std::isfinite(x)) fail(ErrorCode::bad_argument, "a {} of {} is not a length from 0 up", what, x);
}

void check_rule(const ScaleRule& rule, const ScaleField& field, double voxel) {
  check_scale(rule.scale, voxel, "scale of a rule");
  check_length(rule.radius, "radius of a rule");
  if (rule.support != ScaleRule::kNoSupport) check_length(rule.support, "support of a rule");
  if (rule.points.empty() || (rule.shape == ScaleShape::box && rule.points.size() != 2))
    fail(ErrorCode::bad_argument, "a rule of the scale field has no place");
  for (const Vec3d& p : rule.points) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      fail(ErrorCode::bad_argument, "a point of the scale field is not finite");
  }
  if (rule.shape == ScaleShape::view && rule.mode == ScaleMode::erase)
    fail(ErrorCode::bad_argument, "a view of the scale field has the mode erase");
  if (rule.shape == ScaleShape::view && !(rule.per_distance >= 0 && rule.per_distance <= field.slope))
    fail(ErrorCode::bad_argument, "a view has a scale per distance of {}, and not from 0 to {}, the slope",
         rule.per_distance, field.slope);
}

}  // namespace

Scale scale_of(double scale, const GridFrame& frame) {
  return Scale(std::floor(scale / frame.voxel * kScaleOne + 0.5));
}

ScaleRule box_rule(const Vec3d& min, const Vec3d& max, double scale) {
  ScaleRule rule;
  rule.shape = ScaleShape::box;
  rule.points = {min, max};
  rule.support = 0;
  rule.scale = scale;
  return rule;
}

ScaleRule stroke_rule(ScaleMode mode, const Vec3d& position, double support, double target, double base) {
  ScaleRule rule;
  rule.mode = mode;
  rule.points = {position};
  rule.radius = mode == ScaleMode::erase ? base : target;
  rule.support = support;
  rule.scale = target;
  return rule;
}

Scale ScaleLattice::at(VoxelCoord p) const {
  const auto cell = [](std::int32_t v, std::int32_t first) { return std::size_t(floor_div(v, kScaleStep) - first); };
  const auto fraction = [](std::int32_t v) { return std::uint32_t(v - floor_div(v, kScaleStep) * kScaleStep); };
  const std::size_t row = std::size_t(size.x), slice = row * std::size_t(size.y);
  const Scale* s = &samples[(cell(p.z, origin.z) * slice) + (cell(p.y, origin.y) * row) + cell(p.x, origin.x)];
  const std::uint32_t fx = fraction(p.x), fy = fraction(p.y), fz = fraction(p.z);
  const auto along_x = [&](const Scale* t) { return t[0] * (kScaleStep - fx) + t[1] * fx; };
  const auto along_y = [&](const Scale* t) { return along_x(t) * (kScaleStep - fy) + along_x(t + row) * fy; };
  return Scale((along_y(s) * (kScaleStep - fz) + along_y(s + slice) * fz) / (kScaleStep * kScaleStep * kScaleStep));
}

double ScaleField::evaluate(const Vec3d& p) const {
  double s = base;
  for (const ScaleRule& rule : rules) s = applied(*this, rule, distance_to(rule, p), s);
  return s;
}

ScalePart part_near(const ScaleField& field, const Vec3d& centre, double radius, const ScalePart* around) {
  ScalePart part{{}, {field.base, field.base}};
  const std::size_t count = around != nullptr ? around->rules.size() : field.rules.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t i = around != nullptr ? around->rules[k] : std::uint32_t(k);
    if (move_range(field, field.rules[i], centre, radius, part.range)) part.rules.push_back(i);
  }
  return part;
}

double evaluate(const ScaleField& field, const ScalePart& part, const Vec3d& p) {
  double s = field.base;
  for (const std::uint32_t i : part.rules) {
    const ScaleRule& rule = field.rules[i];
    s = applied(field, rule, distance_to(rule, p), s);
  }
  return s;
}

std::vector<double> ScaleField::steps(const Vec3d& p) const {
  std::vector<double> s{base};
  for (const ScaleRule& rule : rules) s.push_back(applied(*this, rule, distance_to(rule, p), s.back()));
  return s;
}

Range ScaleField::range(const Vec3d& centre, double radius) const {
  return follow(*this, centre, radius, [](const ScaleRule&) {});
}

ScaleField ScaleField::near(const Vec3d& centre, double radius) const {
  ScaleField part;
  part.base = base;
  part.slope = slope;
  follow(*this, centre, radius, [&](const ScaleRule& rule) { part.rules.push_back(rule); });
  return part;
}

ScaleLattice ScaleField::sample(const GridFrame& frame, const VoxelBox& box) const {
  (void)upper_bound(frame);  // refuses a field that cannot be sampled
  ScaleLattice lattice;
  lattice.min = lattice.max = scale_of(base, frame);
  if (box.empty()) return lattice;
  for (int axis = 0; axis < 3; ++axis) {
    lattice.origin[axis] = floor_div(box.min[axis], kScaleStep);
    lattice.size[axis] = floor_div(box.max[axis] - 1, kScaleStep) + 2 - lattice.origin[axis];
  }
  const NodeCoord origin = lattice.origin, size = lattice.size;
  lattice.samples.assign(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z), lattice.min);

  const ScaleField here = near_nodes(*this, frame, origin, size);
  if (here.constant()) return lattice;
  for (std::int32_t z0 = 0; z0 < size.z; z0 += kBlock) {
    for (std::int32_t y0 = 0; y0 < size.y; y0 += kBlock) {
      for (std::int32_t x0 = 0; x0 < size.x; x0 += kBlock) {
        const NodeCoord first{x0, y0, z0},
            count{std::min(kBlock, size.x - x0), std::min(kBlock, size.y - y0), std::min(kBlock, size.z - z0)};
        const ScaleField block = near_nodes(here, frame, origin + first, count);
        if (!block.constant()) sample_nodes(block, frame, first, count, lattice);
      }
    }
  }
  const auto [low, high] = std::minmax_element(lattice.samples.begin(), lattice.samples.end());
  lattice.min = *low;
  lattice.max = *high;
  return lattice;
}

Scale ScaleField::upper_bound(const GridFrame& frame) const {
  check_scale(base, frame.voxel, "scale");
  if (!(slope >= 0) || !std::isfinite(slope)) fail(ErrorCode::bad_argument, "a slope of {} is not from 0 up", slope);
  double bound = base;
  for (const ScaleRule& rule : rules) {
    check_rule(rule, *this, frame.voxel);
    if (rule.mode == ScaleMode::set || rule.mode == ScaleMode::increase) bound = std::max(bound, rule.scale);
  }
  return scale_of(bound, frame);
}

ScaleField ScaleField::scaled(double factor) const {
  ScaleField other = *this;
  other.base *= factor;
  for (ScaleRule& rule : other.rules) {
    rule.scale *= factor;
    rule.per_distance *= factor;
    if (rule.shape == ScaleShape::view) rule.per_distance = std::min(rule.per_distance, slope);
  }
  return other;
}

}  // namespace bp
