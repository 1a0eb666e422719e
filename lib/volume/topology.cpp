#include "lib/volume/topology.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>

#include "lib/core/disjoint_sets.h"
#include "lib/core/parallel.h"
#include "lib/grid/clip.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

/// Returns the part of a brick in the Euler characteristic of the cubical complex whose points are the voxels: voxels,
/// less pairs of neighbours, and so on. It counts the cells whose least voxel lies in the brick.
std::int64_t characteristic_of(const BrickShelf& solid, BrickCoord brick) {
  bool full = true;  // together with the bricks that such cells reach into
  for (int i = 0; i < 8 && full; ++i)
    full = solid.fill(brick + BrickCoord{i & 1, (i >> 1) & 1, i >> 2}) == BrickFill::full;
  if (full) return 0;
  const VoxelCoord first = first_voxel(brick);
  BitBox box(voxels_of(brick).grown(1));
  load_voxels(solid, box);
  const auto count = [](std::uint64_t bits) { return std::int64_t(std::popcount(bits)); };
  std::int64_t sum = 0;
  for (std::int32_t z = first.z; z < first.z + kBrickEdge; ++z) {
    for (std::int32_t y = first.y; y < first.y + kBrickEdge; ++y) {
      const auto row = [&](int dy, int dz) { return box.row(y + dy, z + dz)[1]; };
      const auto pairs = [&](int dy, int dz) {  // pairs of a voxel and the next one along x
        const std::uint64_t* r = box.row(y + dy, z + dz);
        return r[1] & (r[1] >> 1 | r[2] << 63);
      };
      const std::uint64_t a = row(0, 0), ab = a & row(1, 0), ac = a & row(0, 1), abcd = ab & ac & row(1, 1);
      const std::uint64_t p = pairs(0, 0), pq = p & pairs(1, 0), pr = p & pairs(0, 1), pqrs = pq & pr & pairs(1, 1);
      sum += count(a) - count(p) - count(ab) - count(ac) + count(pq) + count(pr) + count(abcd) - count(pqrs);
    }
  }
  return sum;
}

VoxelBox box_of(const std::vector<BrickCoord>& bricks) {
  VoxelBox box;
  for (const BrickCoord& b : bricks) box = hull(box, voxels_of(BrickBox{b, {b.x + 1, b.y + 1, b.z + 1}}));
  return box;
}

auto row_of(const VoxelRun& run) {
  return std::tuple(run.first.z, run.first.y);
}

/// Joins touching runs to parts.
class Parts {
 public:
  explicit Parts(std::vector<VoxelRun> runs) : runs_(std::move(runs)), sets_(runs_.size()), parts_(runs_.size()) {
    std::sort(runs_.begin(), runs_.end(), [](const VoxelRun& a, const VoxelRun& b) {
      return std::tuple(row_of(a), a.first.x) < std::tuple(row_of(b), b.first.x);
    });
    for (std::size_t i = 1; i < runs_.size(); ++i) {
      if (row_of(runs_[i - 1]) == row_of(runs_[i]) && end_of(i - 1) == runs_[i].first.x) join(i - 1, i);
    }
    join_rows(1, 0);
    join_rows(0, 1);
  }
  [[nodiscard]] std::uint64_t count() const { return parts_; }

 private:
  [[nodiscard]] std::int32_t end_of(std::size_t i) const { return runs_[i].first.x + runs_[i].length; }

  /// Joins each run with the runs of the row that lies so far before its own.
  void join_rows(std::int32_t dy, std::int32_t dz) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const VoxelCoord at = runs_[i].first;
      const std::tuple before(at.z - dz, at.y - dy);
      while (std::tuple(row_of(runs_[begin]), end_of(begin)) <= std::tuple(before, at.x)) ++begin;
      for (std::size_t j = begin; j < i && row_of(runs_[j]) == before && runs_[j].first.x < end_of(i); ++j) join(i, j);
    }
  }

  void join(std::size_t i, std::size_t j) { parts_ -= sets_.unite(std::uint32_t(i), std::uint32_t(j)); }

  std::vector<VoxelRun> runs_;  // by z, y, x
  DisjointSets sets_;
  std::uint64_t parts_;
};

}  // namespace

std::uint64_t topology_bytes(const BrickShelf& solid) {
  return (sizeof(VoxelRun) + sizeof(std::uint32_t)) * count_runs(solid, box_of(solid.coords()));
}

SolidTopology topology_of(const BrickShelf& solid) {
  const std::vector<BrickCoord> bricks = solid.coords();
  if (bricks.empty()) return {};
  std::vector<std::int64_t> sums(bricks.size());
  parallel_for(std::int64_t(bricks.size()),
               [&](std::int64_t i) { sums[std::size_t(i)] = characteristic_of(solid, bricks[std::size_t(i)]); });
  SolidTopology topology;
  topology.parts = Parts(runs_of(solid, box_of(bricks))).count();
  const std::int64_t handles =
      std::int64_t(topology.parts) - std::accumulate(sums.begin(), sums.end(), std::int64_t(0));
  topology.handles = std::uint64_t(std::max<std::int64_t>(handles, 0));
  return topology;
}

}  // namespace bp
