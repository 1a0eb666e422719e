#pragma once
#include <span>

#include "lib/deform/cage.h"
#include "lib/deform/detail/scratch.h"

namespace bp::detail {

/// The mean value weights of kWide points, not divided by their sum, as sums of scratch.vertices. `points` are in the
/// unit of the cage. Bit k of the result: point k lies so near to a vertex, an edge or a face, or in line with so thin
/// a face, that its weights are not to be trusted. `total` is their sum.
unsigned mean_value_weights(const Cage& cage, const WideVec& points, CoordinateScratch& scratch, Wide& total);

/// The same for one point, in extended precision and without the trust. Slow.
void mean_value_weights_slowly(const Cage& cage, const Vec3d& point, std::span<double> weights);

/// face_shares() of all faces for point number `lane`, the same way.
void face_shares_slowly(const Cage& cage, const Vec3d& point, std::size_t lane, CoordinateScratch& scratch);

constexpr double kNearCage = 1e-9;  ///< of the diagonal, and of angles: nearer than this nothing is trusted

/// What a face gives to its corners, times their distance: the combination of the vectors to them that is its mean
/// vector. None is negative, or none is positive. In the plane of a face, but not in the face, all are 0.
BP_INLINE void face_shares(const Cage::Face& face, const CoordinateScratch& scratch, Wide (&share)[3], WideBits& near) {
  constexpr double kMean2 = 1e-16;  // square of a mean vector that may be left out
  const CoordinateScratch::Edge &e0 = scratch.edges[face.edge[0]], &e1 = scratch.edges[face.edge[1]],
                                &e2 = scratch.edges[face.edge[2]];
  const double* s = face.sign.data();
  const WideVec mean{s[0] * e0.mean.x + s[1] * e1.mean.x + s[2] * e2.mean.x,
                     s[0] * e0.mean.y + s[1] * e1.mean.y + s[2] * e2.mean.y,
                     s[0] * e0.mean.z + s[1] * e1.mean.z + s[2] * e2.mean.z};
  const Wide height = s[0] * BP_DOT(e0.across, scratch.vertices[face.corner[0]].toward);
  const WideBits flat = (height < kNearCage) & (height > -kNearCage);
  near |= flat & (BP_DOT(mean, mean) > kMean2);
  const Wide zero{};
  const Wide per = flat ? zero : 1.0 / (flat ? height + 1.0 : height);
  share[0] = s[0] * per * BP_DOT(e0.across, mean);
  share[1] = s[1] * per * BP_DOT(e1.across, mean);
  share[2] = s[2] * per * BP_DOT(e2.across, mean);
}

}  // namespace bp::detail
