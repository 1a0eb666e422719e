#include "lib/geometry/surface_distance.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/geometry/triangle_parts.h"

namespace bp {

namespace {

constexpr std::int64_t kGrain = 512;     // triangles per work item
constexpr double kMeanPieces = 256;      // pieces along the diagonal, for the mean
constexpr double kRelativeError = 1e-3;  // of the largest distance
constexpr double kSmallestError = 1e-7;  // of the diagonal
constexpr double kRounding = 0x1p-46;    // of the largest coordinate: some ten units in the last place

/// Returns a length below which rounding of coordinates decides. Nothing is halved further.
double least_length(const Bounds3d& bounds) {
  double reach = 0;
  for (std::size_t i = 0; i < 3; ++i) reach = std::max({reach, std::abs(bounds.min[i]), std::abs(bounds.max[i])});
  return kRounding * reach;
}

/// A part of a triangle, and bounds of the distances of its points.
struct Part {
  TriangleD corners;
  double at_most = 0, at_least = 0;  // bounds of the largest distance of its points
  Vec3d where{};                     // a point at the distance at_least
  std::uint32_t nearest = 0;         // item nearest to its centre; the next search starts there
};

/// Bounds the distances of the part. `bar`: parts that surely lie below it need no sharp bounds.
Part examine(const TriangleD& t, const TriangleBvh& to, std::uint32_t guess, double bar) {
  Part part;
  part.corners = t;
  const Vec3d c = centre_of(t);
  const TriangleBvh::Nearest found = to.nearest(c, guess);
  part.nearest = found.item;
  part.at_least = std::sqrt(found.distance_squared);
  part.where = c;
  double radius = 0, corner = -1;
  const Vec3d* farthest = t.data();
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
  part.at_most = std::max(part.at_most, part.at_least);  // rounding may have swapped them
  return part;
}

/// Cuts out the piece over the triangle nearest to a part, if `bar` settles that piece (see examine()): there, corners
/// bound the distance best. Appends the rest to `out` and returns the bound of the piece. Returns nothing if the piece
/// is small, or the part so thin that rounding would decide.
std::optional<double> cut_out(const TriangleD& part, const TriangleD& nearest, double bar,
                              std::vector<TriangleD>& out) {
  constexpr double kThin = 1e-6;                  // area over the longest edge squared
  constexpr double kWorthwhileInside = 1.0 / 16;  // of the part's area
  const std::size_t apex = apex_of(part);
  const double whole = area_of(part);
  if (whole <= kThin * length_squared(part[(apex + 1) % 3], part[(apex + 2) % 3])) return std::nullopt;
  const std::size_t before = out.size();
  const Vec3d normal = cross(nearest[1] - nearest[0], nearest[2] - nearest[0]);
  Polygon inside(part);
  for (std::size_t k = 0; k < 3 && inside.count > 0; ++k) {
    const CutPolygon pieces = cut(inside, nearest[k], cross(normal, nearest[(k + 1) % 3] - nearest[k]));
    inside = pieces.inside;
    for (std::size_t i = 0; i < pieces.outside.triangles(); ++i) out.push_back(pieces.outside.triangle(i));
  }
  double farthest = 0;
  for (std::size_t i = 0; i < inside.count; ++i)
    farthest = std::max(farthest, distance_squared(inside.corners[i], nearest));
  farthest = std::sqrt(farthest);
  if (inside.area() >= kWorthwhileInside * whole && farthest <= bar) return farthest;
  out.resize(before);
  return std::nullopt;
}

/// Returns the sum of distance times area over `t`, in pieces no longer than `step`.
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

/// `step`: of the integrals; 0: no integrals.
std::vector<Chunk> examine_all(const std::vector<TriangleD>& from, const TriangleBvh& to, double step) {
  const auto n = std::int64_t(from.size());
  std::vector<Chunk> chunks(std::size_t((n + kGrain - 1) / kGrain));
  parallel_ranges(n, kGrain, [&](std::int64_t begin, std::int64_t end) {
    Chunk& chunk = chunks[std::size_t(begin / kGrain)];
    std::uint32_t guess = 0, guess_mean = 0;
    double at_least = 0;
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
      Part part = examine(from[i], to, guess, at_least);
      guess = part.nearest;
      if (step > 0) {
        chunk.integral += integral(from[i], to, step, guess_mean);
        chunk.area += area_of(from[i]);
      }
      if (part.at_most <= at_least) continue;  // the part cannot hold the largest distance
      at_least = std::max(at_least, part.at_least);
      chunk.parts.push_back(std::move(part));
    }
  });
  return chunks;
}

/// Splits the best parts first, in rounds; the parts of a round are split in parallel. Rounds do not depend on the
/// number of threads.
class Search {
 public:
  Search(const TriangleBvh& to, SurfaceDistance& result, double smallest, const SearchEffort& effort)
      : to_(to), result_(result), smallest_(smallest), effort_(effort) {}

  void see(Part part) {
    if (part.at_least > result_.at_least) result_.at_least = part.at_least, result_.where = part.where;
    if (!(part.at_most > bar())) {
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
    std::size_t seen = 0;
    const std::size_t most = open_.size() + effort_.more_parts;
    while (!done()) {
      round.clear();
      while (!done() && round.size() < kRound) round.push_back(pop());
      found.resize(round.size());
      parallel_ranges(std::int64_t(round.size()), kGrainOfRound, [&](std::int64_t begin, std::int64_t end) {
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
        seen += of.parts.size();
      }
      for (; seen >= effort_.patience; seen -= effort_.patience) smallest_ *= 2;
      if (open_.size() > most) let_go();
    }
    result_.at_most = std::max(settled_, result_.at_least);
    if (!open_.empty()) result_.at_most = std::max(result_.at_most, open_.front().at_most);
  }

 private:
  /// The pieces that were found in one part.
  struct Found {
    std::vector<Part> parts;
    double settled = 0;  // bound of the pieces that need no further look
  };
  static constexpr auto kLess = [](const Part& a, const Part& b) { return a.at_most < b.at_most; };

  [[nodiscard]] double bar() const { return result_.at_least + std::max(smallest_, kRelativeError * result_.at_least); }
  [[nodiscard]] bool done() const {
    return open_.empty() || !(open_.front().at_most > bar()) || result_.at_least > effort_.enough;
  }
  /// Gives up half of the open parts: those with the smallest bounds. The answer will be no sharper than their bound.
  void let_go() {
    const auto half = open_.begin() + std::ptrdiff_t(open_.size() / 2);
    std::nth_element(open_.begin(), half, open_.end(), [](const Part& a, const Part& b) { return kLess(b, a); });
    settled_ = std::max(settled_, half->at_most);
    smallest_ = std::max(smallest_, half->at_most - result_.at_least);
    open_.erase(half, open_.end());
    std::make_heap(open_.begin(), open_.end(), kLess);
  }
  Part pop() {
    std::pop_heap(open_.begin(), open_.end(), kLess);
    Part part = std::move(open_.back());
    open_.pop_back();
    return part;
  }

  const TriangleBvh& to_;
  SurfaceDistance& result_;
  double smallest_, settled_ = 0;  // the least error of interest; a bound of all parts that are not open
  const SearchEffort effort_;
  std::vector<Part> open_;  // a heap
};

SurfaceDistance measured(const std::vector<TriangleD>& from, const TriangleBvh& to, double tolerance,
                         const SearchEffort& effort, bool mean) {
  Bounds3d bounds;
  for (const TriangleD& t : from) bounds.merge(bounds_of(t));
  const double least = least_length(bounds);
  const double step = mean ? std::max(bounds.diagonal() / kMeanPieces, least) : 0;
  const std::vector<Chunk> chunks = examine_all(from, to, step);
  SurfaceDistance result;
  result.where = from.front()[0];
  double area = 0;
  Search search(to, result, std::max({tolerance, kSmallestError * bounds.diagonal(), least}), effort);
  for (const Chunk& chunk : chunks) {
    result.mean += chunk.integral;
    area += chunk.area;
    for (const Part& part : chunk.parts) search.see(part);
  }
  if (area > 0) result.mean /= area;
  search.run();
  return result;
}

}  // namespace

SurfaceDistance surface_distance(const std::vector<TriangleD>& from, const TriangleBvh& to, double tolerance) {
  SearchEffort effort;
  effort.patience = std::numeric_limits<std::size_t>::max();
  return measured(from, to, tolerance, effort, true);
}

SurfaceDistance largest_distance(const std::vector<TriangleD>& from, const TriangleBvh& to, double tolerance,
                                 const SearchEffort& effort) {
  return measured(from, to, tolerance, effort, false);
}

}  // namespace bp
