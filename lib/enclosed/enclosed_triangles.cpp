#include "lib/enclosed/enclosed_triangles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/enclosed/detail/triangle_samples.h"
#include "lib/exact/triangle_intersection.h"
#include "lib/exact/triangle_part.h"

namespace bp {

namespace {

constexpr std::int64_t kTrianglesAtOnce = 4096;

/// Lattice box that surely holds a triangle: to_voxels errs by less than 2^-20 voxel.
LatticeBox box_around(const GridFrame& frame, const TriangleD& t) {
  LatticeBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d at = frame.to_lattice(t[k]);
    LatticeCoord low, high;
    for (int i = 0; i < 3; ++i) {
      low[i] = std::int64_t(std::floor(at[std::size_t(i)])) - 1;
      high[i] = low[i] + 3;
    }
    if (k == 0) box = {low, high};
    box.add(low);
    box.add(high);
  }
  return box;
}

/// The smallest lattice box that surely has a point strictly inside.
LatticeBox box_around(const GridFrame& frame, const Vec3d& p) {
  constexpr double kSlack = 0x1p-13;  // to_voxels errs by less than 2^-20 voxel
  const Vec3d at = frame.to_lattice(p);
  LatticeBox box;
  for (int i = 0; i < 3; ++i) {
    box.min[i] = std::int64_t(std::floor(at[std::size_t(i)] - kSlack));
    box.max[i] = std::int64_t(std::ceil(at[std::size_t(i)] + kSlack));
  }
  return box;
}

/// Boxes that lie strictly on the inner side of a face neither meet it nor a tetrahedron that it closes towards the
/// inside.
BoxTree::Plane plane_of(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
  return {a, to_double(normal_of(a, b, c))};
}

/// A closed tetrahedron, turned so that each of its four planes has the inside on its negative side: corners
/// (q, b, c, a) of a swept one, so that the plane of the first three is that of the new face.
class Solid {
 public:
  Solid(const GridFrame& frame, const Tetrahedron& lattice) : lattice_(lattice) {
    for (std::size_t i = 0; i < 4; ++i) corners_[i] = frame.world(lattice[i]);
  }
  [[nodiscard]] const Tetrahedron& lattice() const { return lattice_; }
  [[nodiscard]] bool holds(const Vec3d& p) const {  ///< exact
    const auto& [a, b, c, d] = corners_;
    return orient3d(a, b, c, p) <= 0 && orient3d(a, d, b, p) <= 0 && orient3d(b, d, c, p) <= 0 &&
           orient3d(c, d, a, p) <= 0;
  }
  /// True unless every point within 1/64 of a lattice unit of `p`, lattice units, is surely outside.
  [[nodiscard]] bool may_hold(const Vec3d& p) const {
    constexpr double kSlack = 1.0 / 64;
    const Vec3d base = to_double(lattice_[0]);
    std::array<Vec3d, 4> c;
    for (std::size_t i = 0; i < 4; ++i) c[i] = to_double(lattice_[i]) - base;
    const Vec3d point = p - base;
    const auto beyond = [&](std::size_t i, std::size_t j, std::size_t k) {
      const Vec3d n = cross(c[j] - c[i], c[k] - c[i]);
      return dot(n, point - c[i]) > kSlack * (std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]));
    };
    return !beyond(0, 1, 2) && !beyond(0, 3, 1) && !beyond(1, 3, 2) && !beyond(2, 3, 0);
  }

 private:
  Tetrahedron lattice_;
  std::array<Vec3d, 4> corners_;
};

/// A swept tetrahedron (a, b, c, q) has q on the inner side of its old face; a flat one holds nothing.
std::optional<Solid> solid_of(const GridFrame& frame, const Tetrahedron& t) {
  const int turn = orient3d(t[0], t[1], t[2], t[3]);
  if (turn == 0) return std::nullopt;
  const std::size_t second = turn > 0 ? 1 : 2;
  return Solid(frame, {t[3], t[second], t[3 - second], t[0]});
}

/// The face is the new one over a tetrahedron swept.
bool closes(const NewFace& f, const Tetrahedron& t) {
  return f.corners[0] == t[3] && f.corners[1] == t[1] && f.corners[2] == t[2];
}

}  // namespace

EnclosedTriangles::EnclosedTriangles(std::vector<TriangleD> triangles, const GridFrame& frame,
                                     const std::optional<Bounds3d>& within)
    : frame_(frame), within_(within) {
  const std::vector<Vec3d> middles = within ? cut_to(*within, triangles) : std::vector<Vec3d>{};
  std::vector<LatticeBox> boxes(triangles.size());
  std::vector<std::uint32_t> items(triangles.size());
  parallel_ranges(std::int64_t(triangles.size()), kTrianglesAtOnce, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
      boxes[i] = box_around(frame_, triangles[i]);
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

/// Keeps the triangles that have a part in the box; returns middles of the parts, lattice units.
std::vector<Vec3d> EnclosedTriangles::cut_to(const Bounds3d& within, std::vector<TriangleD>& triangles) const {
  std::vector<Vec3d> middles;
  std::erase_if(triangles, [&](const TriangleD& t) {
    const TrianglePart part(t, within);
    if (!part.empty()) middles.push_back(frame_.to_lattice(part.middle()));
    return part.empty();
  });
  return middles;
}

/// The largest coordinate.
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

namespace {

/// A half-space clear of a body: n . p > limit for a corner p as rounded. Whichever n, that proves it.
struct HalfSpace {
  std::array<float, 3> n;
  float limit;

  /// Bit k: it holds the corners of triangle k from the first to the last one asked for.
  [[nodiscard]] std::uint32_t holds(const EightTriangles& eight, std::size_t last) const {
    const auto beyond = [&](std::size_t half) {
      FourInts all{-1, -1, -1, -1};
      for (std::size_t k = 0; k <= last; ++k) {
        const auto& c = eight.corners[k];
        all &= n[0] * c[0][half] + n[1] * c[1][half] + n[2] * c[2][half] > limit;
      }
      return all;
    };
    return bits_of(beyond(0), beyond(1));
  }
};

/// `body` relative to the tree's base. Floats: each of the three terms of n . p passes through at most 6 roundings (n,
/// p, the product, two sums), the limit through 2, so with sizes of n that sum to 1 the height errs by less than 14
/// roundings of reach or limit; to_voxels by less than 2^-14 lattice units.
HalfSpace beyond(const Vec3d& direction, std::span<const Vec3d> body, double reach) {
  const double size = std::abs(direction[0]) + std::abs(direction[1]) + std::abs(direction[2]);
  if (!(size > 0)) return {{0, 0, 0}, 1};
  const Vec3d n = (1 / size) * direction;
  double limit = dot(n, body[0]);
  for (const Vec3d& p : body) limit = std::max(limit, dot(n, p));
  return {{float(n[0]), float(n[1]), float(n[2])}, float(limit + 0x1p-12 + 0x1p-20 * (reach + std::abs(limit)))};
}

}  // namespace

/// What a change sweeps: a new face, or a tetrahedron, or both, the face closing the tetrahedron towards the inside.
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
    inwards_ = beyond(-1.0 * normal(), body_, all.reach_);
  }

  [[nodiscard]] LatticeBox box() const {
    LatticeBox box = box_of(corners_[0], corners_[1], corners_[2]);
    if (solid_) box.add(solid_->lattice()[3]);
    return box;
  }
  [[nodiscard]] BoxTree::Plane plane() const { return plane_of(corners_[0], corners_[1], corners_[2]); }

  /// Bits of the triangles that are surely clear.
  [[nodiscard]] std::uint32_t clear(const EightTriangles& eight, std::uint32_t asked) {
    std::uint32_t clear = inwards_.holds(eight, 2);
    if ((asked & ~clear) == 0) return clear;
    if (!complete_) add_sides();
    const std::size_t last = all_.within_ ? 2 : 0;  // the first corner need not be of the part
    std::uint32_t of_face = has_face_ ? 0 : ~0u, of_solid = solid_ ? 0 : ~0u;
    for (std::size_t k = 0; k < 3; ++k) {
      if (has_face_) of_face |= beside_face_[k].holds(eight, 2);
      if (solid_) of_solid |= beside_solid_[k].holds(eight, last);
    }
    return clear | (of_face & of_solid);
  }

  /// Exact, or of a part on the safe side.
  [[nodiscard]] bool meets(std::size_t i) const {
    const TriangleD& t = all_.triangles_[i];
    const bool cut = has_face_ && (all_.has_area(i) ? triangles_intersect(t.data(), world_.data())
                                                    : degenerate_triangle_meets(t.data(), world_.data()));
    if (!all_.within_) return cut || (solid_ && solid_->holds(t[0]));
    return (cut && may_meet_within(t, world_, *all_.within_)) || (solid_ && solid_->may_hold(all_.middles_[i]));
  }

 private:
  [[nodiscard]] Vec3d normal() const { return cross(body_[1] - body_[0], body_[2] - body_[0]); }

  /// Upright on the face, one along each edge; the other faces of the tetrahedron.
  void add_sides() {
    complete_ = true;
    const Vec3d up = normal();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d &a = body_[k], &b = body_[(k + 1) % 3], &c = body_[(k + 2) % 3], &d = body_[3];
      if (has_face_) beside_face_[k] = beyond(cross(b - a, up), {body_.data(), 3}, all_.reach_);
      if (!solid_) continue;
      const Vec3d n = cross(b - a, d - a);
      beside_solid_[k] = beyond(dot(n, c - a) > 0 ? -1.0 * n : n, body_, all_.reach_);
    }
  }

  const EnclosedTriangles& all_;
  const std::optional<Solid>& solid_;
  bool has_face_, complete_ = false;
  std::array<LatticeCoord, 3> corners_;  // of the face
  std::array<Vec3d, 3> world_;
  std::array<Vec3d, 4> body_;  // corners of the face, then the tetrahedron's other one; relative to the tree's base
  HalfSpace inwards_;
  std::array<HalfSpace, 3> beside_face_, beside_solid_;
};

bool EnclosedTriangles::is_free(Swept swept, Blocker* blocker) const {
  return tree_.query_groups(swept.box(), swept.plane(), [&](std::uint32_t first, std::uint32_t hits) {
    hits &= ~swept.clear(eights_[first / 8], hits);
    for (; hits != 0; hits &= hits - 1) {
      const std::size_t i = first + std::uint32_t(std::countr_zero(hits));
      if (!swept.meets(i)) continue;
      if (blocker != nullptr) report(i, *blocker);
      return false;
    }
    return true;
  });
}

// A triangle, or its part, which is convex too, meets neither the old faces (it was enclosed) nor, once tested, the new
// ones. So it lies wholly in one part of space that they bound together, and one of its points tells whether a
// tetrahedron that leaves the solid holds it. Nearly all triangles near a face lie wholly on its inner side: eight are
// left out at once.
bool EnclosedTriangles::allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                               Blocker* blocker) const {
  for (const NewFace& f : star) {
    const auto under = std::find_if(swept.begin(), swept.end(), [&](const Tetrahedron& t) { return closes(f, t); });
    const std::optional<Solid> solid = under == swept.end() ? std::nullopt : solid_of(frame_, *under);
    if (!is_free(Swept(*this, &f, solid), blocker)) return false;
  }
  for (const Tetrahedron& t : swept) {
    if (std::any_of(star.begin(), star.end(), [&](const NewFace& f) { return closes(f, t); })) continue;
    const std::optional<Solid> solid = solid_of(frame_, t);
    if (solid && !is_free(Swept(*this, nullptr, solid), blocker)) return false;
  }
  return true;
}

void EnclosedTriangles::add_samples_of(std::size_t i, std::vector<Vec3d>& points) const {
  if (!within_) return add_samples(triangles_[i], frame_.voxel, points);
  const std::vector<Vec3d> corners = TrianglePart(triangles_[i], *within_).corners();
  for (std::size_t k = 2; k < corners.size(); ++k)
    add_samples({corners[0], corners[k - 1], corners[k]}, frame_.voxel, points);
}

/// Of a part, three of its corners.
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
  constexpr std::size_t kAtOnce = 512;  // triangles
  if (within_ || triangles_.empty()) return;
  std::vector<LatticeBox> boxes;
  const std::size_t step = triangles_.size() / kFirstBoxes + 1;
  for (std::size_t i = 0; i < triangles_.size(); i += step) boxes.push_back(box_around(frame_, triangles_[i][0]));
  if (!use(boxes)) return;
  for (std::size_t begin = 0; begin < triangles_.size(); begin += kAtOnce) {
    boxes.clear();
    for (std::size_t i = begin; i < std::min(begin + kAtOnce, triangles_.size()); ++i) {
      for (const Vec3d& p : triangles_[i]) boxes.push_back(box_around(frame_, p));
    }
    if (!use(boxes)) return;
  }
}

std::uint64_t EnclosedTriangles::bytes() const {
  return triangles_.size() * kBytesEach;
}

/// In lattice units, each once.
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
