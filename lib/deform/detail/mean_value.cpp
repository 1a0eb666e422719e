// Mean value coordinates of closed triangle meshes ([JSW05]), by the mean vectors of [FKR05]: the mean vector of a face
// is half the sum of the normals of the planes through the point and an edge, each times the angle of that edge. It is
// a combination of the unit vectors to the corners, and these factors over the distances are the weights. The mean
// vectors of a closed mesh cancel out, edge by edge, which is why the weights reproduce linear functions. Each edge is
// computed once for both its faces, and cancels to the bit. [JSW05] takes the factors from angles alone; that loses all
// digits near the plane of a face.
#include "lib/deform/detail/mean_value.h"

#include <cmath>
#include <functional>
#include <vector>

namespace bp::detail {

namespace {

constexpr double kNear = kNearCage;

BP_INLINE void cross_wide(const WideVec& a, const WideVec& b, WideVec& out) {
  out.x = a.y * b.z - a.z * b.y;
  out.y = a.z * b.x - a.x * b.z;
  out.z = a.x * b.y - a.y * b.x;
}

BP_INLINE void take_vertices(const Cage& cage, const WideVec& points, CoordinateScratch& scratch, WideBits& near) {
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

BP_INLINE void take_edges(const Cage& cage, CoordinateScratch& scratch, WideBits& near) {
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

BP_INLINE void take_face(const Cage::Face& face, CoordinateScratch& scratch, WideBits& near) {
  Wide share[3];
  face_shares(face, scratch, share, near);
  for (std::size_t i = 0; i < 3; ++i) scratch.vertices[face.corner[i]].sum += share[i];
}

}  // namespace

BP_WIDE_CLONES unsigned mean_value_weights(const Cage& cage, const WideVec& points, CoordinateScratch& scratch,
                                           Wide& total) {
  scratch.vertices.resize(cage.vertices.size());
  scratch.edges.resize(cage.edges.size());
  WideBits near{};
  total = Wide{};
  take_vertices(cage, points, scratch, near);
  take_edges(cage, scratch, near);
  for (const Cage::Face& face : cage.faces) take_face(face, scratch, near);
  for (CoordinateScratch::Vertex& v : scratch.vertices) {
    v.sum *= v.per_length;
    total += v.sum;
  }
  return bits_of(near);
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

void each_face_slowly(const Cage& cage, const Vec3d& point, std::span<long double> lengths,
                      const std::function<void(std::size_t, const RealVec&)>& take) {
  constexpr Real kFlat = 1e-15L;
  std::vector<RealVec> toward(cage.vertices.size());
  for (std::size_t i = 0; i < toward.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) toward[i][k] = Real(cage.vertices[i][k]) - Real(point[k]);
    lengths[i] = std::sqrt(dot(toward[i], toward[i]));
    for (Real& x : toward[i]) x /= lengths[i];
  }
  for (std::size_t f = 0; f < cage.faces.size(); ++f) {
    const Cage::Face& face = cage.faces[f];
    RealVec normal[3], mean{};
    for (std::size_t i = 0; i < 3; ++i) {
      const RealVec &a = toward[face.corner[(i + 1) % 3]], &b = toward[face.corner[(i + 2) % 3]];
      normal[i] = cross(a, b);
      const RealVec part = mean_of(a, b, normal[i]);
      for (std::size_t k = 0; k < 3; ++k) mean[k] += part[k];
    }
    const Real height = dot(normal[0], toward[face.corner[0]]);
    const bool flat = std::abs(height) < kFlat;
    RealVec shares{};
    for (std::size_t i = 0; i < 3 && !flat; ++i) shares[i] = dot(normal[i], mean) / height;
    take(f, shares);
  }
}

}  // namespace

void mean_value_weights_slowly(const Cage& cage, const Vec3d& point, std::span<double> weights) {
  std::vector<Real> lengths(cage.vertices.size()), total(cage.vertices.size());
  each_face_slowly(cage, point, lengths, [&](std::size_t f, const RealVec& shares) {
    for (std::size_t i = 0; i < 3; ++i) total[cage.faces[f].corner[i]] += shares[i];
  });
  for (std::size_t i = 0; i < total.size(); ++i) weights[i] = double(total[i] / lengths[i]);
}

void face_shares_slowly(const Cage& cage, const Vec3d& point, std::size_t lane, CoordinateScratch& scratch) {
  std::vector<Real> lengths(cage.vertices.size());
  each_face_slowly(cage, point, lengths, [&](std::size_t f, const RealVec& shares) {
    for (std::size_t i = 0; i < 3; ++i) scratch.faces[f].share[i][int(lane)] = double(shares[i]);
  });
}

}  // namespace bp::detail
