#include "lib/levels/detail/shown_scene.h"

#include <algorithm>
#include <cmath>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/geometry/spread.h"
#include "lib/geometry/surface_distance.h"
#include "lib/geometry/triangle_parts.h"
#include "lib/levels/detail/voxel_distance.h"

namespace bp {

namespace {

constexpr double kCentreToCorner = 0.87;
constexpr double kFaceToVoxel = 1.25;  // from the middle of a face to any point of its voxel, and rounding; in voxels

std::uint64_t faces_in(const FaceRect& r) {
  std::uint64_t n = 1;
  for (int i = 0; i < 3; ++i) n *= std::uint64_t(std::max(r.max[i] - r.min[i], 1));
  return n;
}

/// Calls f(middle) for each face of the rectangle.
template <class F>
void for_each_face(const FaceRect& r, F&& f) {
  const auto last = [&](int i) { return std::max(r.max[i] - 1, r.min[i]); };
  const auto middle = [&](int i, std::int32_t at) {
    return std::int64_t(at) * kLatticePerVoxel + (r.max[i] > r.min[i] ? kLatticePerVoxel / 2 : 0);
  };
  for (std::int32_t z = r.min.z; z <= last(2); ++z) {
    for (std::int32_t y = r.min.y; y <= last(1); ++y) {
      for (std::int32_t x = r.min.x; x <= last(0); ++x) f(LatticeCoord{middle(0, x), middle(1, y), middle(2, z)});
    }
  }
}

/// Appends the part of the triangle that lies in the box.
void clip(const TriangleD& t, const Bounds3d& box, std::vector<Polygon>& out) {
  const auto cut_at = [&](Polygon p, const Vec3d& corner, double inwards) {
    for (std::size_t k = 0; k < 3 && p.count > 0; ++k) {
      Vec3d n{};
      n[k] = inwards;
      p = cut(p, corner, n).inside;
    }
    return p;
  };
  const Polygon above = cut_at(Polygon(t), box.min, 1);
  for (std::size_t i = 0; i < above.triangles(); ++i) {
    const Polygon within = cut_at(Polygon(above.triangle(i)), box.max, -1);
    if (within.count > 0) out.push_back(within);
  }
}

/// Finds how far the scene reaches out of a mesh: the largest distance to the mesh among those parts of the scene that
/// are not inside it.
class Beyond {
 public:
  Beyond(const TriangleBvh& mesh, double at_least) : mesh_(mesh), largest_(at_least) {}

  /// Returns whether no part within the ball can change the result.
  [[nodiscard]] bool is_settled(const Vec3d& centre, double radius) {
    const TriangleBvh::Nearest found = mesh_.nearest(centre, guess_);
    guess_ = found.item;
    const double distance = std::sqrt(found.distance_squared);
    return distance + radius <= largest_ || (distance > radius && winding_number(mesh_, centre) >= 1);
  }

  void meet(const Polygon& part) {
    Vec3d centre{};
    for (std::size_t i = 0; i < part.count; ++i) centre = centre + 1.0 / double(part.count) * part.corners[i];
    const TriangleBvh::Nearest found = mesh_.nearest(centre, guess_);
    guess_ = found.item;
    double far = 0, radius = 0;
    for (std::size_t i = 0; i < part.count; ++i) {
      far = std::max(far, distance_squared(part.corners[i], mesh_.item(guess_).corners));
      radius = std::max(radius, length_squared(part.corners[i], centre));
    }
    if (std::sqrt(far) <= largest_) return;
    const bool is_on_one_side = found.distance_squared > radius;
    if (!is_on_one_side || winding_number(mesh_, centre) < 1) largest_ = std::sqrt(far);
  }

  [[nodiscard]] double largest() const { return largest_; }

 private:
  const TriangleBvh& mesh_;
  double largest_;
  std::uint32_t guess_ = 0;
};

}  // namespace

std::vector<TriangleD> shown_points(std::span<const FaceRect> faces, const TriangleBvh& scene, const GridFrame& frame) {
  std::uint64_t area = 0;
  for (const FaceRect& r : faces) area += faces_in(r);
  const double share = double(kMostShownPoints) / double(std::max<std::uint64_t>(area, 1));
  const double most = std::pow(kFaceToVoxel * frame.voxel, 2);
  const auto n = std::int64_t(faces.size());
  std::vector<std::vector<TriangleD>> found(std::size_t((n + kItemsAtOnce - 1) / kItemsAtOnce));
  std::vector<char> misses(found.size(), 0);
  parallel_ranges(n, kItemsAtOnce, [&](std::int64_t begin, std::int64_t end) {
    std::uint32_t guess = 0;
    const auto grain = std::size_t(begin / kItemsAtOnce);
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
      for_each_face(faces[i], [&](const LatticeCoord& middle) {
        if (share < 1 && !is_among(middle, share)) return;
        const Vec3d p = frame.world(middle);
        const TriangleBvh::Nearest nearest = scene.nearest(p, guess);
        guess = nearest.item;
        if (nearest.distance_squared > most) misses[grain] = 1;
        const Vec3d q = nearest_point(p, scene.item(guess).corners);
        found[grain].push_back({q, q, q});
      });
    }
  });
  std::vector<TriangleD> points;
  if (std::count(misses.begin(), misses.end(), 1) > 0) return points;
  for (const auto& some : found) points.insert(points.end(), some.begin(), some.end());
  return points;
}

double distance_beyond_mesh(std::span<const VoxelRun> runs, const std::vector<TriangleD>& segments,
                            const TriangleBvh& scene, const GridFrame& frame, const TriangleBvh& mesh,
                            double at_least) {
  const std::vector<std::uint32_t> left = far_segments(segments, mesh, frame.voxel, at_least);
  const auto n = std::int64_t(left.size());
  std::vector<double> largest(std::size_t((n + kItemsAtOnce - 1) / kItemsAtOnce), at_least);
  parallel_ranges(n, kItemsAtOnce, [&](std::int64_t begin, std::int64_t end) {
    Beyond beyond(mesh, at_least);
    std::vector<Polygon> parts;
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
      const VoxelRun& run = runs[left[i]];
      for (std::int32_t k = 0; k < run.length; ++k) {
        const VoxelCoord v{run.first.x + k, run.first.y, run.first.z};
        const auto corner = [&](std::int64_t d) {
          return frame.world(LatticeCoord{v.x + d, v.y + d, v.z + d} * kLatticePerVoxel);
        };
        Bounds3d box;
        box.add(corner(0)), box.add(corner(1));
        if (beyond.is_settled(0.5 * (box.min + box.max), kCentreToCorner * frame.voxel)) continue;
        parts.clear();
        scene.visit(box, [&](const TriangleBvh::Item& item) { return clip(item.corners, box, parts), false; });
        for (const Polygon& part : parts) beyond.meet(part);
      }
    }
    largest[std::size_t(begin / kItemsAtOnce)] = beyond.largest();
  });
  return largest.empty() ? at_least : *std::max_element(largest.begin(), largest.end());
}

}  // namespace bp
