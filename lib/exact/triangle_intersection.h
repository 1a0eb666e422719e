#pragma once
#include "lib/exact/predicates.h"

/// Exact intersection tests of closed triangles (edges and corners belong to them), for Vec3d and LatticeCoord alike.
/// Every coincidence is decided, not avoided: touching counts as meeting, however it happens. The domain is that of the
/// predicates.
namespace bp {

namespace detail {

/// Returns an axis whose removal does not flatten triangle t, which has positive area.
template <class P>
[[nodiscard]] int projection_axis(const P t[3], int& orientation) {
  for (int axis = 2; axis > 0; --axis)
    if ((orientation = orient2d(t[0], t[1], t[2], axis)) != 0) return axis;
  orientation = orient2d(t[0], t[1], t[2], 0);
  return 0;
}

/// Returns true if an edge of t has all `n` points strictly on its outer side, in the projection along `axis`.
template <class P>
[[nodiscard]] bool edge_separates(const P t[3], int orientation, int axis, const P* points, int n) {
  for (int e = 0; e < 3; ++e) {
    int outside = 0;
    while (outside < n && orient2d(t[e], t[(e + 1) % 3], points[outside], axis) == -orientation) ++outside;
    if (outside == n) return true;
  }
  return false;
}

/// Returns whether segment pq meets triangle t in the same plane. Compact convex figures in a plane are disjoint iff a
/// line along an edge of one of them leaves the other strictly on its far side.
template <class P>
[[nodiscard]] bool coplanar_segment_meets_triangle(const P& p, const P& q, const P t[3]) {
  int orientation = 0;
  const int axis = projection_axis(t, orientation);
  const P pq[2] = {p, q};
  if (edge_separates(t, orientation, axis, pq, 2)) return false;
  const int side = orient2d(p, q, t[0], axis);
  return side == 0 || orient2d(p, q, t[1], axis) != side || orient2d(p, q, t[2], axis) != side;
}

template <class P>
[[nodiscard]] bool coplanar_triangles_intersect(const P a[3], const P b[3]) {
  int orientation_a = 0, orientation_b = 0;
  const int axis = projection_axis(a, orientation_a);
  orientation_b = orient2d(b[0], b[1], b[2], axis);  // the same plane, so the axis does not flatten it either
  return !edge_separates(a, orientation_a, axis, b, 3) && !edge_separates(b, orientation_b, axis, a, 3);
}

/// Returns whether segment pq meets triangle t, given the sides of p and q of the plane of t.
template <class P>
[[nodiscard]] bool segment_meets_triangle(const P& p, const P& q, const P t[3], int side_p, int side_q) {
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) return coplanar_segment_meets_triangle(p, q, t);
  // The line pq meets the plane in one point, which is in t iff pq passes all three edges on one side.
  const int s0 = orient3d(p, q, t[0], t[1]);
  const int s1 = orient3d(p, q, t[1], t[2]);
  if (s0 * s1 < 0) return false;
  const int s2 = orient3d(p, q, t[2], t[0]);
  return s0 * s2 >= 0 && s1 * s2 >= 0;
}

template <class P>
[[nodiscard]] bool any_edge_meets(const P a[3], const P b[3], const int side_a[3]) {
  for (int e = 0; e < 3; ++e) {
    const int f = (e + 1) % 3;
    if (segment_meets_triangle(a[e], a[f], b, side_a[e], side_a[f])) return true;
  }
  return false;
}

/// Computes the sides of the corners of `a` of the plane of `b`. Returns false if all lie strictly on one side.
template <class P>
[[nodiscard]] bool reaches_plane(const P a[3], const PlaneOf<P>& b, int side[3]) {
  for (int i = 0; i < 3; ++i) side[i] = b.side(a[i]);
  return side[0] == 0 || side[0] != side[1] || side[0] != side[2];
}

/// The corner of a triangle that a plane separates from the other two, and its side. The other two do not lie on that
/// side. If the plane only touches the corner, the other two lie on one side.
struct Apart {
  int corner, side;
};
[[nodiscard]] constexpr Apart corner_apart(const int side[3]) {
  for (int i = 0; i < 3; ++i) {
    const int next = side[(i + 1) % 3], last = side[(i + 2) % 3];
    if (side[i] != 0 && side[i] * next <= 0 && side[i] * last <= 0) return {i, side[i]};
    if (side[i] == 0 && next * last > 0) return {i, -next};
  }
  return {0, 0};  // not reached if the plane meets the triangle but does not hold it
}

/// Returns whether two triangles, which meet each other's plane, meet in the line of both planes, that is, whether
/// their parts of this line meet. The triangles are turned so that each separate corner lies on the positive side of
/// the other's plane. Then each part of the line runs in the same direction, from the edge after that corner to the
/// edge before it, and orientations of corners tell which end comes first ([GD03]).
template <class P>
[[nodiscard]] bool parts_of_line_meet(const P a[3], const P b[3], const int side_a[3], const int side_b[3]) {
  const Apart in_a = corner_apart(side_a), in_b = corner_apart(side_b);
  const auto corner = [](const P t[3], int first, int k) -> const P& { return t[(first + k) % 3]; };
  // Turning the other triangle around puts the separate corner on the positive side.
  const int step_a = in_b.side > 0 ? 1 : 2, step_b = in_a.side > 0 ? 1 : 2;
  const P &pa = corner(a, in_a.corner, 0), &qa = corner(a, in_a.corner, step_a),
          &ra = corner(a, in_a.corner, 3 - step_a);
  const P &pb = corner(b, in_b.corner, 0), &qb = corner(b, in_b.corner, step_b),
          &rb = corner(b, in_b.corner, 3 - step_b);
  return orient3d(pa, qa, pb, qb) <= 0 && orient3d(pa, ra, rb, pb) <= 0;
}

}  // namespace detail

/// Returns true if segment pq (possibly a point) meets triangle t, which must have positive area.
template <class P>
[[nodiscard]] bool segment_meets_triangle(const P& p, const P& q, const P t[3]) {
  return detail::segment_meets_triangle(p, q, t, orient3d(t[0], t[1], t[2], p), orient3d(t[0], t[1], t[2], q));
}

/// Returns true if two triangles have a point in common. Both must have positive area. `plane_b` is the plane of b.
/// Takes 3 to 8 orientations, more if the triangles lie in one plane.
template <class P>
[[nodiscard]] bool triangles_intersect(const P a[3], const P b[3], const PlaneOf<P>& plane_b) {
  int side_a[3], side_b[3];
  if (!detail::reaches_plane(a, plane_b, side_a)) return false;
  if (side_a[0] == 0 && side_a[1] == 0 && side_a[2] == 0) return detail::coplanar_triangles_intersect(a, b);
  return detail::reaches_plane(b, PlaneOf<P>(a[0], a[1], a[2]), side_b) &&
         detail::parts_of_line_meet(a, b, side_a, side_b);
}
template <class P>
[[nodiscard]] bool triangles_intersect(const P a[3], const P b[3]) {
  return triangles_intersect(a, b, PlaneOf<P>(b[0], b[1], b[2]));
}

/// Returns true if a triangle of zero area (a segment, or a point) meets triangle b, which must have positive area.
template <class P>
[[nodiscard]] bool degenerate_triangle_meets(const P a[3], const P b[3]) {
  int side[3];
  return detail::reaches_plane(a, PlaneOf<P>(b[0], b[1], b[2]), side) && detail::any_edge_meets(a, b, side);
}

/// Returns true if triangles that share corner a[shared_a] == b[shared_b] have any other point in common. Seen from the
/// shared corner both are stars, so a common point lies on a ray that leaves each through its far edge, and the nearer
/// of the two exits is common to both. Hence they meet iff the far edge of one meets the other.
template <class P>
[[nodiscard]] bool triangles_meet_beyond_shared_vertex(const P a[3], int shared_a, const P b[3], int shared_b) {
  const P &a1 = a[(shared_a + 1) % 3], &a2 = a[(shared_a + 2) % 3];
  const P &b1 = b[(shared_b + 1) % 3], &b2 = b[(shared_b + 2) % 3];
  return segment_meets_triangle(a1, a2, b) || segment_meets_triangle(b1, b2, a);
}

/// Returns true if triangles (u, v, a) and (u, v, b) have any point beyond their common edge in common. That is so if
/// one is folded onto the other: they are coplanar, with both apexes on the same side of uv.
template <class P>
[[nodiscard]] bool triangles_meet_beyond_shared_edge(const P& u, const P& v, const P& a, const P& b) {
  if (orient3d(u, v, a, b) != 0) return false;
  const P t[3] = {u, v, a};
  int orientation = 0;
  const int axis = detail::projection_axis(t, orientation);
  return orient2d(u, v, b, axis) == orientation;
}

/// Returns true if two triangles, given by the indices of their corners in `points`, intersect anywhere but in the
/// corner or edge that the indices say they share. Triangles of the same three indices always meet. This is the test of
/// an embedded surface.
template <class P, class Index>
[[nodiscard]] bool triangles_meet_beyond_shared(const P* points, const std::array<Index, 3>& a,
                                                const std::array<Index, 3>& b) {
  int shared = 0, ia[3] = {}, ib[3] = {};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (a[std::size_t(i)] == b[std::size_t(j)] && shared < 3) ia[shared] = i, ib[shared] = j, ++shared;
  const P ta[3] = {points[a[0]], points[a[1]], points[a[2]]};
  const P tb[3] = {points[b[0]], points[b[1]], points[b[2]]};
  switch (shared) {
    case 0:
      return triangles_intersect(ta, tb);
    case 1:
      return triangles_meet_beyond_shared_vertex(ta, ia[0], tb, ib[0]);
    case 2:
      return triangles_meet_beyond_shared_edge(ta[ia[0]], ta[ia[1]], ta[3 - ia[0] - ia[1]], tb[3 - ib[0] - ib[1]]);
    default:
      return true;
  }
}

}  // namespace bp
