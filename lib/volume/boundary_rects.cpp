#include "lib/volume/boundary_rects.h"

#include <array>
#include <bit>

#include "lib/core/parallel.h"
#include "lib/grid/clip.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

/// The faces in one plane: bit u of row v.
using Plane = std::array<std::uint64_t, kBrickEdge>;

/// Calls add(u, v, width, height) for rectangles that together hold each face once. It clears the plane.
template <class Add>
void take_rects(Plane& plane, const Add& add) {
  for (std::size_t v = 0; v < plane.size(); ++v) {
    while (plane[v] != 0) {
      const int u = std::countr_zero(plane[v]), width = std::countr_one(plane[v] >> u);
      const std::uint64_t run = (width == kBrickEdge ? ~std::uint64_t(0) : (std::uint64_t(1) << width) - 1) << u;
      std::size_t end = v;
      for (; end < plane.size() && (plane[end] & run) == run; ++end) plane[end] &= ~run;
      add(u, int(v), width, int(end - v));
    }
  }
}

class BrickFaces {
 public:
  BrickFaces(const BrickShelf& solid, BrickCoord brick, std::vector<FaceRect>& rects)
      : first_(first_voxel(brick)), voxels_(voxels_of(brick).grown(1)), rects_(rects) {
    load_voxels(solid, voxels_);
  }

  void run() {
    for (const int side : {0, 1}) {
      for (int i = 0; i < kBrickEdge; ++i) {
        const int step = side == 1 ? 1 : -1;
        Plane y{}, z{};
        for (int v = 0; v < kBrickEdge; ++v) {
          y[std::size_t(v)] = row(i, v)[1] & ~row(i + step, v)[1];
          z[std::size_t(v)] = row(v, i)[1] & ~row(v, i + step)[1];
        }
        take_rects(y, [&](int u, int v, int w, int h) { add({u, i + side, v}, {u + w, i + side, v + h}); });
        take_rects(z, [&](int u, int v, int w, int h) { add({u, v, i + side}, {u + w, v + h, i + side}); });
      }
      across_x(side);
    }
  }

 private:
  [[nodiscard]] const std::uint64_t* row(int y, int z) const { return voxels_.row(first_.y + y, first_.z + z); }

  /// Turns the bits of rows along x into planes of equal x, whose rows run along y.
  void across_x(int side) {
    std::array<Plane, kBrickEdge> planes{};
    for (int z = 0; z < kBrickEdge; ++z) {
      for (int y = 0; y < kBrickEdge; ++y) {
        const std::uint64_t* r = row(y, z);
        const std::uint64_t beside = side == 1 ? r[1] >> 1 | r[2] << 63 : r[1] << 1 | r[0] >> 63;
        for (std::uint64_t faces = r[1] & ~beside; faces != 0; faces &= faces - 1)
          planes[std::size_t(std::countr_zero(faces))][std::size_t(z)] |= std::uint64_t(1) << y;
      }
    }
    for (int x = 0; x < kBrickEdge; ++x) {
      take_rects(planes[std::size_t(x)], [&](int u, int v, int w, int h) {
        add({x + side, u, v}, {x + side, u + w, v + h});
      });
    }
  }

  void add(const VoxelCoord& min, const VoxelCoord& max) { rects_.push_back({first_ + min, first_ + max}); }

  const VoxelCoord first_;
  BitBox voxels_;
  std::vector<FaceRect>& rects_;
};

}  // namespace

std::array<TriangleD, 2> triangles_of(const FaceRect& rect, const GridFrame& frame) {
  const int across = rect.min.x == rect.max.x ? 0 : rect.min.y == rect.max.y ? 1 : 2, u = across == 0 ? 1 : 0;
  VoxelCoord b = rect.min, d = rect.max;
  b[u] = rect.max[u];
  d[u] = rect.min[u];
  const auto world = [&](const VoxelCoord& c) {
    return frame.world({std::int64_t(c.x) * kLatticePerVoxel, std::int64_t(c.y) * kLatticePerVoxel,
                        std::int64_t(c.z) * kLatticePerVoxel});
  };
  return {TriangleD{world(rect.min), world(b), world(rect.max)}, TriangleD{world(rect.min), world(rect.max), world(d)}};
}

std::vector<FaceRect> boundary_rects(const BrickShelf& solid) {
  const std::vector<BrickCoord> bricks = solid.coords();
  std::vector<std::vector<FaceRect>> parts(bricks.size());
  parallel_for(std::int64_t(bricks.size()), [&](std::int64_t i) {
    const BrickCoord brick = bricks[std::size_t(i)];
    if (!is_buried(solid, brick)) BrickFaces(solid, brick, parts[std::size_t(i)]).run();
  });
  std::vector<FaceRect> all;
  for (std::vector<FaceRect>& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
    std::vector<FaceRect>().swap(part);
  }
  return all;
}

}  // namespace bp
