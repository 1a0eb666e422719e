#include "lib/enclosed/near_triangles.h"

#include <algorithm>

#include "lib/core/vec3.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

constexpr double kBesideVoxels = 0.87 * kLatticePerVoxel;  // half the diagonal of a voxel

std::vector<TriangleD> in_lattice(std::vector<TriangleD> triangles, const GridFrame& frame) {
  for (TriangleD& t : triangles) {
    for (Vec3d& p : t) p = frame.to_lattice(p);
  }
  return triangles;
}

}  // namespace

NearTriangles::NearTriangles(const std::vector<TriangleD>& triangles, const GridFrame& frame)
    : tree_(in_lattice(triangles, frame)) {}

bool NearTriangles::is_near(std::span<const NewFace> faces, double distance) const {
  distance += kBesideVoxels;
  const double far = kUpTo * distance;
  std::uint32_t guess = 0;
  const auto is_far = [&](const LatticeCoord& corner) {
    const auto [squared, item] = tree_.near_enough(to_double(corner), far * far, guess);
    guess = item;
    return squared > far * far;
  };
  return std::all_of(faces.begin(), faces.end(), [&](const NewFace& f) {
    if (std::any_of(f.corners.begin(), f.corners.end(), is_far)) return false;
    return is_near({to_double(f.corners[0]), to_double(f.corners[1]), to_double(f.corners[2])}, distance, guess);
  });
}

/// Tests the corners: the distance from a triangle, which is convex, is largest at a corner. `guess`: a triangle near
/// the face.
bool NearTriangles::is_near(const TriangleD& face, double distance, std::uint32_t& guess) const {
  constexpr double kUnsure = 0.3;  // a face with edges shorter than this share of the distance is not halved
  const auto reaches = [&](std::uint32_t item) {
    return std::all_of(face.begin(), face.end(), [&](const Vec3d& p) {
      return distance_squared(p, tree_.item(item).corners) <= distance * distance;
    });
  };
  if (reaches(guess)) return true;
  const Vec3d middle = (1.0 / 3) * (face[0] + face[1] + face[2]);
  const auto from_middle = [&](const Vec3d& p) { return length(p - middle); };
  const double spare = distance - std::max({from_middle(face[0]), from_middle(face[1]), from_middle(face[2])});
  const auto [squared, item] = tree_.near_enough(middle, spare > 0 ? spare * spare : -1, guess);
  guess = item;
  if (squared > distance * distance) return false;
  if (reaches(item)) return true;
  const auto edge = [&](std::size_t k) { return length(face[(k + 1) % 3] - face[k]); };
  if (std::max({edge(0), edge(1), edge(2)}) < kUnsure * distance) return true;
  const std::array<Vec3d, 3> m = {0.5 * (face[0] + face[1]), 0.5 * (face[1] + face[2]), 0.5 * (face[2] + face[0])};
  return is_near(m, distance, guess) && is_near({face[0], m[0], m[2]}, distance, guess) &&
         is_near({m[0], face[1], m[1]}, distance, guess) && is_near({m[2], m[1], face[2]}, distance, guess);
}

}  // namespace bp
