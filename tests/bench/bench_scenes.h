#pragma once
#include <string>
#include <vector>

#include "lib/closing/rotation.h"
#include "lib/grid/bit_box.h"
#include "lib/grid/scale_field.h"
#include "lib/voxel/fixed_triangle.h"

/// Inputs of the closing benchmark: solids voxelized from real models, or generated, scale fields and rotations that
/// are the same integers on every machine.
namespace bp {

struct BenchSolid {
  std::string name;
  BitBox bits;     ///< filled
  VoxelBox tight;  ///< voxels of the model, one of margin
};

/// `what`: an OBJ file, or "plant": generated tanks, pipes and plates. `resolution`: voxels along the longest side.
[[nodiscard]] BenchSolid load_bench_solid(const std::string& what, int resolution);

/// Triangles of a model in voxels, each cut into pieces^2 equal ones; `box` becomes the voxels they may touch.
[[nodiscard]] std::vector<FixedTriangle> load_bench_triangles(const std::string& path, int resolution, int pieces,
                                                              VoxelBox& box);

/// S over `box`: constant, or smooth bumps between `least` and `most`. Sixteenths of a voxel.
[[nodiscard]] ScaleLattice bench_scale(const VoxelBox& box, Scale least, Scale most);

/// Rotations over `box` that turn smoothly from cell to cell.
[[nodiscard]] RotationLattice bench_rotations(const VoxelBox& box);

/// FNV-1a of the words: to compare results between machines.
[[nodiscard]] std::uint64_t bits_hash(const BitBox& bits);

}  // namespace bp
