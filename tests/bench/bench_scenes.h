#pragma once
#include <string>
#include <vector>

#include "lib/grid/bit_box.h"
#include "lib/grid/orientation_field.h"
#include "lib/grid/scale_field.h"
#include "lib/voxel/fixed_triangle.h"

/// Inputs of the closing benchmark: solids voxelized from real models, or generated, scale fields and rotations that
/// are the same integers on every machine.
namespace bp {

struct BenchSolid {
  std::string name;
  BitBox bits;                   ///< filled
  VoxelBox tight;                ///< voxels of the model, one of margin
  OrientationField orientation;  ///< of a stream that has one
};

/// `what`: an OBJ file, or "plant": generated tanks, pipes and plates, or a brick stream (FILE.bpv, of its own
/// resolution). `resolution`: voxels along the longest side.
[[nodiscard]] BenchSolid load_bench_solid(const std::string& what, int resolution);

/// Triangles of a model in voxels, each cut into pieces^2 equal ones; `box` becomes the voxels they may touch.
[[nodiscard]] std::vector<FixedTriangle> load_bench_triangles(const std::string& path, int resolution, int pieces,
                                                              VoxelBox& box);

/// S over `box`: constant, or smooth bumps between `least` and `most`. Sixteenths of a voxel.
[[nodiscard]] ScaleLattice bench_scale(const VoxelBox& box, Scale least, Scale most);

/// One rotation for all voxels: "turned" by 30 degrees about z, or "skew" by 35 about (1, 2, 3).
[[nodiscard]] OrientationField bench_orientation(const std::string& name);

/// FNV-1a of the words: to compare results between machines.
[[nodiscard]] std::uint64_t bits_hash(const BitBox& bits);

}  // namespace bp
