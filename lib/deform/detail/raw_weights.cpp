// Mean value coordinates of closed triangle meshes ([JSW05]), by the mean vectors of [FKR05]: the mean vector of a face
// is half the sum of the normals of the planes through the point and an edge, each times the angle of that edge. It is
// a combination of the unit vectors to the corners, and these factors over the distances are the weights. The mean
// vectors of a closed mesh cancel out, edge by edge, which is why the weights reproduce linear functions. Each edge is
// computed once for both its faces, and cancels to the bit. [JSW05] takes the factors from angles alone; that loses all
// digits near the plane of a face.
#include "lib/deform/detail/raw_weights.h"

#include <cmath>

namespace bp::detail {

namespace {

constexpr double kNear = 1e-9;    // of the diagonal, and of angles: nearer than this nothing is trusted
constexpr double kMean2 = 1e-16;  // square of a mean vector that may be left out

BP_INLINE void cross_wide(const WideVec& a, const WideVec& b, WideVec& out) {
  out.x = a.y * b.z - a.z * b.y;
  out.y = a.z * b.x - a.x * b.z;
  out.z = a.x * b.y - a.y * b.x;
}

BP_INLINE void take_vertices(const Cage& cage, const WideVec& points, RawScratch& scratch, WideBits& near) {
  for (std::size_t i = 0; i < cage.vertices.size(); ++i) {
    const Vec3d& v = cage.vertices[i];
    WideVec d{v[0] - points.x, v[1] - points.y, v[2] - points.z};
    Wide length = BP_DOT(d, d);
    root(length);
    near |= length < kNear;
    const Wide one = 1.0 / (length < 1e-300 ? length + 1.0 : length);
    scratch.vertices[i] = {{d.x * one, d.y * one, d.z * one}, one, Wide{}};
  }
}

BP_INLINE void take_edges(const Cage& cage, RawScratch& scratch, WideBits& near) {
  for (std::size_t i = 0; i < cage.edges.size(); ++i) {
    const WideVec &a = scratch.vertices[cage.edges[i].a].toward, &b = scratch.vertices[cage.edges[i].b].toward;
    WideVec n;
    cross_wide(a, b, n);
    Wide sine = BP_DOT(n, n), theta;
    const Wide cosine = BP_DOT(a, b);
    root(sine);
    near |= (sine < kNear) & (cosine < 0.0);
    angle(sine, cosine, theta);
    const Wide factor = 0.5 * theta / (sine < 1e-300 ? sine + 1.0 : sine);
    scratch.edges[i] = {n, {n.x * factor, n.y * factor, n.z * factor}};
  }
}

/// In the plane of a face, but not in the face, its weights are 0.
BP_INLINE void take_face(const Cage::Face& face, RawScratch& scratch, WideBits& near) {
  const RawScratch::Edge &e0 = scratch.edges[face.edge[0]], &e1 = scratch.edges[face.edge[1]],
                         &e2 = scratch.edges[face.edge[2]];
  RawScratch::Vertex &v0 = scratch.vertices[face.corner[0]], &v1 = scratch.vertices[face.corner[1]],
                     &v2 = scratch.vertices[face.corner[2]];
  const double* s = face.sign.data();
  const WideVec mean{s[0] * e0.mean.x + s[1] * e1.mean.x + s[2] * e2.mean.x,
                     s[0] * e0.mean.y + s[1] * e1.mean.y + s[2] * e2.mean.y,
                     s[0] * e0.mean.z + s[1] * e1.mean.z + s[2] * e2.mean.z};
  const Wide height = s[0] * BP_DOT(e0.across, v0.toward);
  const WideBits flat = (height < kNear) & (height > -kNear);
  near |= flat & (BP_DOT(mean, mean) > kMean2);
  const Wide zero{};
  const Wide per = flat ? zero : 1.0 / (flat ? height + 1.0 : height);
  v0.sum += s[0] * per * BP_DOT(e0.across, mean);
  v1.sum += s[1] * per * BP_DOT(e1.across, mean);
  v2.sum += s[2] * per * BP_DOT(e2.across, mean);
}

}  // namespace

BP_WIDE_CLONES unsigned raw_weights(const Cage& cage, const WideVec& points, RawScratch& scratch) {
  scratch.vertices.resize(cage.vertices.size());
  scratch.edges.resize(cage.edges.size());
  WideBits near{};
  take_vertices(cage, points, scratch, near);
  take_edges(cage, scratch, near);
  for (const Cage::Face& face : cage.faces) take_face(face, scratch, near);
  for (RawScratch::Vertex& v : scratch.vertices) v.sum *= v.per_length;
  unsigned bits = 0;
  for (int i = 0; i < kWide; ++i) bits |= unsigned(near[i] & 1) << i;
  return bits;
}

namespace {

using Real = long double;
using RealVec = std::array<Real, 3>;

Real dot(const RealVec& a, const RealVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
RealVec cross(const RealVec& a, const RealVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// An edge's part of the mean vector of a face that it runs along.
RealVec mean_of(const RealVec& a, const RealVec& b, const RealVec& normal) {
  const Real sine = std::sqrt(dot(normal, normal));
  const Real factor = sine > 0 ? std::atan2(sine, dot(a, b)) / (2 * sine) : 0;
  return {factor * normal[0], factor * normal[1], factor * normal[2]};
}

}  // namespace

void raw_weights_slowly(const Cage& cage, const Vec3d& point, std::vector<double>& sums) {
  constexpr Real kFlat = 1e-15L;
  std::vector<RealVec> toward(cage.vertices.size());
  std::vector<Real> length(cage.vertices.size()), total(cage.vertices.size());
  for (std::size_t i = 0; i < toward.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) toward[i][k] = Real(cage.vertices[i][k]) - Real(point[k]);
    length[i] = std::sqrt(dot(toward[i], toward[i]));
    for (Real& x : toward[i]) x /= length[i];
  }
  for (const Cage::Face& face : cage.faces) {
    RealVec normal[3], mean{};
    for (std::size_t i = 0; i < 3; ++i) {
      const RealVec &a = toward[face.corner[(i + 1) % 3]], &b = toward[face.corner[(i + 2) % 3]];
      normal[i] = cross(a, b);
      const RealVec part = mean_of(a, b, normal[i]);
      for (std::size_t k = 0; k < 3; ++k) mean[k] += part[k];
    }
    const Real height = dot(normal[0], toward[face.corner[0]]);
    if (std::abs(height) < kFlat) continue;
    for (std::size_t i = 0; i < 3; ++i) total[face.corner[i]] += dot(normal[i], mean) / height;
  }
  sums.resize(total.size());
  for (std::size_t i = 0; i < total.size(); ++i) sums[i] = double(total[i] / length[i]);
}

}  // namespace bp::detail
