#pragma once
#include <cmath>
#include <memory>
#include <vector>

#include "lib/check/check_proxy.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "tests/catch.h"
#include "tests/support/memory_scene.h"
#include "tests/support/memory_store.h"
#include "tests/support/proxy_checks.h"
#include "tests/support/voxel_source.h"

/// The shape that most tests of this pass mesh.
namespace bp::test {

const VoxelBox kBox{{0, 0, 0}, {48, 48, 48}};

inline double length_of(double x, double y, double z) {
  return std::sqrt(x * x + y * y + z * z);
}

/// Two balls that a rod joins, and a crumb beside them.
inline bool dumbbell(VoxelCoord p) {
  return length_of(p.x - 14, p.y - 24, p.z - 24) < 10 || length_of(p.x - 36, p.y - 24, p.z - 24) < 7 ||
         (p.x > 10 && p.x < 40 && length_of(0, p.y - 24, p.z - 24) < 3) || length_of(p.x - 40, p.y - 6, p.z - 8) < 3;
}

inline std::vector<LatticeMesh> mesh(const MeshParams& params, MeshCounts& counts, const Solid& solid = dumbbell,
                                     const PassContext& context = memory_context()) {
  VoxelSource source(kBox, solid);
  return mesh_stream(source, context, params, counts);
}

/// A sound proxy that strictly encloses `inner`, if given.
inline void check(const LatticeMesh& proxy, const std::vector<TriangleD>* inner) {
  const IndexedMesh mesh = indexed(proxy);
  std::unique_ptr<MemorySource> scene;
  if (inner != nullptr) scene = std::make_unique<MemorySource>(*inner);
  CheckOptions options;
  options.distances = false;
  const CheckReport report = check_proxy(mesh, scene.get(), options);
  CHECK(report.holds());
}

/// Triangles of the voxels' cubes, moved inwards so little that they stay in the open solid.
inline std::vector<TriangleD> points_inside() {
  std::vector<TriangleD> all;
  for (VoxelCoord p = kBox.min; p.z < kBox.max.z; ++p.z) {
    for (p.y = 0; p.y < 48; ++p.y) {
      for (p.x = 0; p.x < 48; ++p.x) {
        if (!dumbbell(p)) continue;
        const double l = 1.0 / 128, h = 1 - l, x = p.x, y = p.y, z = p.z;
        all.push_back({Vec3d{x + l, y + l, z + l}, Vec3d{x + h, y + h, z + l}, Vec3d{x + l, y + h, z + h}});
        all.push_back({Vec3d{x + h, y + l, z + h}, Vec3d{x + h, y + l, z + l}, Vec3d{x + l, y + l, z + h}});
      }
    }
  }
  return all;
}

}  // namespace bp::test
