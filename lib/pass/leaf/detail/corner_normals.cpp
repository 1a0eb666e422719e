#include "lib/pass/leaf/detail/corner_normals.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/mesh/shaded_mesh.h"

namespace bp {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kMostFaces = 64;  // faces at a point

/// A corner of a face: 3 * triangle + place in it.
using Corner = std::uint32_t;

double angle_at(const TriangleD& t, std::size_t k) {
  const Vec3d u = t[(k + 1) % 3] - t[k], v = t[(k + 2) % 3] - t[k];
  return std::atan2(length(cross(u, v)), dot(u, v));
}

class CornerNormals {
 public:
  explicit CornerNormals(std::span<const TriangleD> triangles) : triangles_(triangles), out_(triangles.size()) {
    for (const TriangleD& t : triangles) {
      const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
      const double l = length(n);
      faces_.push_back(l > 0 ? (1 / l) * n : Vec3d{0, 0, 1});
    }
  }

  std::vector<std::array<Vec3d, 3>> run(const Bounds3d& box) {
    std::vector<Corner> corners(3 * triangles_.size());
    for (Corner c = 0; c < corners.size(); ++c) corners[c] = c;
    std::sort(corners.begin(), corners.end(),
              [&](Corner a, Corner b) { return at(a) != at(b) ? at(a) < at(b) : a < b; });
    for (std::size_t i = 0, end = 0; i < corners.size(); i = end) {
      while (end < corners.size() && at(corners[end]) == at(corners[i])) ++end;
      const std::span<const Corner> here(&corners[i], end - i);
      const bool alone = here.size() > kMostFaces || !overlap(box, Bounds3d{at(here[0]), at(here[0])});
      for (const Corner c : here) out_[c / 3][c % 3] = alone ? faces_[c / 3] : joined(c, here);
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] const Vec3d& at(Corner c) const { return triangles_[c / 3][c % 3]; }
  [[nodiscard]] Vec3d joined(Corner c, std::span<const Corner> here) const {
    static const double least = std::cos(kCreaseDegrees * kPi / 180);
    const Vec3d& own = faces_[c / 3];
    Vec3d sum{};
    for (const Corner d : here) {
      const Vec3d& n = faces_[d / 3];
      if (dot(own, n) >= least) sum = sum + angle_at(triangles_[d / 3], d % 3) * n;
    }
    const double l = length(sum);
    return l > 0 ? (1 / l) * sum : own;
  }

  std::span<const TriangleD> triangles_;
  std::vector<Vec3d> faces_;
  std::vector<std::array<Vec3d, 3>> out_;
};

}  // namespace

std::vector<std::array<Vec3d, 3>> corner_normals(std::span<const TriangleD> triangles, const Bounds3d& box) {
  return CornerNormals(triangles).run(box);
}

}  // namespace bp
