// Green coordinates ([LLC08]): the third identity of Green for the coordinates of a point, over the triangles of the
// cage. With the solid angle A of a triangle, the integrals L of 1 / distance along its edges, the height h of its
// plane above the point, and the distances d of its edges from the foot of the point, outwards:
//   face      (sum of d L - h A) / 4 pi                           the integral of 1 / 4 pi r
//   corner i  (d_i A + h sum of (out_i . out_e) L_e) / 4 pi H_i   the integral of its hat function times h / 4 pi r^3
// H_i is the height of corner i in the triangle. [LLC08] has a longer form of the same. Each root and logarithm is
// computed once for all triangles that share it.
#include "lib/deform/detail/green.h"

#include <cmath>
#include <numbers>

#include "lib/core/vec3.h"

namespace bp::detail {

namespace {

constexpr double kNear = 1e-9;     // of the diagonal, and of solid angles
constexpr double kInLine = 1e-14;  // one plus the cosine between the ends of an edge: nearer nothing is trusted
constexpr double kTiny = 1e-300;
constexpr double kWhole = 4 * std::numbers::pi;

template <class Real>
BP_INLINE void take_vertices(const Cage& cage, const Real& x, const Real& y, const Real& z, GreenScratch<Real>& s,
                             auto& near) {
  for (std::size_t i = 0; i < cage.vertices.size(); ++i) {
    const Vec3d& v = cage.vertices[i];
    typename GreenScratch<Real>::Vertex& out = s.vertices[i];
    out = {v[0] - x, v[1] - y, v[2] - z, Real{}, Real{}};
    out.distance = out.x * out.x + out.y * out.y + out.z * out.z;
    root(out.distance);
    near |= out.distance < kNear;
  }
}

/// The integral is the logarithm of (a + b + length)^2 / 2 (a b + inner), with the distances a and b of the ends. That
/// sum loses its digits near the edge; the squared cross product, over a b - inner, does not.
template <class Real>
BP_INLINE void take_edges(const Cage& cage, const GreenCage& green, GreenScratch<Real>& s, auto& near) {
  for (std::size_t i = 0; i < cage.edges.size(); ++i) {
    const auto &a = s.vertices[cage.edges[i].a], &b = s.vertices[cage.edges[i].b];
    const Real inner = a.x * b.x + a.y * b.y + a.z * b.z, product = a.distance * b.distance, less = product - inner;
    const Real x = a.y * b.z - a.z * b.y, y = a.z * b.x - a.x * b.z, z = a.x * b.y - a.y * b.x;
    const Real bent = inner < 0.0 ? (x * x + y * y + z * z) / (inner < 0.0 ? less : less + 1.0) : product + inner;
    near |= bent < kInLine * product;
    const Real all = a.distance + b.distance + green.lengths[i], twice = 2.0 * bent;
    s.edges[i].inner = inner;
    logarithm(Real(all * all / (twice > kTiny ? twice : Real(twice * 0.0 + kTiny))), s.edges[i].integral);
  }
}

template <class Real>
BP_INLINE void solid_angle(const Real& sine, const Real& cosine, Real& out, auto& near) {
  const Real size = sine < 0.0 ? -sine : sine, zero{};
  near |= (cosine < 0.0) & (size < -kNear * cosine);
  angle(size, Real(size + cosine == zero ? Real(cosine + 1.0) : cosine), out);  // not both 0
  out = 2.0 * (sine < 0.0 ? -out : out);
}

template <class Real>
BP_INLINE void take_face(const Cage::Face& face, const GreenCage::Face& f, GreenScratch<Real>& s, Real& weight,
                         auto& near) {
  auto &a = s.vertices[face.corner[0]], &b = s.vertices[face.corner[1]], &c = s.vertices[face.corner[2]];
  const auto &e0 = s.edges[face.edge[0]], &e1 = s.edges[face.edge[1]], &e2 = s.edges[face.edge[2]];
  const auto along = [](const Vec3d& v, const auto& p, Real& out) { out = v[0] * p.x + v[1] * p.y + v[2] * p.z; };
  Real h, d0, d1, d2, solid;
  along(f.normal, a, h);
  along(f.out[0], b, d0);
  along(f.out[1], c, d1);
  along(f.out[2], a, d2);
  solid_angle(Real(h * f.twice_area),
              Real(a.distance * b.distance * c.distance + e0.inner * a.distance + e1.inner * b.distance +
                   e2.inner * c.distance),
              solid, near);
  const Real &l0 = e0.integral, &l1 = e1.integral, &l2 = e2.integral;
  a.sum += f.per[0] * (d0 * solid + h * (l0 + f.angle[2] * l1 + f.angle[1] * l2));
  b.sum += f.per[1] * (d1 * solid + h * (l1 + f.angle[2] * l0 + f.angle[0] * l2));
  c.sum += f.per[2] * (d2 * solid + h * (l2 + f.angle[1] * l0 + f.angle[0] * l1));
  weight = f.part * (d0 * l0 + d1 * l1 + d2 * l2 - h * solid);
}

template <class Real>
BP_INLINE void take_point(const Cage& cage, const GreenCage& green, const Real& x, const Real& y, const Real& z,
                          GreenScratch<Real>& s, auto& near) {
  s.vertices.resize(cage.vertices.size());
  s.edges.resize(cage.edges.size());
  s.faces.resize(cage.faces.size());
  take_vertices(cage, x, y, z, s, near);
  take_edges(cage, green, s, near);
  for (std::size_t i = 0; i < cage.faces.size(); ++i)
    take_face(cage.faces[i], green.faces[i], s, s.faces[i].weight, near);
}

GreenCage::Face face_of(const Cage& cage, const Cage::Face& f) {
  GreenCage::Face out;
  const auto at = [&](std::size_t i) { return cage.vertices[f.corner[i % 3]]; };
  const Vec3d normal = cross(at(1) - at(0), at(2) - at(0));
  out.twice_area = length(normal);
  if (!(out.twice_area > kTiny)) return out;
  out.normal = (1 / out.twice_area) * normal;
  out.part = 1 / kWhole;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d along = at(i + 2) - at(i + 1);
    out.out[i] = (1 / length(along)) * cross(along, out.normal);
    out.per[i] = length(along) / out.twice_area / kWhole;
  }
  for (std::size_t i = 0; i < 3; ++i) out.angle[i] = dot(out.out[(i + 1) % 3], out.out[(i + 2) % 3]);
  return out;
}

}  // namespace

GreenCage green_cage(const Cage& cage) {
  GreenCage out;
  for (const Cage::Face& f : cage.faces) out.faces.push_back(face_of(cage, f));
  for (const Cage::Edge& e : cage.edges) out.lengths.push_back(length(cage.vertices[e.b] - cage.vertices[e.a]));
  return out;
}

BP_WIDE_CLONES unsigned green_weights(const Cage& cage, const GreenCage& green, const WideVec& points,
                                      CoordinateScratch& scratch, Wide& total) {
  WideBits near{};
  take_point(cage, green, points.x, points.y, points.z, scratch.green, near);
  total = Wide{};
  for (const auto& v : scratch.green.vertices) total += v.sum;
  return bits_of(near);
}

void green_weights_slowly(const Cage& cage, const GreenCage& green, const Vec3d& point, std::span<double> weights) {
  using Real = long double;
  GreenScratch<Real> scratch;
  bool near = false;
  take_point(cage, green, Real(point[0]), Real(point[1]), Real(point[2]), scratch, near);
  std::size_t at = 0;
  for (const auto& v : scratch.vertices) weights[at++] = double(v.sum);
  for (const auto& f : scratch.faces) weights[at++] = double(f.weight);
}

}  // namespace bp::detail
