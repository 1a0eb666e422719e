#include "lib/levels/voxel_choice.h"

#include <algorithm>
#include <cmath>

#include "lib/pass/voxelize/voxelize_pass.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

// Like kDensePerFace, if the voxels are chosen from a budget of faces.
constexpr std::uint64_t kDensePerFaceAsked = 190;

/// Returns the surface of the cube that has the box's volume, since a flat scene shows its contents along its
/// thickness, too.
double area_of_cube_like(const Bounds3d& b) {
  constexpr double kFlattest = 1.0 / 64;
  double volume = 1;
  for (std::size_t i = 0; i < 3; ++i) volume *= std::max(b.max[i] - b.min[i], kFlattest * b.longest_side());
  const double edge = std::cbrt(volume);
  return 6 * edge * edge;
}

/// Returns the edge for a dense surface of `dense_faces` triangles over `area`. It is at most that of the default
/// resolution, and at least that of the resolution `most`.
double voxel_for(double dense_faces, double area, const Bounds3d& bounds, std::int64_t most) {
  const double coarse = voxel_size_of(bounds, kDefaultResolution);
  const double fine = std::min(coarse, std::sqrt(kDensePerArea * area / dense_faces));
  return std::min(coarse, std::max(fine, voxel_size_of(bounds, most)));
}

}  // namespace

double area_of(const Bounds3d& b) {
  const double x = b.max[0] - b.min[0], y = b.max[1] - b.min[1], z = b.max[2] - b.min[2];
  return 2 * (x * y + y * z + z * x);
}

Bounds3d bounds_of(const VoxelBox& box, const GridFrame& frame, std::int64_t by) {
  const LatticeCoord all{by, by, by}, min{box.min.x, box.min.y, box.min.z}, max{box.max.x, box.max.y, box.max.z};
  Bounds3d bounds;
  bounds.add(frame.world(min * kLatticePerVoxel - all));
  bounds.add(frame.world(max * kLatticePerVoxel + all));
  return bounds;
}

double chosen_voxel(const VoxelRequest& voxels, const LevelRequest& levels, const SceneSize& scene) {
  const Bounds3d& bounds = scene.bounds;
  if (voxels.voxel > 0) return voxels.voxel;
  if (voxels.resolution > 0) return voxel_size_of(bounds, voxels.resolution);
  if (!levels.errors_world.empty()) return levels.errors_world.front() / kVoxelsPerLength;
  if (voxels.use == VoxelUse::occluder) return voxel_size_of(bounds, kOccluderResolution);
  if (voxels.use == VoxelUse::tiles) {
    if (!levels.faces.empty()) return voxel_size_of(bounds, kDefaultResolution);
    const double faces = double(std::min(scene.triangles, kTilesetFaces));
    return voxel_for(double(kDensePerFace) * faces, area_of_cube_like(bounds), bounds, kMostTilesetResolution);
  }
  if (levels.faces.empty()) return voxel_size_of(bounds, kDefaultResolution);
  const double faces = std::min(double(levels.faces.front()), double(kFacesPerTriangle) * double(scene.triangles));
  const double dense = std::max(double(kDensePerFaceAsked) * faces, kLeastDenseFaces);
  return voxel_for(dense, area_of(bounds), bounds, kMostResolution);
}

}  // namespace bp
