#include "lib/levels/detail/voxel_distance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/core/parallel.h"
#include "lib/geometry/crossing.h"
#include "lib/geometry/near_surface.h"
#include "lib/geometry/triangle_parts.h"

namespace bp {

namespace {

const double kSegmentToPoint = std::sqrt(1.5);  // from a point of the segment to any point of its voxel, in voxels
const double kPointToSegment = std::sqrt(0.5);
const double kPointToCentre = std::sqrt(0.75);
constexpr double kSearchTolerance = 0.5;  // step of the search, in voxels
// The largest area of a piece of the mesh. The proof that a triangle is near takes a number of parts that grows with
// its area over the limit squared, and gives up after some thousands of them.
constexpr double kPieceArea = 256;    // voxels squared
constexpr double kLeastLimit = 0.25;  // in voxels; a smaller limit is not worth the test
constexpr std::size_t kPlaces = 512;  // that NearSurface remembers

/// Returns the same surface in triangles of at most `most` area.
std::vector<TriangleD> pieces_of(const std::vector<TriangleD>& triangles, double most) {
  std::vector<TriangleD> pieces, open;
  for (const TriangleD& t : triangles) {
    for (open.assign(1, t); !open.empty();) {
      const TriangleD piece = open.back();
      open.pop_back();
      if (!(area_of(piece) > most)) {
        pieces.push_back(piece);
        continue;
      }
      for (const TriangleD& half : halves(piece)) open.push_back(half);
    }
  }
  return pieces;
}

/// Returns the largest distance of the middle of a triangle of `from` to `to`. It is a lower bound of the largest
/// distance.
double distance_at_middles(const std::vector<TriangleD>& from, const TriangleBvh& to) {
  const auto n = std::int64_t(from.size());
  std::vector<double> largest(std::size_t((n + kItemsAtOnce - 1) / kItemsAtOnce));
  parallel_ranges(n, kItemsAtOnce, [&](std::int64_t begin, std::int64_t end) {
    std::uint32_t guess = 0;
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
      Vec3d c{};
      for (const Vec3d& p : from[i])
        for (std::size_t k = 0; k < 3; ++k) c[k] += p[k] / 3;
      const TriangleBvh::Nearest found = to.nearest(c, guess);
      guess = found.item;
      largest[std::size_t(begin / kItemsAtOnce)] =
          std::max(largest[std::size_t(begin / kItemsAtOnce)], found.distance_squared);
    }
  });
  return std::sqrt(*std::max_element(largest.begin(), largest.end()));
}

/// Returns the numbers of the triangles of `from` that are not surely within `limit`, in their order.
std::vector<std::uint32_t> which_are_farther(double limit, const std::vector<TriangleD>& from, const TriangleBvh& to) {
  std::vector<char> far(from.size());
  parallel_ranges(std::int64_t(from.size()), kItemsAtOnce, [&](std::int64_t begin, std::int64_t end) {
    NearSurface near(to, limit / 2, kPlaces);
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) far[i] = !near.holds(from[i], limit);
  });
  std::vector<std::uint32_t> left;
  for (std::size_t i = 0; i < from.size(); ++i)
    if (far[i] != 0) left.push_back(std::uint32_t(i));
  return left;
}

std::vector<TriangleD> farther_than(double limit, const std::vector<TriangleD>& from, const TriangleBvh& to) {
  std::vector<TriangleD> left;
  for (const std::uint32_t i : which_are_farther(limit, from, to)) left.push_back(from[i]);
  return left;
}

/// Returns an upper bound of the largest distance, too high by at most `step` and 2 %. Triangles are settled one by one
/// against a limit that rises while it is too low: an exact maximum would take longer, and nobody needs it.
double upper_bound(const std::vector<TriangleD>& from, const TriangleBvh& to, double step) {
  double limit = distance_at_middles(from, to) * 1.02 + step;
  for (std::vector<TriangleD> left = farther_than(limit, from, to); !left.empty(); left = farther_than(limit, left, to))
    limit = limit * 1.02 + step;
  return limit;
}

/// Returns the largest distance to the mesh of the centres of voxels behind `segments` that lie outside; at least
/// `known`.
double distance_of_centres(const std::vector<TriangleD>& segments, const TriangleBvh& mesh, double voxel,
                           double known) {
  const auto n = std::int64_t(segments.size());
  std::vector<double> largest(std::size_t((n + kItemsAtOnce - 1) / kItemsAtOnce), known);
  parallel_ranges(n, kItemsAtOnce, [&](std::int64_t begin, std::int64_t end) {
    std::uint32_t guess = 0;
    double& far = largest[std::size_t(begin / kItemsAtOnce)];
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
      Vec3d centre = segments[i][0];
      for (centre[0] += voxel / 2; centre[0] < segments[i][1][0]; centre[0] += voxel) {
        const TriangleBvh::Nearest found = mesh.nearest(centre, guess);
        guess = found.item;
        const double distance = std::sqrt(found.distance_squared);
        if (distance > far && winding_number(mesh, centre) < 1) far = distance;
      }
    }
  });
  return largest.empty() ? known : *std::max_element(largest.begin(), largest.end());
}

}  // namespace

int winding_number(const TriangleBvh& mesh, const Vec3d& p) {
  int winding = 0;
  mesh.visit_above(p, [&](const TriangleBvh::Item& item) { winding += crossing_above(item.corners, p); });
  return winding;
}

std::vector<TriangleD> segments_of(std::span<const VoxelRun> runs, const GridFrame& frame) {
  std::vector<TriangleD> segments;
  segments.reserve(runs.size());
  for (const VoxelRun& run : runs) {
    const LatticeCoord a{std::int64_t(run.first.x) * kLatticePerVoxel,
                         std::int64_t(run.first.y) * kLatticePerVoxel + kLatticePerVoxel / 2,
                         std::int64_t(run.first.z) * kLatticePerVoxel + kLatticePerVoxel / 2};
    const LatticeCoord b{a.x + run.length * kLatticePerVoxel, a.y, a.z};
    segments.push_back({frame.world(a), frame.world(b), frame.world(b)});
  }
  return segments;
}

double distance_from_mesh(const std::vector<TriangleD>& mesh, const TriangleBvh& segments, double voxel) {
  const std::vector<TriangleD> pieces = pieces_of(mesh, kPieceArea * voxel * voxel);
  return upper_bound(pieces, segments, kSearchTolerance * voxel) + kSegmentToPoint * voxel;
}

// A point outside is within kPointToCentre of its voxel's centre. If that centre is not outside, the mesh is as near as
// the centre.
double distance_beyond_mesh(const std::vector<TriangleD>& segments, const TriangleBvh& mesh, double voxel,
                            double at_least) {
  const double known = at_least - kPointToCentre * voxel;
  const double found = distance_of_centres(farther_than(known, segments, mesh), mesh, voxel, known);
  return std::max(found + kPointToCentre * voxel, at_least);
}

std::vector<std::uint32_t> far_segments(const std::vector<TriangleD>& segments, const TriangleBvh& mesh, double voxel,
                                        double limit) {
  const double near = limit - kPointToSegment * voxel;
  if (near > kLeastLimit * voxel) return which_are_farther(near, segments, mesh);
  std::vector<std::uint32_t> all(segments.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

}  // namespace bp
