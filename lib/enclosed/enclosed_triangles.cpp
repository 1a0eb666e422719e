#include "lib/enclosed/enclosed_triangles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/enclosed/detail/clear_space.h"
#include "lib/enclosed/detail/swept_solid.h"
#include "lib/enclosed/detail/triangle_samples.h"
#include "lib/exact/triangle_intersection.h"
#include "lib/exact/triangle_part.h"
#include "lib/geometry/apart.h"

namespace bp {

namespace {

constexpr std::int64_t kTrianglesAtOnce = 4096;

// A face keeps this share of a voxel from a rounded triangle in addition to its error, so that a check in doubles can
// tell. The surface of the voxels, where tightening begins, leaves more (fixed_slack()).
constexpr double kKept = 0x1p-24;

LatticeBox box_of(std::span<const NewFace> star, std::span<const Tetrahedron> swept) {
  LatticeBox box{star[0].corners[0], star[0].corners[0]};
  for (const NewFace& f : star) {
    for (const LatticeCoord& p : f.corners) box.add(p);
  }
  for (const Tetrahedron& t : swept) {
    for (const LatticeCoord& p : t) box.add(p);
  }
  return box;
}

/// Returns the plane of a face. A box strictly on the inner side meets neither the face nor a tetrahedron that the face
/// closes towards the inside.
BoxTree::Plane plane_of(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
  return {a, to_double(normal_of(a, b, c))};
}

}  // namespace

/// Returns a lattice box that surely holds the triangle, and what faces keep from it: to_voxels errs by less than 2^-20
/// voxel.
LatticeBox EnclosedTriangles::box_around(const TriangleD& t) const {
  const auto room = std::int64_t(std::ceil(kept_from_all_));
  LatticeBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d at = frame_.to_lattice(t[k]);
    LatticeCoord low, high;
    for (int i = 0; i < 3; ++i) {
      low[i] = std::int64_t(std::floor(at[std::size_t(i)])) - 1;
      high[i] = low[i] + 3;
    }
    if (k == 0) box = {low, high};
    box.add(low);
    box.add(high);
  }
  return box.grown(room);
}

/// Returns the smallest lattice box that surely has the point strictly inside, wherever it lies in its file.
LatticeBox EnclosedTriangles::box_around(const Vec3d& p) const {
  constexpr double kSlack = 0x1p-13;  // to_voxels errs by less than 2^-20 voxel
  const Vec3d at = frame_.to_lattice(p);
  const double slack = kSlack + (kept_from_all_ > 0 ? kept_from({p, p, p}) / frame_.voxel * kLatticePerVoxel : 0);
  LatticeBox box;
  for (int i = 0; i < 3; ++i) {
    box.min[i] = std::int64_t(std::floor(at[std::size_t(i)] - slack));
    box.max[i] = std::int64_t(std::ceil(at[std::size_t(i)] + slack));
  }
  return box;
}

/// Returns the distance that faces keep from the triangle, scene units.
double EnclosedTriangles::kept_from(const TriangleD& t) const {
  return rounding_.any() ? rounding_.of(t) + kKept * frame_.voxel : 0;
}

EnclosedTriangles::EnclosedTriangles(std::vector<TriangleD> triangles, const GridFrame& frame,
                                     const std::optional<Bounds3d>& within, const Rounding& rounding)
    : frame_(frame), within_(within), rounding_(rounding) {
  if (rounding.any()) {
    for (const TriangleD& t : triangles) kept_from_all_ = std::max(kept_from_all_, kept_from(t));
    kept_from_all_ *= kLatticePerVoxel / frame.voxel;
  }
  const std::vector<Vec3d> middles = within ? cut_to(*within, triangles) : std::vector<Vec3d>{};
  std::vector<LatticeBox> boxes(triangles.size());
  std::vector<std::uint32_t> items(triangles.size());
  parallel_ranges(std::int64_t(triangles.size()), kTrianglesAtOnce, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
      boxes[i] = box_around(triangles[i]);
      items[i] = std::uint32_t(i);
    }
  });
  if (!boxes.empty()) bounds_ = boxes[0];
  for (const LatticeBox& box : boxes) {
    bounds_.add(box.min);
    bounds_.add(box.max);
  }
  tree_.build(boxes, std::move(items));
  triangles_.resize(triangles.size());
  middles_.resize(middles.size());
  eights_.assign((triangles.size() + 7) / 8, {});
  no_area_.assign(eights_.size(), 0);
  std::vector<double> reach(triangles.size() / kTrianglesAtOnce + 1, 0);
  static_assert(kTrianglesAtOnce % 8 == 0);
  parallel_ranges(std::int64_t(triangles.size()), kTrianglesAtOnce, [&](std::int64_t begin, std::int64_t end) {
    double farthest = 0;
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
      triangles_[i] = triangles[tree_.order()[i]];
      if (within_) middles_[i] = middles[tree_.order()[i]];
      farthest = std::max(farthest, set_corners(i));
    }
    reach[std::size_t(begin / kTrianglesAtOnce)] = farthest;
  });
  reach_ = *std::max_element(reach.begin(), reach.end());
  samples_ = all_samples();
}

/// Keeps the triangles that have a part in the box; returns the middles of these parts, lattice units.
std::vector<Vec3d> EnclosedTriangles::cut_to(const Bounds3d& within, std::vector<TriangleD>& triangles) const {
  std::vector<Vec3d> middles;
  std::erase_if(triangles, [&](const TriangleD& t) {
    const TrianglePart part(t, within);
    if (!part.empty()) middles.push_back(frame_.to_lattice(part.middle()));
    return part.empty();
  });
  return middles;
}

/// Sets the rounded corners of triangle i; returns the largest coordinate.
double EnclosedTriangles::set_corners(std::size_t i) {
  const Vec3d base = to_double(tree_.base());
  double farthest = 0;
  const TriangleD& t = triangles_[i];
  if (collinear(t[0], t[1], t[2])) no_area_[i / 8] |= std::uint8_t(1u << i % 8);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d p = frame_.to_lattice(t[k]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double at = p[axis] - base[axis];
      farthest = std::max(farthest, std::abs(at));
      eights_[i / 8].corners[k][axis][i % 8 / 4][i % 4] = float(at);
    }
  }
  return farthest;
}

/// The space that a change sweeps: a new face, or a tetrahedron, or a tetrahedron that the face closes towards the
/// inside.
class EnclosedTriangles::Swept {
 public:
  Swept(const EnclosedTriangles& all, const NewFace* face, const std::optional<Solid>& solid)
      : all_(all), solid_(solid), has_face_(face != nullptr) {
    const Tetrahedron t = solid ? solid->lattice() : Tetrahedron{};
    corners_ = has_face_ ? face->corners : std::array<LatticeCoord, 3>{t[0], t[2], t[1]};
    for (std::size_t k = 0; k < 3; ++k) {
      world_[k] = all.frame_.world(corners_[k]);
      body_[k] = to_double(corners_[k] - all.tree_.base());
    }
    body_[3] = solid ? to_double(t[3] - all.tree_.base()) : body_[0];
    inwards_ = beyond(-1.0 * normal(), body_, all.reach_, all.kept_from_all_);
  }

  [[nodiscard]] LatticeBox box() const {
    LatticeBox box = box_of(corners_[0], corners_[1], corners_[2]);
    if (solid_) box.add(solid_->lattice()[3]);
    return box;
  }
  [[nodiscard]] BoxTree::Plane plane() const { return plane_of(corners_[0], corners_[1], corners_[2]); }

  /// Returns the bits of those triangles, among `asked`, that are surely clear of the swept space.
  [[nodiscard]] std::uint32_t clear(const EightTriangles& eight, std::uint32_t asked) {
    std::uint32_t clear = inwards_.holds(eight, 2);
    if ((asked & ~clear) == 0) return clear;
    std::uint32_t of_face = has_face_ ? 0 : ~0u, of_solid = solid_ ? 0 : ~0u;
    for (std::size_t k = 0; has_face_ && k < 3 && (asked & ~clear & ~of_face) != 0; ++k)
      of_face |= beside_face(k).holds(eight, 2);
    const std::size_t last = all_.within_ ? 2 : 0;  // the first corner need not be of the part
    for (std::size_t k = 0; solid_ && k < 3 && (asked & ~clear & of_face & ~of_solid) != 0; ++k)
      of_solid |= beside_solid(k).holds(eight, last);
    return clear | (of_face & of_solid);
  }

  /// Tests triangle i. Exact; for a part of a triangle, or a rounded one, it may return true for one that is clear.
  [[nodiscard]] bool meets(std::size_t i) {
    const TriangleD& t = all_.triangles_[i];
    if (all_.rounding_.any())
      return (has_face_ && !keeps_from(t)) ||
             (solid_ && (all_.within_ ? solid_->may_hold(all_.middles_[i]) : solid_->holds(t[0])));
    const bool cut = has_face_ && (all_.has_area(i) ? triangles_intersect(t.data(), world_.data(), plane_of_face())
                                                    : degenerate_triangle_meets(t.data(), world_.data()));
    if (!all_.within_) return cut || (solid_ && solid_->holds(t[0]));
    return (cut && may_meet_within(t, world_, *all_.within_)) || (solid_ && solid_->may_hold(all_.middles_[i]));
  }

 private:
  /// Returns whether the face surely keeps the distance from a rounded triangle, or from its part.
  [[nodiscard]] bool keeps_from(const TriangleD& t) const {
    const double distance = all_.kept_from(t);
    if (are_apart(t, world_, distance)) return true;
    if (!all_.within_) return false;
    const std::vector<Vec3d> part = TrianglePart(t, *all_.within_).corners();
    for (std::size_t k = 2; k < part.size(); ++k) {
      if (!are_apart({part[0], part[k - 1], part[k]}, world_, distance + rounding_of(*all_.within_, t))) return false;
    }
    return true;
  }
  [[nodiscard]] Vec3d normal() const { return cross(body_[1] - body_[0], body_[2] - body_[0]); }

  /// Returns the half-space beyond edge k, upright on the face.
  [[nodiscard]] const ClearSpace& beside_face(std::size_t k) {
    if (k == face_sides_) {
      const Vec3d &a = body_[k], &b = body_[(k + 1) % 3];
      beside_face_[face_sides_++] = beyond(cross(b - a, normal()), {body_.data(), 3}, all_.reach_, all_.kept_from_all_);
    }
    return beside_face_[k];
  }
  /// Returns the half-space beyond the tetrahedron's other face at edge k.
  [[nodiscard]] const ClearSpace& beside_solid(std::size_t k) {
    if (k == solid_sides_) {
      const Vec3d &a = body_[k], &b = body_[(k + 1) % 3], &c = body_[(k + 2) % 3], &d = body_[3];
      const Vec3d n = cross(b - a, d - a);
      beside_solid_[solid_sides_++] = beyond(dot(n, c - a) > 0 ? -1.0 * n : n, body_, all_.reach_);
    }
    return beside_solid_[k];
  }
  [[nodiscard]] const PlaneOf<Vec3d>& plane_of_face() {
    if (!plane_) plane_.emplace(world_[0], world_[1], world_[2]);
    return *plane_;
  }

  const EnclosedTriangles& all_;
  const std::optional<Solid>& solid_;
  bool has_face_;
  std::array<LatticeCoord, 3> corners_;  // of the face
  std::array<Vec3d, 3> world_;
  std::array<Vec3d, 4> body_;  // corners of the face, then the tetrahedron's fourth corner; relative to the tree's base
  ClearSpace inwards_;
  // Half-spaces, made when they are first needed.
  std::array<ClearSpace, 3> beside_face_, beside_solid_;
  std::size_t face_sides_ = 0, solid_sides_ = 0;
  std::optional<PlaneOf<Vec3d>> plane_;
};

bool EnclosedTriangles::is_free(Swept swept, const BoxTree::Nearby* nearby, Blocker* blocker) const {
  const auto is_clear = [&](std::uint32_t first, std::uint32_t hits) {
    hits &= ~swept.clear(eights_[first / 8], hits);
    for (; hits != 0; hits &= hits - 1) {
      const std::size_t i = first + std::uint32_t(std::countr_zero(hits));
      if (!swept.meets(i)) continue;
      if (blocker != nullptr) report(i, *blocker);
      return false;
    }
    return true;
  };
  return nearby != nullptr ? tree_.query_groups(*nearby, swept.box(), swept.plane(), is_clear)
                           : tree_.query_groups(swept.box(), swept.plane(), is_clear);
}

// A triangle, or its part, which is convex too, meets neither the old faces (it was enclosed) nor, once tested, the new
// ones. So it lies wholly in one part of space that they bound together, and one of its points tells whether a
// tetrahedron that leaves the solid holds it. Nearly all triangles near a face lie wholly on its inner side: eight are
// left out at once.
//
// Many stars are refused by their first face. From the second one on, what is near the whole star is looked up once.
bool EnclosedTriangles::allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                               Blocker* blocker) const {
  thread_local BoxTree::Nearby around_star;
  const BoxTree::Nearby* nearby = nullptr;
  for (std::size_t i = 0; i < star.size(); ++i) {
    const NewFace& f = star[i];
    const auto under = std::find_if(swept.begin(), swept.end(), [&](const Tetrahedron& t) { return closes(f, t); });
    const std::optional<Solid> solid = under == swept.end() ? std::nullopt : solid_of(frame_, *under);
    if (i == 1) {
      tree_.gather(box_of(star, swept), around_star);
      nearby = around_star.complete() ? &around_star : nullptr;
    }
    if (!is_free(Swept(*this, &f, solid), nearby, blocker)) return false;
  }
  for (const Tetrahedron& t : swept) {
    if (std::any_of(star.begin(), star.end(), [&](const NewFace& f) { return closes(f, t); })) continue;
    const std::optional<Solid> solid = solid_of(frame_, t);
    if (solid && !is_free(Swept(*this, nullptr, solid), nearby, blocker)) return false;
  }
  return true;
}

void EnclosedTriangles::add_samples_of(std::size_t i, std::vector<Vec3d>& points) const {
  if (!within_) return add_samples(triangles_[i], frame_.voxel, points);
  const std::vector<Vec3d> corners = TrianglePart(triangles_[i], *within_).corners();
  for (std::size_t k = 2; k < corners.size(); ++k)
    add_samples({corners[0], corners[k - 1], corners[k]}, frame_.voxel, points);
}

/// Reports triangle i as the blocker; for a part of a triangle, three of the part's corners.
void EnclosedTriangles::report(std::size_t i, Blocker& blocker) const {
  TriangleD triangle = triangles_[i];
  if (within_) {
    const std::vector<Vec3d> corners = TrianglePart(triangle, *within_).corners();
    triangle = {corners[0], corners[corners.size() / 3], corners[corners.size() * 2 / 3]};
  }
  blocker.count = 3;
  for (std::size_t k = 0; k < 3; ++k) blocker.points[k] = frame_.to_lattice(triangle[k]);
}

void EnclosedTriangles::outer_boxes(const UseBoxes& use) const {
  constexpr std::size_t kAtOnce = 512;  // triangles per work item
  if (within_ || triangles_.empty()) return;
  std::vector<LatticeBox> boxes;
  const std::size_t step = triangles_.size() / kFirstBoxes + 1;
  for (std::size_t i = 0; i < triangles_.size(); i += step) boxes.push_back(box_around(triangles_[i][0]));
  if (!use(boxes)) return;
  for (std::size_t begin = 0; begin < triangles_.size(); begin += kAtOnce) {
    boxes.clear();
    for (std::size_t i = begin; i < std::min(begin + kAtOnce, triangles_.size()); ++i) {
      for (const Vec3d& p : triangles_[i]) boxes.push_back(box_around(p));
    }
    if (!use(boxes)) return;
  }
}

std::uint64_t EnclosedTriangles::bytes() const {
  return triangles_.size() * kBytesEach;
}

/// Returns the samples of all triangles in lattice units, each once.
std::vector<Vec3d> EnclosedTriangles::all_samples() const {
  std::vector<std::vector<Vec3d>> parts(triangles_.size() / kTrianglesAtOnce + 1);
  parallel_ranges(std::int64_t(triangles_.size()), kTrianglesAtOnce, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      add_samples_of(std::size_t(i), parts[std::size_t(begin / kTrianglesAtOnce)]);
  });
  std::size_t count = 0;
  for (const std::vector<Vec3d>& part : parts) count += part.size();
  std::vector<Vec3d> points;
  points.reserve(count);
  for (std::vector<Vec3d>& part : parts) {
    points.insert(points.end(), part.begin(), part.end());
    std::vector<Vec3d>().swap(part);
  }
  points = each_once(points);
  parallel_ranges(std::int64_t(points.size()), kSamplesAtOnce, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) points[i] = frame_.to_lattice(points[i]);
  });
  return points;
}

std::vector<Vec3d> EnclosedTriangles::contact_points(const LatticeCoord& origin, const LatticeBox& within) const {
  std::vector<Vec3d> points;
  if (within.holds(bounds_)) {
    points = samples_;
  } else {
    const auto before = [](const Vec3d& v, double x) { return v[0] < x; };
    const auto begin = std::lower_bound(samples_.begin(), samples_.end(), double(within.min.x) - 1, before);
    const auto end = std::lower_bound(begin, samples_.end(), double(within.max.x) + 1, before);
    std::copy_if(begin, end, std::back_inserter(points), [&](const Vec3d& v) {
      const LatticeCoord p = rounded(v);
      return within.holds({p, p});
    });
  }
  const Vec3d shift = to_double(origin);
  parallel_ranges(std::int64_t(points.size()), kSamplesAtOnce, [&](std::int64_t from, std::int64_t to) {
    for (auto i = std::size_t(from); i < std::size_t(to); ++i) points[i] = points[i] - shift;
  });
  return points;
}

}  // namespace bp
