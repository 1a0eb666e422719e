#pragma once
#include "lib/check/check_report.h"
#include "lib/geometry/triangle_bvh.h"

/// Distances of samples, and bounds of the largest. Which triangles are sampled depends on their numbers alone.
namespace bp {

/// Keeps at most `capacity` of a stream of numbered triangles: those whose hashed number is lowest, roughly.
class TriangleSample {
 public:
  explicit TriangleSample(std::size_t capacity) : capacity_(capacity) {}
  void see(std::uint64_t number, const TriangleD& t);
  /// Corners and centroids of the kept triangles, each position once, in the order of the stream.
  [[nodiscard]] std::vector<Vec3d> points() const;

 private:
  struct Kept {
    std::uint64_t hash;
    TriangleD triangle;
  };
  std::size_t capacity_;
  std::uint64_t mask_ = 0;  // a triangle is kept while (hash & mask_) == 0
  std::vector<Kept> kept_;
};

/// Distances from the points to the nearest triangle. Parallel. Neither may be empty.
[[nodiscard]] SampledDistance distances(const std::vector<Vec3d>& points, const TriangleBvh& to);

/// More triangles than that have only samples, for time and memory: among so many, samples lie close.
constexpr std::size_t kMostBounded = 1 << 15;

/// Adds what no point of `from` exceeds, as a rule 0.1 % beyond the farthest point that is found, and that point. Up to
/// kMostBounded triangles, at least one. Parallel; the result does not depend on the number of threads.
void bound_largest(const std::vector<TriangleD>& from, const TriangleBvh& to, SampledDistance& distance);

}  // namespace bp
