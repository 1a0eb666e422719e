#pragma once
// Green coordinates ([LLC08]): the third identity of Green for the coordinates of a point, over the triangles of the
// cage. With the solid angle A of a triangle, the integrals L of 1 / distance along its edges, the height h of its
// plane above the point, and the distances d of its edges from the foot of the point, outwards:
//   face      (sum of d L - h A) / 4 pi                           the integral of 1 / 4 pi r
//   corner i  (d_i A + h sum of (out_i . out_e) L_e) / 4 pi H_i   the integral of its hat function times h / 4 pi r^3
// H_i is the height of corner i in the triangle. [LLC08] has a longer form of the same. Each root and logarithm is
// computed once for all triangles that share it.
#include "lib/deform/formulas/cage_view.h"
#include "lib/deform/formulas/numbers.h"

namespace bp::detail {

template <class Real>
struct GreenVertex {
  Real x, y, z, distance;  ///< from the point
};
template <class Real>
struct GreenEdge {
  Real inner;     ///< product of the vectors to the ends
  Real integral;  ///< of one over the distance along the edge
};

template <class Real>
BP_FORMULA void take_green_vertices(const CageView& cage, const Vec<Real>& point, auto& s, auto& near) {
  constexpr double kNear = 1e-9;  // of the diagonal
  for (std::uint32_t i = 0; i < cage.vertex_count; ++i) {
    const Vec3d& v = cage.vertices[i];
    GreenVertex<Real> out{v[0] - point.x, v[1] - point.y, v[2] - point.z, Real{}};
    out.distance = BP_DOT(out, out);
    root(out.distance);
    near |= out.distance < kNear;
    s.vertices.put(i, out);
    s.sums.put(i, Real{});
  }
}

/// Computes the integral. It is the logarithm of (a + b + length)^2 / 2 (a b + inner), with the distances a and b of
/// the ends. That sum loses its digits near the edge; the squared cross product, over a b - inner, does not.
template <class Real>
BP_FORMULA void take_green_edges(const CageView& cage, auto& s, auto& near) {
  // One plus the cosine between the ends of an edge: below it the number is unreliable.
  constexpr double kInLine = 1e-14;
  constexpr double kTiny = 1e-300;
  for (std::uint32_t i = 0; i < cage.edge_count; ++i) {
    const auto& a = s.vertices.get(cage.edges[i].a);
    const auto& b = s.vertices.get(cage.edges[i].b);
    const Real inner = a.x * b.x + a.y * b.y + a.z * b.z, product = a.distance * b.distance, less = product - inner;
    const Real x = a.y * b.z - a.z * b.y, y = a.z * b.x - a.x * b.z, z = a.x * b.y - a.y * b.x;
    const Real bent = inner < 0.0 ? (x * x + y * y + z * z) / (inner < 0.0 ? less : less + 1.0) : product + inner;
    near |= bent < kInLine * product;
    const Real all = a.distance + b.distance + cage.edge_lengths[i], twice = 2.0 * bent;
    GreenEdge<Real> out;
    out.inner = inner;
    logarithm(Real(all * all / (twice > kTiny ? twice : Real(twice * 0.0 + kTiny))), out.integral);
    s.edges.put(i, out);
  }
}

template <class Real>
BP_FORMULA void solid_angle(const Real& sine, const Real& cosine, Real& out, auto& near) {
  constexpr double kNear = 1e-9;
  const Real size = sine < 0.0 ? -sine : sine, zero{};
  near |= (cosine < 0.0) & (size < -kNear * cosine);
  angle(size, Real(size + cosine == zero ? Real(cosine + 1.0) : cosine), out);  // not both 0
  out = 2.0 * (sine < 0.0 ? -out : out);
}

template <class Real>
BP_FORMULA void take_green_face(const Cage::Face& face, const GreenFace& f, auto& s, Real& weight, auto& near) {
  const auto& a = s.vertices.get(face.corner[0]);
  const auto& b = s.vertices.get(face.corner[1]);
  const auto& c = s.vertices.get(face.corner[2]);
  const auto& e0 = s.edges.get(face.edge[0]);
  const auto& e1 = s.edges.get(face.edge[1]);
  const auto& e2 = s.edges.get(face.edge[2]);
  const Real h = f.normal[0] * a.x + f.normal[1] * a.y + f.normal[2] * a.z;
  const Real d0 = f.out[0][0] * b.x + f.out[0][1] * b.y + f.out[0][2] * b.z;
  const Real d1 = f.out[1][0] * c.x + f.out[1][1] * c.y + f.out[1][2] * c.z;
  const Real d2 = f.out[2][0] * a.x + f.out[2][1] * a.y + f.out[2][2] * a.z;
  Real solid;
  solid_angle(Real(h * f.twice_area),
              Real(a.distance * b.distance * c.distance + e0.inner * a.distance + e1.inner * b.distance +
                   e2.inner * c.distance),
              solid, near);
  const Real &l0 = e0.integral, &l1 = e1.integral, &l2 = e2.integral;
  const Real parts[3] = {f.per[0] * (d0 * solid + h * (l0 + f.angle[2] * l1 + f.angle[1] * l2)),
                         f.per[1] * (d1 * solid + h * (l1 + f.angle[2] * l0 + f.angle[0] * l2)),
                         f.per[2] * (d2 * solid + h * (l2 + f.angle[1] * l0 + f.angle[0] * l1))};
  for (std::size_t i = 0; i < 3; ++i) s.sums.put(face.corner[i], s.sums.get(face.corner[i]) + parts[i]);
  weight = f.part * (d0 * l0 + d1 * l1 + d2 * l2 - h * solid);
}

/// Computes the coordinates of vertices as s.sums, and those of faces as s.face_weights. `total` is the sum of the
/// former: the number of times that the cage winds around the point. `s` and `near` are as in
/// lib/deform/formulas/mean_value.h.
template <class Real>
BP_FORMULA void green_formula(const CageView& cage, const Vec<Real>& point, auto& s, Real& total, auto& near) {
  take_green_vertices<Real>(cage, point, s, near);
  take_green_edges<Real>(cage, s, near);
  for (std::uint32_t f = 0; f < cage.face_count; ++f) {
    Real weight;
    take_green_face<Real>(cage.faces[f], cage.green[f], s, weight, near);
    s.face_weights.put(f, weight);
  }
  total = Real{};
  for (std::uint32_t i = 0; i < cage.vertex_count; ++i) total += s.sums.get(i);
}

}  // namespace bp::detail
