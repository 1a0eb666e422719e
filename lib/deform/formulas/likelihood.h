#pragma once
// Maximum likelihood coordinates, after [CDH23]: of all positive coordinates of a point the most likely ones. The cage
// is projected to the unit sphere around the point, and smoothed: each triangle becomes one place m in it, where its
// mean vector meets it. A direction d meets a triangle, and m . d > 0 for this one, since the mean of directions in a
// set that is star-shaped around d is the integral of sin^2 / 2 of its radii. So the point lies between the places,
// however concave the cage is. The f with sum f = 1, sum f m = 0 and the largest product of f^w is f = w / (1 + p . m)
// with the vector p that minimizes -sum w log(1 + p . m): Newton's method in three unknowns, with a search along each
// step. [CDH23] has no w, and other places. Here w is the sum of the mean value weights of a face: so faces at the
// point count for all others, as they must on a cage that is concave, and in a convex cage the coordinates are nearly
// mean value coordinates. It goes as a square to 0 where the face turns its back, for a smooth way there.
#include "lib/deform/formulas/mean_value.h"

namespace bp::detail {

/// Gives s.faces their shares of mean value weights, as face_shares() computes them.
template <class Real>
BP_FORMULA void take_face_shares(const CageView& cage, auto& s, auto& near) {
  for (std::uint32_t i = 0; i < cage.face_count; ++i) {
    MeanFace<Real> f{};
    face_shares<Real>(cage.faces[i], s, f.share, near);
    s.faces.put(i, f);
  }
}

/// Turns shares of mean value weights into the places m and the weights w of the text above.
template <class Real>
BP_FORMULA void take_middles(const CageView& cage, auto& s) {
  constexpr double kSoft = 0.05;  // of a face's squared edges; a face seen at a right angle has 9 times that
  const Real zero{};
  Real all{};
  for (std::uint32_t i = 0; i < cage.face_count; ++i) {
    MeanFace<Real> out = s.faces.get(i);
    const Real sum = out.share[0] + out.share[1] + out.share[2];
    Real soft{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& across = s.edges.get(cage.faces[i].edge[k]).across;
      soft += kSoft * BP_DOT(across, across);
    }
    out.middle = Vec<Real>{};
    Real positive{};
    for (std::size_t k = 0; k < 3; ++k) {
      Real& share = out.share[k];
      share = sum < 0.0 ? -share : share;
      share = share > 0.0 ? share : zero;  // rounding may give another sign
      positive += share;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& u = s.vertices.get(cage.faces[i].corner[k]).toward;
      out.share[k] /= positive > 0.0 ? positive : positive + 1.0;
      out.middle.x += out.share[k] * u.x, out.middle.y += out.share[k] * u.y, out.middle.z += out.share[k] * u.z;
    }
    Real size = sum * sum + soft * soft;  // soft depends on the edges, which do not shrink as the face turns
    root(size);
    out.prior = sum * sum / size;
    all += out.prior;
    s.faces.put(i, out);
  }
  for (std::uint32_t i = 0; i < cage.face_count; ++i) {
    MeanFace<Real> f = s.faces.get(i);
    f.prior /= all;
    s.faces.put(i, f);
  }
}

/// Computes the step of Newton's method at p. `size` is its square by the Hessian.
template <class Real>
BP_FORMULA void newton_step(const CageView& cage, const auto& s, const Vec<Real>& p, Vec<Real>& step, Real& size) {
  constexpr double kLeast = 1e-15;  // share of a diagonal of the Hessian
  Vec<Real> g{};
  Real xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
  for (std::uint32_t i = 0; i < cage.face_count; ++i) {
    const auto& f = s.faces.get(i);
    const Real per = 1.0 / (1.0 + BP_DOT(p, f.middle));
    const Real x = f.middle.x * per, y = f.middle.y * per, z = f.middle.z * per;
    const Real wx = f.prior * x, wy = f.prior * y, wz = f.prior * z;
    g.x += wx, g.y += wy, g.z += wz;
    xx += wx * x, xy += wx * y, xz += wx * z, yy += wy * y, yz += wy * z, zz += wz * z;
  }
  // This is Cholesky's way: digits depend on the matrix alone, not on how it is stretched.
  const Real xy1 = xy / xx, xz1 = xz / xx;
  Real y2 = yy - xy1 * xy;
  y2 = y2 > kLeast * yy ? y2 : kLeast * yy;
  const Real yz1 = (yz - xy1 * xz) / y2;
  Real z2 = zz - xz1 * xz - yz1 * (yz - xy1 * xz);
  z2 = z2 > kLeast * zz ? z2 : kLeast * zz;
  const Real gy = g.y - xy1 * g.x, gz = g.z - xz1 * g.x - yz1 * gy;
  step.z = gz / z2;
  step.y = gy / y2 - yz1 * step.z;
  step.x = g.x / xx - xy1 * step.y - xz1 * step.z;
  size = BP_DOT(step, g);
}

/// `most`: the place along a step where the first 1 + p . m is nearly 0. `change`: the largest share by which one of
/// them changes.
template <class Real>
BP_FORMULA void range_of(const CageView& cage, const auto& s, const Vec<Real>& p, const Vec<Real>& step, Real& most,
                         Real& change) {
  constexpr double kMostOfRange = 0.99;  // of a step
  Real down{}, up{};
  for (std::uint32_t i = 0; i < cage.face_count; ++i) {
    const auto& middle = s.faces.get(i).middle;
    const Real slope = BP_DOT(step, middle) / (1.0 + BP_DOT(p, middle));
    down = slope < down ? slope : down;
    up = slope > up ? slope : up;
  }
  most = kMostOfRange / (1e-9 - down);
  change = up > -down ? up : -down;
}

/// Returns how far to go along a step: about where the sum is least.
template <class Real>
BP_FORMULA void search(const CageView& cage, const auto& s, const Vec<Real>& p, const Vec<Real>& step, const Real& most,
                       Real& far) {
  constexpr int kSearch = 3;
  for (int k = 0; k < kSearch; ++k) {
    Real first{}, second{};
    for (std::uint32_t i = 0; i < cage.face_count; ++i) {
      const auto& f = s.faces.get(i);
      const Real slope = BP_DOT(step, f.middle), at = slope / (1.0 + BP_DOT(p, f.middle) + far * slope);
      first += f.prior * at;
      second += f.prior * at * at;
    }
    const Real next = far + first / second, least = 0.25 * far;
    far = next < least ? least : next > most ? most : next;
  }
}

/// Computes the coordinates from the faces of take_middles() as s.sums, not divided by their sum; none is negative.
/// `going`: the points that want coordinates; the numbers of the others are undefined.
template <class Real>
BP_FORMULA void likelihood_formula(const CageView& cage, auto going, auto& s) {
  constexpr int kMostSteps = 60;
  constexpr double kClose = 0.02;     // share of a change: below it whole steps are taken
  constexpr double kDone = 1e-6;      // share of a change: the step after it is beyond rounding
  constexpr double kNothing = 1e-24;  // square of a step by the Hessian: no weight changes by more than its root
  Vec<Real> p{}, step{};
  const Real one = Real{} + 1.0;
  for (int i = 0; i < kMostSteps && Numbers<Real>::any(going); ++i) {
    Real size, most, change, far;
    newton_step<Real>(cage, s, p, step, size);
    range_of<Real>(cage, s, p, step, most, change);
    const auto close = change < kClose;
    far = most < 1.0 ? most : one;
    if (Numbers<Real>::any(going & (close == 0))) search<Real>(cage, s, p, step, most, far);
    far = close ? one : far;
    p.x = going ? p.x + far * step.x : p.x;
    p.y = going ? p.y + far * step.y : p.y;
    p.z = going ? p.z + far * step.z : p.z;
    going &= (change > kDone) & (size > kNothing);
  }
  for (std::uint32_t i = 0; i < cage.vertex_count; ++i) s.sums.put(i, Real{});
  for (std::uint32_t i = 0; i < cage.face_count; ++i) {
    const auto& f = s.faces.get(i);
    const Real part = f.prior / (1.0 + BP_DOT(p, f.middle));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = cage.faces[i].corner[k];
      s.sums.put(v, s.sums.get(v) + part * f.share[k] * s.vertices.get(v).per_length);
    }
  }
}

}  // namespace bp::detail
