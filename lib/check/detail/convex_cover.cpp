// Cuts the triangle along the planes of a part that holds a corner; the piece within the part is dropped, the others
// are tested again. Why rounding does no harm: let s be the number that a cut found for an edge from p to q, with any
// rounding. Then m* = p* + s (q* - p*) is a point of the edge p*q* that p and q approximate, and all pieces with
// corners m* cover the triangle exactly, wherever m* is. The computed m is off from m* by no more than p or q were, and
// a rounding. So it suffices that all computed corners of a piece lie within a part, by more than their error.
// Coordinates are relative to the triangle's first corner. The differences to it are rounded once, so their error is a
// share of themselves, and not of the distance from the origin.
#include "lib/check/detail/convex_cover.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr std::uint32_t kNoPart = ~std::uint32_t(0);
constexpr double kUnitRoundoff = 0x1p-53;
// Depths in units of a height's error: the depth within a part at which a cut is made, and the least depth of a corner
// for which a part is chosen.
constexpr double kCutDepth = 4, kCornerDepth = 16;

/// Returns two corners of each part's box as a triangle, since the hierarchy takes triangles.
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

double largest(const Vec3d& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

}  // namespace

/// Returns the frame for corners after `cuts` cuts. Each cut may add 8 roundings and a corner; the middle of a piece
/// adds one rounding for each corner. One bound serves a whole search: a corner that an early cut left at the required
/// depth must be deep enough after the last cut.
ConvexCover::Local ConvexCover::Local::after(int cuts) const {
  return {origin, far, moved, off + 10 * (cuts + 1) * kUnitRoundoff * far};
}

/// Returns a box, scene units, that holds the point that p approximates.
Bounds3d ConvexCover::box_around(const Vec3d& p, const Local& local) {
  Bounds3d box;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = local.origin[i] + p[i], by = local.off + 2 * kUnitRoundoff * std::abs(x);
    box.min[i] = x - by, box.max[i] = x + by;
  }
  return box;
}

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

/// Returns the height of p above the plane, with a bound on its error. Each term of the value is rounded at most 8
/// times (lib/exact/predicates.h), and `size` bounds the terms of n. The plane's point is rounded once when it is made
/// relative.
ConvexCover::Plane::Height ConvexCover::Plane::height(const Vec3d& p, const Local& local) const {
  const Vec3d from = a - local.origin, d = p - from, steepest = absolute(n) + 16 * kUnitRoundoff * size;
  const double off = local.off + kUnitRoundoff * largest(from), along = steepest[0] + steepest[1] + steepest[2];
  return {dot(n, d) + 1.01 * local.moved * along, 16 * kUnitRoundoff * dot(size, absolute(d)) + 1.01 * off * along};
}

bool ConvexCover::holds(std::uint32_t part, const Vec3d& p, const Local& local, double slack) const {
  return !parts_[part].empty() && std::all_of(parts_[part].begin(), parts_[part].end(), [&](const Plane& plane) {
    const Plane::Height height = plane.height(p, local);
    return height.value < -slack * height.error;
  });
}

/// Returns true only if the point that p approximates lies beyond a plane of the part.
bool ConvexCover::misses(std::uint32_t part, const Vec3d& p, const Local& local) const {
  return parts_[part].empty() || std::any_of(parts_[part].begin(), parts_[part].end(), [&](const Plane& plane) {
           const Plane::Height height = plane.height(p, local);
           return height.value > height.error;
         });
}

/// Returns true only if no part holds the point that p approximates.
bool ConvexCover::is_bare(const Vec3d& p, const Local& local) const {
  return !visit(box_around(p, local), [&](std::uint32_t part) { return !misses(part, p, local); });
}

/// Returns true only if some point of the piece lies in no part. Gaps are searched for at its corners, and from each
/// corner towards its middle in steps that double.
bool ConvexCover::shows_bare(const Piece& piece, const Local& frame) const {
  constexpr int kMostHalvings = 48;
  Vec3d middle{};
  for (const Vec3d& p : piece.corners) middle = middle + (1.0 / double(piece.corners.size())) * p;
  for (const Vec3d& p : piece.corners) {
    if (is_bare(p, frame)) return true;
    double step = 1;
    for (int i = 0; i < kMostHalvings; ++i, step /= 2) {
      if (is_bare(p + step * (middle - p), frame)) return true;
    }
  }
  return false;
}

/// Returns, among the parts that hold the first corner well, the one that holds most other corners.
std::uint32_t ConvexCover::best_part(const Piece& piece, const Local& frame) const {
  std::uint32_t best = kNoPart;
  std::size_t most = 0;
  const Vec3d& first = piece.corners[0];
  visit(box_around(first, frame), [&](std::uint32_t part) {
    if (!holds(part, first, frame, kCornerDepth)) return false;
    std::size_t held = 1;
    for (std::size_t k = 1; k < piece.corners.size(); ++k) held += holds(part, piece.corners[k], frame, 1) ? 1 : 0;
    if (held > most || (held == most && part < best)) most = held, best = part;
    return false;
  });
  return best;
}

/// Takes the last piece away and puts back its pieces outside of the part. Returns false if the part does not hold its
/// first corner well.
bool ConvexCover::take_from(std::vector<Piece>& pieces, std::uint32_t part, int most_cuts, const Local& frame) const {
  Piece piece = std::move(pieces.back());
  pieces.pop_back();
  std::vector<double> depth;
  for (const Plane& plane : parts_[part]) {
    depth.clear();
    bool whole = true;
    for (const Vec3d& p : piece.corners) {
      const Plane::Height height = plane.height(p, frame);
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
  return piece.cuts <= most_cuts && std::all_of(piece.corners.begin(), piece.corners.end(),
                                                [&](const Vec3d& p) { return holds(part, p, frame, 1); });
}

Answer ConvexCover::covers(const TriangleD& t, double moved) const {
  constexpr int kFewCuts = 32;  // the fewer cuts are allowed, the less is lost to rounding
  double far = 0;
  for (const Vec3d& p : t) far = std::max(far, largest(p - t[0]));
  const Local local{t[0], far, moved, 0};
  const auto holds_all = [&](std::uint32_t part) {
    return std::all_of(t.begin(), t.end(), [&](const Vec3d& p) { return holds(part, p - t[0], local.after(0), 1); });
  };
  if (moved > 0 && visit(bounds_of(t), holds_all)) return Answer::proven;  // a cut would need more depth
  const Answer answer = covers_by(t, kFewCuts, local.after(kFewCuts));
  return answer == Answer::undecided ? covers_by(t, kMostCuts, local.after(kMostCuts)) : answer;
}

/// Covers the triangle with at most so many cuts of a piece, one after the other.
Answer ConvexCover::covers_by(const TriangleD& t, int most_cuts, const Local& frame) const {
  std::vector<Piece> pieces(1);
  for (const Vec3d& p : t) pieces[0].corners.push_back(p - t[0]);
  for (std::size_t taken = 0; !pieces.empty(); ++taken) {
    const Piece& piece = pieces.back();
    if (taken == kMostPieces || piece.cuts > most_cuts) return Answer::undecided;
    const std::uint32_t part = best_part(piece, frame);
    if (part == kNoPart) return shows_bare(piece, frame) ? Answer::refuted : Answer::undecided;
    if (!take_from(pieces, part, most_cuts, frame)) return Answer::undecided;
  }
  return Answer::proven;
}

}  // namespace bp
