#pragma once
#include <atomic>

#include "lib/check/check_report.h"
#include "lib/check/detail/scene_batches.h"
#include "lib/geometry/triangle_bvh.h"

/// Measures distances of samples, and bounds of the largest distance. Only the numbers of triangles decide which ones
/// are sampled.
namespace bp {

/// Keeps at most `capacity` of a stream of numbered triangles: those whose hashed number is lowest, roughly.
class TriangleSample {
 public:
  explicit TriangleSample(std::size_t capacity) : capacity_(capacity) {}
  void see(std::uint64_t number, const TriangleD& t);
  /// Returns false if see() would not keep the triangle, now or later. Thread-safe, also beside see().
  [[nodiscard]] bool may_keep(std::uint64_t number) const;
  /// Corners and centroids of the kept triangles, each position once, in the order of the stream.
  [[nodiscard]] std::vector<Vec3d> points() const;

 private:
  struct Kept {
    std::uint64_t hash;
    TriangleD triangle;
  };
  std::size_t capacity_;
  std::atomic<std::uint64_t> mask_{0};  // a triangle is kept while (hash & mask_) == 0; bits are only added
  std::vector<Kept> kept_;
};

/// Keeps what distances need of a scene: a sample of it, and all of it as long as it fits.
class SceneMemory {
 public:
  /// Keeps at most `most` triangles, all or none, and a sample of at most `capacity`.
  SceneMemory(std::size_t capacity, std::uint64_t most) : sample_(capacity), most_(most), keeps_(most > 0) {}

  /// The triangles of a batch that may be kept.
  struct Part {
    struct Numbered {
      std::uint64_t number;
      TriangleD triangle;
    };
    std::uint64_t count = 0;
    std::vector<Numbered> sampled;
    std::vector<TriangleD> all;
  };
  [[nodiscard]] Part part_of(const SceneBatch& batch) const;  ///< thread-safe, also beside add()
  void add(Part&& part);                                      ///< in the order of the scene

  [[nodiscard]] const TriangleSample& sample() const { return sample_; }
  [[nodiscard]] bool has_all() const { return keeps_; }
  /// Returns all triangles, and forgets them.
  [[nodiscard]] std::vector<TriangleD> take_all();

 private:
  TriangleSample sample_;
  const std::uint64_t most_;
  std::atomic<bool> keeps_;
  std::uint64_t count_ = 0;
  std::vector<std::vector<TriangleD>> all_;
};

/// Distances from the points to the nearest triangle. Parallel. Neither may be empty.
[[nodiscard]] SampledDistance distances(const std::vector<Vec3d>& points, const TriangleBvh& to);

/// With more triangles there are only samples, to save time and memory: among so many, samples lie close.
constexpr std::size_t kMostBounded = 1 << 15;

/// Adds an upper bound of the distance of any point of `from`, usually 0.1 % more than that of the farthest point
/// found, and that point. For 1 to kMostBounded triangles. Parallel; the result does not depend on the number of
/// threads.
void bound_largest(const std::vector<TriangleD>& from, const TriangleBvh& to, SampledDistance& distance);

}  // namespace bp
