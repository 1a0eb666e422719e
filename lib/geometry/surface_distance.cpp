#include "lib/geometry/surface_distance.h"

#include <algorithm>
#include <array>
#include <optional>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"

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

double area_of(const TriangleD& t) {
  const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
  return std::sqrt(dot(n, n)) / 2;
}

/// A part of a triangle and what is known of the distances of its points.
struct Part {
  TriangleD corners;
  double at_most = 0, at_least = 0;  // of the largest distance of its points
  Vec3d where{};                     // as far as at_least
  std::uint32_t nearest = 0;         // to its centre; where the next search starts
};

/// `bar`: parts that surely lie below it are of no interest.
Part examine(const TriangleD& t, const TriangleBvh& to, std::uint32_t guess, double bar) {
  Part part;
  part.corners = t;
  const Vec3d c = centre_of(t);
  const TriangleBvh::Nearest found = to.nearest(c, guess);
  part.nearest = found.item;
  part.at_least = std::sqrt(found.distance_squared);
  part.where = c;
  double radius = 0, corner = -1;
  const Vec3d* farthest = nullptr;
  for (const Vec3d& p : t) {
    radius = std::max(radius, length_squared(p, c));
    const double d = distance_squared(p, to.item(found.item).corners);
    if (d > corner) corner = d, farthest = &p;
  }
  part.at_most = std::min(part.at_least + std::sqrt(radius), std::sqrt(corner));
  part.at_most = std::max(part.at_most, part.at_least);
  if (part.at_most <= bar) return part;
  const double there = std::sqrt(to.nearest(*farthest, found.item).distance_squared);
  if (there > part.at_least) part.at_least = there, part.where = *farthest;
  part.at_most = std::max(part.at_most, part.at_least);  // of rounding
  return part;
}

/// A convex polygon's corners on one side of a plane, and those on the other; both with the points where it is cut.
struct CutPolygon {
  std::vector<Vec3d> inside, outside;
};

CutPolygon cut(const std::vector<Vec3d>& polygon, const Vec3d& through, const Vec3d& inwards) {
  CutPolygon out;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double sa = dot(inwards, a - through), sb = dot(inwards, b - through);
    (sa >= 0 ? out.inside : out.outside).push_back(a);
    if ((sa >= 0) == (sb >= 0)) continue;
    Vec3d crossing;
    for (std::size_t i = 0; i < 3; ++i) crossing[i] = a[i] + sa / (sa - sb) * (b[i] - a[i]);
    out.inside.push_back(crossing);
    out.outside.push_back(crossing);
  }
  return out;
}

/// What lies over the triangle nearest to a part is cut out if that settles it (`bar`: see examine()): there, corners
/// bound the distance best. Appends the rest to `out` and returns the bound of what is settled; nothing if that is
/// little, or the part so thin that rounding would decide.
std::optional<double> cut_out(const TriangleD& part, const TriangleD& nearest, double bar,
                              std::vector<TriangleD>& out) {
  constexpr double kThin = 1e-6;            // area over the longest edge squared
  constexpr double kWorthwhile = 1.0 / 16;  // of the area
  const std::size_t apex = apex_of(part);
  const double whole = area_of(part);
  if (whole <= kThin * length_squared(part[(apex + 1) % 3], part[(apex + 2) % 3])) return std::nullopt;
  const std::size_t before = out.size();
  const Vec3d normal = cross(nearest[1] - nearest[0], nearest[2] - nearest[0]);
  std::vector<Vec3d> inside(part.begin(), part.end());
  for (std::size_t k = 0; k < 3 && !inside.empty(); ++k) {
    CutPolygon pieces = cut(inside, nearest[k], cross(normal, nearest[(k + 1) % 3] - nearest[k]));
    inside = std::move(pieces.inside);
    for (std::size_t i = 2; i < pieces.outside.size(); ++i)
      out.push_back({pieces.outside[0], pieces.outside[i - 1], pieces.outside[i]});
  }
  double farthest = 0, area = 0;
  for (const Vec3d& p : inside) farthest = std::max(farthest, distance_squared(p, nearest));
  for (std::size_t i = 2; i < inside.size(); ++i) area += area_of({inside[0], inside[i - 1], inside[i]});
  farthest = std::sqrt(farthest);
  if (area >= kWorthwhile * whole && farthest <= bar) return farthest;
  out.resize(before);
  return std::nullopt;
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
      Part part = examine(from[i], to, guess, at_least);
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

/// Best first, in rounds: the parts of a round are split in parallel. Rounds do not depend on the number of threads.
class Search {
 public:
  Search(const TriangleBvh& to, SurfaceDistance& result, double smallest)
      : to_(to), result_(result), smallest_(smallest) {}

  void see(Part part) {
    if (part.at_least > result_.at_least) result_.at_least = part.at_least, result_.where = part.where;
    if (part.at_most <= bar()) {
      settled_ = std::max(settled_, part.at_most);
      return;
    }
    open_.push_back(std::move(part));
    std::push_heap(open_.begin(), open_.end(), kLess);
  }

  void run() {
    constexpr std::size_t kRound = 2048, kGrainOfRound = 16;
    std::vector<Part> round;
    std::vector<Found> found;
    while (!done()) {
      round.clear();
      while (!done() && round.size() < kRound) round.push_back(pop());
      found.resize(round.size());
      parallel_chunks(std::int64_t(round.size()), kGrainOfRound, [&](std::int64_t begin, std::int64_t end) {
        std::vector<TriangleD> pieces;
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
          pieces.clear();
          found[i].parts.clear();
          const auto settled = cut_out(round[i].corners, to_.item(round[i].nearest).corners, bar(), pieces);
          found[i].settled = settled.value_or(0);
          if (!settled) {
            for (const TriangleD& half : halves(round[i].corners)) pieces.push_back(half);
          }
          for (const TriangleD& piece : pieces) {
            Part part = examine(piece, to_, round[i].nearest, bar());
            part.at_most = std::min(part.at_most, round[i].at_most);
            found[i].parts.push_back(std::move(part));
          }
        }
      });
      for (const Found& of : found) {
        settled_ = std::max(settled_, of.settled);
        for (const Part& part : of.parts) see(part);
      }
    }
    result_.at_most = std::max(settled_, result_.at_least);
    if (!open_.empty()) result_.at_most = std::max(result_.at_most, open_.front().at_most);
  }

 private:
  /// In one part.
  struct Found {
    std::vector<Part> parts;
    double settled = 0;  // bound for the rest of it
  };
  static constexpr auto kLess = [](const Part& a, const Part& b) { return a.at_most < b.at_most; };

  [[nodiscard]] double bar() const { return result_.at_least + std::max(smallest_, kRelativeError * result_.at_least); }
  [[nodiscard]] bool done() const { return open_.empty() || open_.front().at_most <= bar(); }
  Part pop() {
    std::pop_heap(open_.begin(), open_.end(), kLess);
    Part part = std::move(open_.back());
    open_.pop_back();
    return part;
  }

  const TriangleBvh& to_;
  SurfaceDistance& result_;
  double smallest_, settled_ = 0;  // least error of interest; bound of all parts that are not open
  std::vector<Part> open_;         // a heap
};

}  // namespace

SurfaceDistance surface_distance(const std::vector<TriangleD>& from, const TriangleBvh& to, double tolerance) {
  Bounds3d bounds;
  for (const TriangleD& t : from) bounds.merge(bounds_of(t));
  const std::vector<Chunk> chunks = examine_all(from, to, bounds.diagonal() / kMeanPieces);
  SurfaceDistance result;
  result.where = from.front()[0];
  double area = 0;
  Search search(to, result, std::max(tolerance, kSmallestError * bounds.diagonal()));
  for (const Chunk& chunk : chunks) {
    result.mean += chunk.integral;
    area += chunk.area;
    for (const Part& part : chunk.parts) search.see(part);
  }
  if (area > 0) result.mean /= area;
  search.run();
  return result;
}

namespace {

/// Are all points of triangles near enough to something? Any triangle that shows it will do, so that most searches end
/// early.
class WithinSearch {
 public:
  WithinSearch(const TriangleBvh& to, double limit, std::uint32_t& guess) : to_(to), limit_(limit), guess_(guess) {}

  bool holds(const TriangleD& t) {
    for (const Vec3d& p : t) {
      if (distance(p, limit_) > limit_) return false;
    }
    std::vector<TriangleD> stack{t};
    for (int pieces = 0; !stack.empty(); ++pieces) {
      const TriangleD part = stack.back();
      stack.pop_back();
      if (beside_one(part)) continue;
      const Vec3d c = centre_of(part);
      double radius = 0;
      for (const Vec3d& p : part) radius = std::max(radius, length_squared(p, c));
      radius = std::sqrt(radius);
      const double d = distance(c, limit_ - radius);
      if (d > limit_) return false;
      if (d + radius <= limit_ || beside_one(part)) continue;
      if (radius < kWithinError * limit_ || pieces > kWithinPieces) return false;
      const auto two = halves(part);
      if (distance(two[0][2], limit_) > limit_) return false;  // where it is cut
      stack.insert(stack.end(), two.begin(), two.end());
    }
    return true;
  }

 private:
  /// To something; the least one if that is above `enough`.
  double distance(const Vec3d& p, double enough) {
    const TriangleBvh::Nearest found = to_.near_enough(p, enough > 0 ? enough * enough : -1, guess_);
    guess_ = found.item;
    return std::sqrt(found.distance_squared);
  }
  /// The distance to one triangle is convex: its corners bound that of a part.
  [[nodiscard]] bool beside_one(const TriangleD& part) const {
    const TriangleD& one = to_.item(guess_).corners;
    double farthest = 0;
    for (const Vec3d& p : part) farthest = std::max(farthest, distance_squared(p, one));
    return std::sqrt(farthest) <= limit_;  // which may be such a root: its square need not be as large
  }

  const TriangleBvh& to_;
  double limit_;
  std::uint32_t& guess_;
};

}  // namespace

bool surely_within(const TriangleD& t, const TriangleBvh& to, double limit, std::uint32_t& guess) {
  return WithinSearch(to, limit, guess).holds(t);
}

}  // namespace bp
