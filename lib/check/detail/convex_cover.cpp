// The triangle is cut along the planes of a part that holds a corner; what lies within the part goes, the rest is
// looked at again. Why rounding does no harm: let s be the number that a cut found for an edge from p to q, rounded as
// it may be. Then m* = p* + s (q* - p*) is a point of the edge p*q* that p and q stand for, and all pieces with corners
// m* cover the triangle exactly, wherever m* is. The computed m is off from m* by no more than p or q were, and a
// rounding. So it suffices that all computed corners of a piece lie within a part, by more than they can be off.
#include "lib/check/detail/convex_cover.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr std::uint32_t kNoPart = ~std::uint32_t(0);
constexpr double kUnitRoundoff = 0x1p-53;
// In units of a height's error: how deep a cut lies within a part, and a corner of which it is to hold more.
constexpr double kCutDepth = 4, kCornerDepth = 16;

/// Of each part's box; the hierarchy asks for triangles.
std::vector<TriangleD> boxes_of(const std::vector<std::vector<TriangleD>>& parts) {
  std::vector<TriangleD> boxes;
  for (const std::vector<TriangleD>& part : parts) {
    Bounds3d box;
    for (const TriangleD& t : part) box.merge(bounds_of(t));
    if (part.empty()) box.add({0, 0, 0});
    boxes.push_back({box.min, box.max, box.min});
  }
  return boxes;
}

Vec3d absolute(const Vec3d& v) {
  return {std::abs(v[0]), std::abs(v[1]), std::abs(v[2])};
}

Bounds3d bounds_of_corners(const std::vector<Vec3d>& corners) {
  Bounds3d box;
  for (const Vec3d& p : corners) box.add(p);
  return box;
}

}  // namespace

ConvexCover::ConvexCover(const std::vector<std::vector<TriangleD>>& parts) : boxes_(boxes_of(parts)) {
  for (const std::vector<TriangleD>& part : parts) {
    std::vector<Plane>& planes = parts_.emplace_back();
    for (const TriangleD& t : part) {
      const Vec3d u = t[1] - t[0], v = t[2] - t[0], au = absolute(u), av = absolute(v);
      planes.push_back({t[0],
                        cross(u, v),
                        {au[1] * av[2] + au[2] * av[1], au[2] * av[0] + au[0] * av[2], au[0] * av[1] + au[1] * av[0]}});
    }
  }
}

/// Each term of the value is rounded at most 8 times (lib/exact/predicates.h), and `size` bounds what n is made of.
ConvexCover::Plane::Height ConvexCover::Plane::height(const Vec3d& p, double off) const {
  const Vec3d d = p - a, steepest = absolute(n) + 16 * kUnitRoundoff * size;
  return {dot(n, d),
          16 * kUnitRoundoff * dot(size, absolute(d)) + 1.01 * off * (steepest[0] + steepest[1] + steepest[2])};
}

bool ConvexCover::holds(std::uint32_t part, const Vec3d& p, double off, double slack) const {
  return !parts_[part].empty() && std::all_of(parts_[part].begin(), parts_[part].end(), [&](const Plane& plane) {
    const Plane::Height height = plane.height(p, off);
    return height.value < -slack * height.error;
  });
}

/// Of those that hold the first corner well, one that holds most others.
std::uint32_t ConvexCover::best_part(const Piece& piece, double off) const {
  std::uint32_t best = kNoPart;
  std::size_t most = 0;
  const Vec3d& first = piece.corners[0];
  visit(bounds_of_corners(std::vector<Vec3d>{first}), [&](std::uint32_t part) {
    if (!holds(part, first, off, kCornerDepth)) return false;
    std::size_t held = 1;
    for (std::size_t k = 1; k < piece.corners.size(); ++k) held += holds(part, piece.corners[k], off, 1) ? 1 : 0;
    if (held > most || (held == most && part < best)) most = held, best = part;
    return false;
  });
  return best;
}

/// Takes the last piece away and puts back what of it is not within the part. False if the part does not take its
/// first corner.
bool ConvexCover::take_from(std::vector<Piece>& pieces, std::uint32_t part, double off) const {
  Piece piece = std::move(pieces.back());
  pieces.pop_back();
  std::vector<double> depth;
  for (const Plane& plane : parts_[part]) {
    depth.clear();
    bool whole = true;
    for (const Vec3d& p : piece.corners) {
      const Plane::Height height = plane.height(p, off);
      depth.push_back(-height.value - kCutDepth * height.error);
      whole = whole && -height.value > height.error;
    }
    if (whole) continue;
    Piece within, beyond;
    within.cuts = beyond.cuts = piece.cuts + 1;
    for (std::size_t k = 0; k < piece.corners.size(); ++k) {
      const std::size_t next = (k + 1) % piece.corners.size();
      (depth[k] >= 0 ? within : beyond).corners.push_back(piece.corners[k]);
      if ((depth[k] >= 0) == (depth[next] >= 0)) continue;
      const double s = std::clamp(depth[k] / (depth[k] - depth[next]), 0.0, 1.0);
      const Vec3d m = piece.corners[k] + s * (piece.corners[next] - piece.corners[k]);
      within.corners.push_back(m);
      beyond.corners.push_back(m);
    }
    if (within.corners.empty()) return false;
    pieces.push_back(std::move(beyond));
    piece = std::move(within);
  }
  return piece.cuts <= kMostCuts && std::all_of(piece.corners.begin(), piece.corners.end(),
                                                [&](const Vec3d& p) { return holds(part, p, off, 1); });
}

bool ConvexCover::covers(const TriangleD& t) const {
  double far = 0;
  for (const Vec3d& p : t) far = std::max({far, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  const double off = kMostCuts * 8 * kUnitRoundoff * far;  // along an axis: each cut may add 8 roundings
  std::vector<Piece> pieces(1);
  pieces[0].corners.assign(t.begin(), t.end());
  for (std::size_t taken = 0; !pieces.empty(); ++taken) {
    const Piece& piece = pieces.back();
    if (taken == kMostPieces || piece.cuts > kMostCuts) return false;
    const std::uint32_t part = best_part(piece, off);
    if (part == kNoPart || !take_from(pieces, part, off)) return false;
  }
  return true;
}

}  // namespace bp
