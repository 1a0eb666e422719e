#pragma once
// Mean value coordinates of closed triangle meshes ([JSW05]), by the mean vectors of [FKR05]: the mean vector of a face
// is half the sum of the normals of the planes through the point and an edge, each times the angle of that edge. It is
// a combination of the unit vectors to the corners, and these factors over the distances are the weights. The mean
// vectors of a closed mesh cancel out, edge by edge, which is why the weights reproduce linear functions. Each edge is
// computed once for both its faces, and cancels to the bit. [JSW05] takes the factors from angles alone; that loses all
// digits near the plane of a face.
#include "lib/deform/formulas/cage_view.h"
#include "lib/deform/formulas/numbers.h"

/// A formula's `s` keeps the numbers of one point, or of several side by side: `vertices`, `sums` by vertex, `edges`
/// and `faces`, each with get(i) and put(i, value). `near` collects whether the weights of a point are unreliable,
/// because it lies too near to the cage, or in line with too thin a face.
namespace bp::detail {

constexpr double kNearCage = 1e-9;  ///< of the diagonal, and of angles: nearer numbers are unreliable

template <class Real>
struct MeanVertex {
  Vec<Real> toward;  ///< the unit vector from the point
  Real per_length;   ///< one over the distance
};
template <class Real>
struct MeanEdge {
  Vec<Real> across;  ///< cross product of its ends' unit vectors
  Vec<Real> mean;    ///< its part of mean vectors
};
/// The numbers of a face for maximum likelihood coordinates.
template <class Real>
struct MeanFace {
  Vec<Real> middle;  ///< the mean vector's direction, between the corners on the unit sphere
  Real share[3];     ///< shares of the corners in it; they sum to 1
  Real prior;
};

template <class Real>
BP_FORMULA void take_vertices(const CageView& cage, const Vec<Real>& point, auto& s, auto& near) {
  for (std::uint32_t i = 0; i < cage.vertex_count; ++i) {
    const Vec3d& v = cage.vertices[i];
    const Vec<Real> d{v[0] - point.x, v[1] - point.y, v[2] - point.z};
    Real length = BP_DOT(d, d);
    root(length);
    near |= length < kNearCage;
    const Real one = 1.0 / (length < 1e-300 ? length + 1.0 : length);
    s.vertices.put(i, MeanVertex<Real>{{d.x * one, d.y * one, d.z * one}, one});
    s.sums.put(i, Real{});
  }
}

template <class Real>
BP_FORMULA void take_edges(const CageView& cage, auto& s, auto& near) {
  for (std::uint32_t i = 0; i < cage.edge_count; ++i) {
    const auto& a = s.vertices.get(cage.edges[i].a).toward;
    const auto& b = s.vertices.get(cage.edges[i].b).toward;
    const Vec<Real> n{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    Real sine = BP_DOT(n, n), theta;
    const Real cosine = BP_DOT(a, b);
    root(sine);
    near |= (sine < kNearCage) & (cosine < 0.0);
    angle(sine, cosine, theta);
    const Real factor = 0.5 * theta / (sine < 1e-300 ? sine + 1.0 : sine);
    s.edges.put(i, MeanEdge<Real>{n, {n.x * factor, n.y * factor, n.z * factor}});
  }
}

/// Computes the shares of a face's corners, times their distance: the factors by which the vectors to the corners
/// combine to the face's mean vector. None is negative, or none is positive. In the plane of a face, but not in the
/// face, all are 0.
template <class Real>
BP_FORMULA void face_shares(const Cage::Face& face, const auto& s, Real (&share)[3], auto& near) {
  constexpr double kMean2 = 1e-16;  // square of a mean vector that is small enough to be left out
  const auto& e0 = s.edges.get(face.edge[0]);
  const auto& e1 = s.edges.get(face.edge[1]);
  const auto& e2 = s.edges.get(face.edge[2]);
  const double s0 = face.sign[0], s1 = face.sign[1], s2 = face.sign[2];
  const Vec<Real> mean{s0 * e0.mean.x + s1 * e1.mean.x + s2 * e2.mean.x,
                       s0 * e0.mean.y + s1 * e1.mean.y + s2 * e2.mean.y,
                       s0 * e0.mean.z + s1 * e1.mean.z + s2 * e2.mean.z};
  const auto& toward = s.vertices.get(face.corner[0]).toward;
  const Real height = s0 * BP_DOT(e0.across, toward), zero{};
  const auto flat = (height < kNearCage) & (height > -kNearCage);
  near |= flat & (BP_DOT(mean, mean) > kMean2);
  const Real per = flat ? zero : 1.0 / (flat ? height + 1.0 : height);
  share[0] = s0 * per * BP_DOT(e0.across, mean);
  share[1] = s1 * per * BP_DOT(e1.across, mean);
  share[2] = s2 * per * BP_DOT(e2.across, mean);
}

/// Computes the weights of vertices as s.sums, not divided by their sum. `total` is their sum.
template <class Real>
BP_FORMULA void mean_value_formula(const CageView& cage, const Vec<Real>& point, auto& s, Real& total, auto& near) {
  take_vertices<Real>(cage, point, s, near);
  take_edges<Real>(cage, s, near);
  for (std::uint32_t f = 0; f < cage.face_count; ++f) {
    const Cage::Face& face = cage.faces[f];
    Real share[3];
    face_shares<Real>(face, s, share, near);
    for (std::size_t i = 0; i < 3; ++i) s.sums.put(face.corner[i], s.sums.get(face.corner[i]) + share[i]);
  }
  total = Real{};
  for (std::uint32_t i = 0; i < cage.vertex_count; ++i) {
    const Real sum = s.sums.get(i) * s.vertices.get(i).per_length;
    s.sums.put(i, sum);
    total += sum;
  }
}

}  // namespace bp::detail
