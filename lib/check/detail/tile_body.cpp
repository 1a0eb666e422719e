#include "lib/check/detail/tile_body.h"

#include <algorithm>
#include <array>

#include "lib/check/detail/gap.h"
#include "lib/exact/triangle_intersection.h"
#include "lib/exact/triangle_part.h"

namespace bp {

namespace {

/// Returns the common part of two boxes that meet.
Bounds3d common(Bounds3d a, const Bounds3d& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    a.min[i] = std::max(a.min[i], b.min[i]);
    a.max[i] = std::min(a.max[i], b.max[i]);
  }
  return a;
}

}  // namespace

TileBody::TileBody(const IndexedMesh& content, std::size_t number) : number_(number) {
  CheckReport report;
  mesh_ = weld(content, 1, report);
  check_topology(mesh_, 1, report);
  surface_.emplace(mesh_);
  report.self_intersections = surface_->self_intersections(1);
  closed_ = report.closed() && report.oriented();
  if (closed_) report.inverted_components = inverted_components(mesh_, *surface_, 1);
  sound_ = report.holds();
  off_ = most_off(mesh_.points, content.rounding);
}

bool TileBody::keeps_clear(const TriangleD& t, const std::optional<Bounds3d>& cell, double scene_off, bool is_inside,
                           KnownInside& known) const {
  const double off = scene_off + off_;
  if (off == 0) return true;
  if (!cell) return keeps_gap(t, surface_->bvh(), off).answer == Answer::proven;
  if (!closed_ || !std::all_of(t.begin(), t.end(), [](const Vec3d& p) { return in_predicate_domain(p); })) return false;
  // A point in the cell was read within `scene_off` of it.
  const double growth = growth_for(*cell, t) + 2 * scene_off;
  const std::vector<Vec3d> part = TrianglePart(t, grown(*cell, growth)).corners();
  for (std::size_t k = 2; k < part.size(); ++k) {
    const GapAnswer gap = keeps_gap({part[0], part[k - 1], part[k]}, surface_->bvh(), off + rounding_of(*cell, t));
    if (gap.answer != Answer::proven) return false;
  }
  return is_inside || part.empty() || side_of_part(t, *cell, growth, known) == Side::inside;
}

TileBody::Side TileBody::side_of(const TriangleD& t, const Bounds3d& bounds, const std::optional<Bounds3d>& cell,
                                 KnownInside& known) const {
  if (!closed_ || !std::all_of(t.begin(), t.end(), [](const Vec3d& p) { return in_predicate_domain(p); }))
    return Side::undecided;
  if (!cell) return surface_->touched_by(t) != Surface::kNone ? Side::touching : side_of_point(t[0]);
  const double growth = growth_for(*cell, t);
  const Bounds3d box = grown(*cell, growth);
  const bool segment = collinear(t[0], t[1], t[2]);
  const bool touches = surface_->bvh().visit(common(bounds, box), [&](const TriangleBvh::Item& face) {
    const bool meets = segment ? degenerate_triangle_meets(t.data(), face.corners.data())
                               : triangles_intersect(t.data(), face.corners.data());
    return meets && may_meet_within(t, face.corners, box);
  });
  return touches ? Side::touching : side_of_part(t, *cell, growth, known);
}

/// Returns the side of t in the cell. No face meets t in the grown cell, so each point of t there lies on the same
/// side.
TileBody::Side TileBody::side_of_part(const TriangleD& t, const Bounds3d& cell, double growth,
                                      KnownInside& known) const {
  std::array<Vec3d, 3> corners;
  std::size_t n = 0;
  for (const Vec3d& p : t) {
    if (overlap(cell, Bounds3d{p, p})) corners[n++] = p;
  }
  if (n > 0) return side_of_corners({corners.data(), n}, known);
  for (const Vec3d& p : TrianglePart(t, grown(cell, growth / 2)).points_within()) {
    const Side side = side_near(p, rounding_of(cell, t));
    if (side != Side::undecided) return side;
  }
  return Side::undecided;
}

/// Returns the side of corners that all lie on one side. Corners that triangles of the scene share are tested once.
TileBody::Side TileBody::side_of_corners(std::span<const Vec3d> corners, KnownInside& known) const {
  const auto is_known = [&](const Vec3d& p) { return known.has(number_, p); };
  if (std::none_of(corners.begin(), corners.end(), is_known) && side_of_point(corners[0]) == Side::outside)
    return Side::outside;
  for (const Vec3d& p : corners) known.add(number_, p);
  return Side::inside;
}

/// Returns the side of a point of the triangle that lies within `radius` of `p`: that of p, if the surface is farther.
TileBody::Side TileBody::side_near(const Vec3d& p, double radius) const {
  if (surface_->bvh().nearest(p).distance_squared <= 16 * radius * radius) return Side::undecided;
  return side_of_point(p);
}

TileBody::Side TileBody::side_of_point(const Vec3d& p) const {
  return surface_->winding(p) < 1 ? Side::outside : Side::inside;
}

}  // namespace bp
