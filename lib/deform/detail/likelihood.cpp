// Maximum likelihood coordinates, after [CDH23]: of all positive coordinates of a point the most likely ones. The cage
// is projected to the unit sphere around the point, and smoothed: each triangle becomes one place m in it, where its
// mean vector meets it. A direction d meets a triangle, and m . d > 0 for this one, since the mean of directions in a
// set that is star-shaped around d is the integral of sin^2 / 2 of its radii. So the point lies between the places,
// however concave the cage is. The f with sum f = 1, sum f m = 0 and the largest product of f^w is f = w / (1 + p . m)
// with the vector p that minimizes -sum w log(1 + p . m): Newton's method in three unknowns, with a search along each
// step. [CDH23] has no w, and other places. Here w is the sum of the mean value weights of a face: so faces at the
// point count for all others, as they must on a cage that is concave, and in a convex cage the coordinates are nearly
// mean value coordinates. It goes as a square to 0 where the face turns its back, for a smooth way there.
#include "lib/deform/detail/likelihood.h"

#include <cmath>

#include "lib/deform/detail/mean_value.h"

namespace bp::detail {

namespace {

constexpr int kMostSteps = 60, kSearch = 3;
constexpr double kClose = 0.02;        // share of a change: from here on whole steps
constexpr double kDone = 1e-6;         // the same: the step after it is beyond rounding
constexpr double kNothing = 1e-24;     // square of a step, by the Hessian: no weight changes by more than its root
constexpr double kMostOfRange = 0.99;  // of a step
constexpr double kLeast = 1e-15;       // of a diagonal of the Hessian
constexpr double kSoft = 0.05;  // of the squared edges of a face, which is seen at a right angle with 9 times that

BP_INLINE void take_shares(const Cage& cage, const WideVec& points, unsigned doubtful, CoordinateScratch& s) {
  WideBits near{};
  for (std::size_t i = 0; i < cage.faces.size(); ++i) face_shares(cage.faces[i], s, s.faces[i].share, near);
  for (std::size_t k = 0; k < kWide; ++k) {
    const int lane = int(k);
    if (doubtful >> k & 1) face_shares_slowly(cage, {points.x[lane], points.y[lane], points.z[lane]}, k, s);
  }
}

BP_INLINE void take_middles(const Cage& cage, CoordinateScratch& s) {
  const Wide zero{};
  Wide all{};
  for (std::size_t i = 0; i < cage.faces.size(); ++i) {
    CoordinateScratch::Face& out = s.faces[i];
    const Wide sum = out.share[0] + out.share[1] + out.share[2];
    Wide soft{};
    for (const std::uint32_t e : cage.faces[i].edge) soft += kSoft * BP_DOT(s.edges[e].across, s.edges[e].across);
    out.middle = WideVec{};
    Wide positive{};
    for (Wide& share : out.share) {
      share = sum < 0.0 ? -share : share;
      share = share > 0.0 ? share : zero;  // rounding may give another sign
      positive += share;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const WideVec& u = s.vertices[cage.faces[i].corner[k]].toward;
      out.share[k] /= positive > 0.0 ? positive : positive + 1.0;
      out.middle.x += out.share[k] * u.x, out.middle.y += out.share[k] * u.y, out.middle.z += out.share[k] * u.z;
    }
    Wide size = sum * sum + soft * soft;  // soft: by the edges, which do not shrink as the face turns
    root(size);
    out.prior = sum * sum / size;
    all += out.prior;
  }
  for (CoordinateScratch::Face& f : s.faces) f.prior /= all;
}

/// The step of Newton's method at p; `size` is its square by the Hessian.
BP_INLINE void newton_step(const CoordinateScratch& s, const WideVec& p, WideVec& step, Wide& size) {
  WideVec g{};
  Wide xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
  for (const CoordinateScratch::Face& f : s.faces) {
    const Wide per = 1.0 / (1.0 + BP_DOT(p, f.middle));
    const Wide x = f.middle.x * per, y = f.middle.y * per, z = f.middle.z * per;
    const Wide wx = f.prior * x, wy = f.prior * y, wz = f.prior * z;
    g.x += wx, g.y += wy, g.z += wz;
    xx += wx * x, xy += wx * y, xz += wx * z, yy += wy * y, yz += wy * z, zz += wz * z;
  }
  // Cholesky's way: of the matrix only its digits count, not how it is stretched.
  const Wide xy1 = xy / xx, xz1 = xz / xx;
  Wide y2 = yy - xy1 * xy;
  y2 = y2 > kLeast * yy ? y2 : kLeast * yy;
  const Wide yz1 = (yz - xy1 * xz) / y2;
  Wide z2 = zz - xz1 * xz - yz1 * (yz - xy1 * xz);
  z2 = z2 > kLeast * zz ? z2 : kLeast * zz;
  const Wide gy = g.y - xy1 * g.x, gz = g.z - xz1 * g.x - yz1 * gy;
  step.z = gz / z2;
  step.y = gy / y2 - yz1 * step.z;
  step.x = g.x / xx - xy1 * step.y - xz1 * step.z;
  size = BP_DOT(step, g);
}

/// `most`: where along a step the first 1 + p . m is nearly 0. `change`: by what share one of them changes at most.
BP_INLINE void range_of(const CoordinateScratch& s, const WideVec& p, const WideVec& step, Wide& most, Wide& change) {
  Wide down{}, up{};
  for (const CoordinateScratch::Face& f : s.faces) {
    const Wide slope = BP_DOT(step, f.middle) / (1.0 + BP_DOT(p, f.middle));
    down = slope < down ? slope : down;
    up = slope > up ? slope : up;
  }
  most = kMostOfRange / (1e-9 - down);
  change = up > -down ? up : -down;
}

/// How far to go along a step: about where the sum is least.
BP_INLINE void search(const CoordinateScratch& s, const WideVec& p, const WideVec& step, const Wide& most, Wide& far) {
  for (int i = 0; i < kSearch; ++i) {
    Wide first{}, second{};
    for (const CoordinateScratch::Face& f : s.faces) {
      const Wide slope = BP_DOT(step, f.middle), at = slope / (1.0 + BP_DOT(p, f.middle) + far * slope);
      first += f.prior * at;
      second += f.prior * at * at;
    }
    const Wide next = far + first / second, least = 0.25 * far;
    far = next < least ? least : next > most ? most : next;
  }
}

}  // namespace

BP_WIDE_CLONES void likelihood_weights(const Cage& cage, const WideVec& points, unsigned doubtful, const Wide& total,
                                       CoordinateScratch& s) {
  s.faces.resize(cage.faces.size());
  take_shares(cage, points, doubtful, s);
  take_middles(cage, s);
  WideVec p{}, step;
  WideBits going = total > 0.0;
  for (unsigned k = 0; k < kWide; ++k) going[k] |= -(long long)(doubtful >> k & 1);
  for (int i = 0; i < kMostSteps && bits_of(going) != 0; ++i) {
    Wide size, most, change, far;
    newton_step(s, p, step, size);
    range_of(s, p, step, most, change);
    const WideBits close = change < kClose;
    far = most < 1.0 ? most : Wide{} + 1.0;
    if (bits_of(going & ~close) != 0) search(s, p, step, most, far);
    far = close ? Wide{} + 1.0 : far;
    p.x = going ? p.x + far * step.x : p.x;
    p.y = going ? p.y + far * step.y : p.y;
    p.z = going ? p.z + far * step.z : p.z;
    going &= (change > kDone) & (size > kNothing);
  }
  for (CoordinateScratch::Vertex& v : s.vertices) v.sum = Wide{};
  for (std::size_t i = 0; i < cage.faces.size(); ++i) {
    const CoordinateScratch::Face& f = s.faces[i];
    const Wide part = f.prior / (1.0 + BP_DOT(p, f.middle));
    for (std::size_t k = 0; k < 3; ++k) {
      CoordinateScratch::Vertex& v = s.vertices[cage.faces[i].corner[k]];
      v.sum += part * f.share[k] * v.per_length;
    }
  }
}

}  // namespace bp::detail
