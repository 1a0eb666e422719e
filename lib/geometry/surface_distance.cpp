#include "lib/geometry/surface_distance.h"

#include <algorithm>
#include <queue>

#include "lib/core/parallel.h"

namespace bp {

namespace {

constexpr std::int64_t kGrain = 512;        // triangles per work item
constexpr double kMeanPieces = 256;         // pieces along the diagonal, for the mean
constexpr double kRelativeError = 1e-3;     // of the largest distance
constexpr double kSmallestError = 1e-7;     // of the diagonal
constexpr double kWithinError = 1.0 / 128;  // of the limit
constexpr int kWithinPieces = 4096;

double length_squared(const Vec3d& a, const Vec3d& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

Vec3d centre_of(const TriangleD& t) {
  Vec3d c;
  for (std::size_t i = 0; i < 3; ++i) c[i] = t[0][i] / 3 + t[1][i] / 3 + t[2][i] / 3;
  return c;
}

double area_of(const TriangleD& t) {
  Vec3d u, v;
  for (std::size_t i = 0; i < 3; ++i) u[i] = t[1][i] - t[0][i], v[i] = t[2][i] - t[0][i];
  const Vec3d n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  return std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
}

/// Corner opposite the longest edge.
std::size_t apex_of(const TriangleD& t) {
  std::size_t apex = 0;
  double longest = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double l = length_squared(t[(k + 1) % 3], t[(k + 2) % 3]);
    if (l > longest) longest = l, apex = k;
  }
  return apex;
}

/// Halves across the longest edge.
std::array<TriangleD, 2> halves(const TriangleD& t) {
  const std::size_t k = apex_of(t);
  const Vec3d &apex = t[k], &a = t[(k + 1) % 3], &b = t[(k + 2) % 3];
  Vec3d m;
  for (std::size_t i = 0; i < 3; ++i) m[i] = a[i] / 2 + b[i] / 2;
  return {TriangleD{apex, a, m}, TriangleD{apex, m, b}};
}

/// A part of a triangle and what is known of the distances of its points.
struct Part {
  TriangleD corners;
  double at_most = 0, at_least = 0;  // of the largest distance of its points
  Vec3d where{};
  std::uint32_t nearest = 0;  // where the next search starts
};

Part examine(const TriangleD& t, const TriangleBvh& to, std::uint32_t guess) {
  Part part;
  part.corners = t;
  const Vec3d c = centre_of(t);
  const TriangleBvh::Nearest found = to.nearest(c, guess);
  part.nearest = found.item;
  part.at_least = std::sqrt(found.distance_squared);
  part.where = c;
  double radius = 0, corner = 0;
  for (const Vec3d& p : t) {
    radius = std::max(radius, length_squared(p, c));
    corner = std::max(corner, distance_squared(p, to.item(found.item).corners));
  }
  part.at_most = std::min(part.at_least + std::sqrt(radius), std::sqrt(corner));
  part.at_most = std::max(part.at_most, part.at_least);
  return part;
}

/// Sum of distance times area over `t`, in pieces no longer than `step`.
double integral(const TriangleD& t, const TriangleBvh& to, double step, std::uint32_t& guess) {
  double sum = 0;
  std::vector<TriangleD> stack{t};
  while (!stack.empty()) {
    const TriangleD piece = stack.back();
    stack.pop_back();
    const std::size_t k = apex_of(piece);
    if (length_squared(piece[(k + 1) % 3], piece[(k + 2) % 3]) > step * step) {
      for (const TriangleD& half : halves(piece)) stack.push_back(half);
      continue;
    }
    const TriangleBvh::Nearest found = to.nearest(centre_of(piece), guess);
    guess = found.item;
    sum += std::sqrt(found.distance_squared) * area_of(piece);
  }
  return sum;
}

struct Chunk {
  std::vector<Part> parts;
  double integral = 0, area = 0;
};

std::vector<Chunk> examine_all(const std::vector<TriangleD>& from, const TriangleBvh& to, double step) {
  const auto n = std::int64_t(from.size());
  std::vector<Chunk> chunks(std::size_t((n + kGrain - 1) / kGrain));
  parallel_chunks(n, kGrain, [&](std::int64_t begin, std::int64_t end) {
    Chunk& chunk = chunks[std::size_t(begin / kGrain)];
    std::uint32_t guess = 0, guess_mean = 0;
    double at_least = 0;
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
      Part part = examine(from[i], to, guess);
      guess = part.nearest;
      chunk.integral += integral(from[i], to, step, guess_mean);
      chunk.area += area_of(from[i]);
      if (part.at_most <= at_least) continue;  // cannot hold the largest
      at_least = std::max(at_least, part.at_least);
      chunk.parts.push_back(std::move(part));
    }
  });
  return chunks;
}

}  // namespace

SurfaceDistance surface_distance(const std::vector<TriangleD>& from, const TriangleBvh& to, double tolerance) {
  Bounds3d bounds;
  for (const TriangleD& t : from) bounds.merge(bounds_of(t));
  const std::vector<Chunk> chunks = examine_all(from, to, bounds.diagonal() / kMeanPieces);
  SurfaceDistance result;
  double area = 0;
  const auto less = [](const Part& a, const Part& b) { return a.at_most < b.at_most; };
  std::priority_queue<Part, std::vector<Part>, decltype(less)> open(less);
  const auto see = [&](const Part& part) {
    if (part.at_least > result.at_least) result.at_least = part.at_least, result.where = part.where;
    open.push(part);
  };
  for (const Chunk& chunk : chunks) {
    result.mean += chunk.integral;
    area += chunk.area;
    for (const Part& part : chunk.parts) see(part);
  }
  if (area > 0) result.mean /= area;
  const double smallest = std::max(tolerance, kSmallestError * bounds.diagonal());
  while (!open.empty() && open.top().at_most > result.at_least + std::max(smallest, kRelativeError * result.at_least)) {
    const Part part = open.top();
    open.pop();
    for (const TriangleD& half : halves(part.corners)) {
      Part next = examine(half, to, part.nearest);
      next.at_most = std::min(next.at_most, part.at_most);
      see(next);
    }
  }
  result.at_most = open.empty() ? result.at_least : std::max(open.top().at_most, result.at_least);
  return result;
}

bool surely_within(const TriangleD& t, const TriangleBvh& to, double limit) {
  std::vector<TriangleD> stack{t};
  std::uint32_t guess = 0;
  for (int pieces = 0; !stack.empty(); ++pieces) {
    const Part part = examine(stack.back(), to, guess);
    stack.pop_back();
    guess = part.nearest;
    if (part.at_most <= limit) continue;
    const Vec3d& c = part.where;
    double radius = 0;
    for (const Vec3d& p : part.corners) radius = std::max(radius, length_squared(p, c));
    if (part.at_least > limit || std::sqrt(radius) < kWithinError * limit || pieces > kWithinPieces) return false;
    for (const TriangleD& half : halves(part.corners)) stack.push_back(half);
  }
  return true;
}

}  // namespace bp
