// The brush-based scale field of [CB17] Appendix A, and its samples.
//
// The paper's kernel, with p the position, sigma the support and s the target of a stroke, t = |x - p|:
//   phi(x, s_prev, s) = (1 - gamma(t)) s_prev + gamma(t) s
//   gamma(t) = 1 for t in [0, s[,  (1 - (t / sigma)^2)^2 for t in [s, s + sigma],  0 otherwise
// Read literally, gamma jumps at t = s, is not 0 at t = s + sigma, and exceeds 1 there when s > (sqrt 2 - 1) sigma, so
// that a stroke would overshoot its own target. We keep the three intervals and measure the middle one from its start:
//   gamma(t) = (1 - ((t - s) / sigma)^2)^2 for t in [s, s + sigma]
// which is 1 at s, 0 at s + sigma and smooth at both. Full effect reaches s because a ball of that radius is what the
// closing places at p. In erase mode the paper calls phi with s = s_base; so does the radius of full effect.
// Boxes are not in the paper: they replace the base before the first stroke.
#include "lib/grid/scale_field.h"

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

using NodeCoord = decltype(ScaleLattice::origin);
constexpr double kMaxScaleVoxels = 4095;
constexpr std::int32_t kBlock = 8;  // nodes along one side of a block that shares one culled list: 64 voxels

double goal(const BrushStroke& stroke, double base) {
  return stroke.mode == BrushMode::erase ? base : stroke.target;
}

double falloff(double t, double s, double sigma) {
  if (t < s) return 1;
  if (!(t < s + sigma)) return 0;
  const double u = (t - s) / sigma, v = 1 - u * u;
  return v * v;
}

double distance(const Vec3d& a, const Vec3d& b) {
  return length(a - b);
}

/// One stroke, of strength `gamma`. Stays between `s_prev` and the goal `s` to the last bit, so that upper_bound() is
/// one. Does not fall where s_prev rises.
double apply(BrushMode mode, double gamma, double s, double s_prev) {
  const double phi = std::clamp((1 - gamma) * s_prev + gamma * s, std::min(s_prev, s), std::max(s_prev, s));
  switch (mode) {
    case BrushMode::increase:
      return std::max(phi, s_prev);
    case BrushMode::decrease:
      return std::min(phi, s_prev);
    case BrushMode::erase:
      break;
  }
  return gamma == 0 ? s_prev : phi;
}

double apply(const BrushStroke& stroke, double base, const Vec3d& x, double s_prev) {
  const double s = goal(stroke, base);
  return apply(stroke.mode, falloff(distance(x, stroke.position), s, stroke.support), s, s_prev);
}

bool inside(const ScaleBox& box, const Vec3d& p) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(p[i] >= box.min[i] && p[i] <= box.max[i])) return false;
  }
  return true;
}

Scale quantise(double scale, double voxel) {
  return Scale(std::floor(scale / voxel * kScaleOne + 0.5));
}

/// Centre of the voxel that node `n` samples, scene units.
Vec3d node_world(const GridFrame& frame, std::int64_t x, std::int64_t y, std::int64_t z) {
  const std::int64_t step = std::int64_t(kScaleStep) * kLatticePerVoxel, half = kLatticePerVoxel / 2;
  return frame.world({x * step + half, y * step + half, z * step + half});
}

Bounds3d bounds_of_nodes(const GridFrame& frame, NodeCoord first, NodeCoord count) {
  Bounds3d bounds;
  bounds.add(node_world(frame, first.x, first.y, first.z));
  bounds.add(node_world(frame, std::int64_t(first.x) + count.x - 1, std::int64_t(first.y) + count.y - 1,
                        std::int64_t(first.z) + count.z - 1));
  return bounds;
}

/// True unless `stroke` changes nothing anywhere in `where`. The margin covers the rounding of the distances.
bool reaches(const BrushStroke& stroke, double base, const Bounds3d& where) {
  double d2 = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = std::max({where.min[i] - stroke.position[i], stroke.position[i] - where.max[i], 0.0});
    d2 += d * d;
  }
  return !(std::sqrt(d2) > (goal(stroke, base) + stroke.support) * (1 + 1e-9));
}

bool reaches(const ScaleBox& box, const Bounds3d& where) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (box.min[i] > where.max[i] || box.max[i] < where.min[i]) return false;
  }
  return true;
}

double distance_to_line(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  double along = 0, squared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    along += (p[i] - a[i]) * (b[i] - a[i]);
    squared += (b[i] - a[i]) * (b[i] - a[i]);
  }
  const double t = squared > 0 ? std::clamp(along / squared, 0.0, 1.0) : 0;
  return distance(p, {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
}

/// A lower bound of S along the line from a to b: each stroke is taken at the place that suits it worst.
double least_along(const ScaleField& field, const Vec3d& a, const Vec3d& b) {
  Bounds3d around;
  around.add(a);
  around.add(b);
  double s = field.base;
  for (const ScaleBox& box : field.boxes) {
    if (inside(box, a) && inside(box, b)) {
      s = box.scale;
    } else if (reaches(box, around)) {
      s = std::min(s, box.scale);
    }
  }
  for (const BrushStroke& stroke : field.strokes) {
    if (!reaches(stroke, field.base, around)) continue;
    const double to = goal(stroke, field.base);
    const double most = falloff(distance_to_line(stroke.position, a, b), to, stroke.support);
    const double least =
        falloff(std::max(distance(stroke.position, a), distance(stroke.position, b)), to, stroke.support);
    s = std::min(apply(stroke.mode, most, to, s), apply(stroke.mode, least, to, s));
  }
  return s;
}

/// The part of `field` that can matter in `where`; evaluates to the same there, to the last bit.
void cull(const ScaleField& field, const Bounds3d& where, ScaleField& out) {
  out.base = field.base;
  out.strokes.clear();
  out.boxes.clear();
  for (const BrushStroke& s : field.strokes) {
    if (reaches(s, field.base, where)) out.strokes.push_back(s);
  }
  for (const ScaleBox& b : field.boxes) {
    if (reaches(b, where)) out.boxes.push_back(b);
  }
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
        row[x] = quantise(field.evaluate(p), frame.voxel);
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

void check_point(const Vec3d& p, const char* what) {
  if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
    fail(ErrorCode::bad_argument, "the {} of the scale field is not finite", what);
}

}  // namespace

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
  for (auto box = boxes.rbegin(); box != boxes.rend(); ++box) {  // the last one that holds p wins
    if (!inside(*box, p)) continue;
    s = box->scale;
    break;
  }
  for (const BrushStroke& stroke : strokes) s = apply(stroke, base, p, s);
  return s;
}

bool ScaleField::reaches_along(const Vec3d& a, const Vec3d& b, double scale, double shortest) const {
  if (least_along(*this, a, b) >= scale) return true;
  const Vec3d middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  if (evaluate(middle) < scale) return false;
  if (distance(a, b) <= shortest) return evaluate(a) >= scale && evaluate(b) >= scale;
  return reaches_along(a, middle, scale, shortest) && reaches_along(middle, b, scale, shortest);
}

ScaleLattice ScaleField::sample(const GridFrame& frame, const VoxelBox& box) const {
  (void)upper_bound(frame);  // refuses what has no samples
  ScaleLattice lattice;
  lattice.min = lattice.max = quantise(base, frame.voxel);
  if (box.empty()) return lattice;
  for (int axis = 0; axis < 3; ++axis) {
    lattice.origin[axis] = floor_div(box.min[axis], kScaleStep);
    lattice.size[axis] = floor_div(box.max[axis] - 1, kScaleStep) + 2 - lattice.origin[axis];
  }
  const NodeCoord origin = lattice.origin, size = lattice.size;
  lattice.samples.assign(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z), lattice.min);

  ScaleField here, block;
  cull(*this, bounds_of_nodes(frame, origin, size), here);
  if (here.constant()) return lattice;
  for (std::int32_t z0 = 0; z0 < size.z; z0 += kBlock) {
    for (std::int32_t y0 = 0; y0 < size.y; y0 += kBlock) {
      for (std::int32_t x0 = 0; x0 < size.x; x0 += kBlock) {
        const NodeCoord first{x0, y0, z0},
            count{std::min(kBlock, size.x - x0), std::min(kBlock, size.y - y0), std::min(kBlock, size.z - z0)};
        cull(here, bounds_of_nodes(frame, origin + first, count), block);
        if (block.constant()) continue;
        sample_nodes(block, frame, first, count, lattice);
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
  double bound = base;
  for (const ScaleBox& box : boxes) {
    check_scale(box.scale, frame.voxel, "box scale");
    check_point(box.min, "box");
    check_point(box.max, "box");
    bound = std::max(bound, box.scale);
  }
  for (const BrushStroke& stroke : strokes) {
    check_scale(stroke.target, frame.voxel, "stroke target");
    check_point(stroke.position, "stroke");
    if (!(stroke.support >= 0) || !std::isfinite(stroke.support))
      fail(ErrorCode::bad_argument, "a stroke support of {} is not a length from 0 up", stroke.support);
    if (stroke.mode == BrushMode::increase) bound = std::max(bound, stroke.target);
  }
  return quantise(bound, frame.voxel);
}

}  // namespace bp
