#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lib/core/error.h"
#include "lib/core/triangle_source.h"
#include "lib/device/cpu/cpu_backend.h"
#include "lib/grid/stream.h"
#include "lib/voxel/voxelize.h"

/// Scenes and streams of bricks in memory, for tests of stages.
namespace bp::test {

using Triangles = std::vector<TriangleD>;

class MemorySource final : public TriangleSource {
 public:
  explicit MemorySource(Triangles triangles, std::size_t chunk = 1000)
      : triangles_(std::move(triangles)), chunk_(chunk) {}
  bool read(std::vector<TriangleD>& out) override {
    const std::size_t n = std::min(chunk_, triangles_.size() - next_);
    out.assign(triangles_.begin() + std::ptrdiff_t(next_), triangles_.begin() + std::ptrdiff_t(next_ + n));
    next_ += n;
    counts_.triangles += n;
    return n > 0;
  }
  void rewind() override {
    next_ = 0;
    counts_ = {};
    ++rewinds;
  }
  [[nodiscard]] const SceneCounts& counts() const override { return counts_; }
  [[nodiscard]] std::string name() const override { return "memory"; }
  int rewinds = 0;

 private:
  Triangles triangles_;
  std::size_t chunk_, next_ = 0;
  SceneCounts counts_;
};

/// Keeps the bricks; fails if they come out of order, out of the box or empty.
class MemorySink final : public BrickSink {
 public:
  StreamHeader header;
  std::vector<Brick> bricks;
  void write(const Brick& brick) override {
    if (brick.fill == BrickFill::empty || classify(brick.bits) != brick.fill || !header.bricks.contains(brick.coord))
      fail(ErrorCode::failed, "a brick that should not be");
    if (!bricks.empty() && !slab_order(header.slab_axis, bricks.back(), brick))
      fail(ErrorCode::failed, "bricks out of order");
    bricks.push_back(brick);
  }
  void finish() override {}
  /// All voxels, over the box of the header.
  [[nodiscard]] BitBox bits() const {
    BitBox all(voxels_of(header.bricks));
    for (const Brick& b : bricks) {
      const VoxelCoord first = first_voxel(b.coord);
      for (std::int32_t z = 0; z < kBrickEdge; ++z)
        for (std::int32_t y = 0; y < kBrickEdge; ++y)
          all.row(first.y + y, first.z + z)[(first.x - all.box().min.x) / 64] = b.bits[std::size_t(z * kBrickEdge + y)];
    }
    return all;
  }
};

[[nodiscard]] inline Backends plain_backends(int n) {
  Backends all;
  for (int i = 0; i < n; ++i) all.push_back(std::make_unique<CpuBackend>());
  return all;
}

/// Appends a closed box with outward faces.
inline void add_box(Triangles& out, const Vec3d& lo, const Vec3d& hi) {
  const auto corner = [&](int i) { return Vec3d{i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]}; };
  const int quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : quads) {
    out.push_back({corner(q[0]), corner(q[1]), corner(q[2])});
    out.push_back({corner(q[0]), corner(q[2]), corner(q[3])});
  }
}

/// Returns two boxes that lie apart, turned and sheared, so that no face of a voxel lies in their sides.
inline Triangles turned_boxes() {
  Triangles scene;
  add_box(scene, {0, 0, 0}, {8, 7, 6});
  add_box(scene, {20, 0, 0}, {27, 9, 6});
  for (TriangleD& t : scene) {
    for (Vec3d& p : t) p = {0.8 * p[0] - 0.6 * p[1], 0.6 * p[0] + 0.8 * p[1], p[2] + 0.3 * p[0]};
  }
  return scene;
}

/// Appends a closed sphere with outward faces, `n` rings; `snap` > 0 rounds coordinates to multiples of it.
inline void add_sphere(Triangles& out, const Vec3d& centre, double radius, int n, double snap = 0) {
  const auto point = [&](int ring, int sector) {
    const double t = 3.14159265358979 * ring / n, p = 3.14159265358979 * (sector % (2 * n)) / n;
    const double s = ring == 0 || ring == n ? 0 : std::sin(t);  // one pole, not 2n
    Vec3d q{centre[0] + radius * s * std::cos(p), centre[1] + radius * s * std::sin(p),
            centre[2] + radius * std::cos(t)};
    if (snap > 0)
      for (double& c : q) c = std::round(c / snap) * snap;
    return q;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const Vec3d a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1), d = point(i, j + 1);
      if (i > 0) out.push_back({a, b, d});
      if (i < n - 1) out.push_back({b, c, d});
    }
}

inline void turn_inside_out(Triangles& t, std::size_t first) {
  for (std::size_t i = first; i < t.size(); ++i) std::swap(t[i][1], t[i][2]);
}

}  // namespace bp::test
