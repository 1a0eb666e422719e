#include "lib/pass/mesh/surface_around.h"

#include "lib/core/error.h"
#include "lib/device/backend.h"
#include "lib/grid/shelf_stream.h"
#include "lib/pass/mesh/complement.h"
#include "lib/pass/voxelize/triangle_list.h"
#include "lib/pass/voxelize/voxelize_pass.h"
#include "lib/quads/quads.h"
#include "lib/simplify/surface_tree.h"
#include "lib/store/memory_scratch.h"
#include "lib/surface/repair.h"
#include "lib/surface/surface.h"

namespace bp {

namespace {

std::vector<TriangleD> in_world(const LatticeMesh& mesh, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<TriangleD> out;
  out.reserve(triangles.size());
  for (const auto& t : triangles) {
    out.push_back({mesh.frame.world(mesh.vertices[t[0]]), mesh.frame.world(mesh.vertices[t[1]]),
                   mesh.frame.world(mesh.vertices[t[2]])});
  }
  return out;
}

}  // namespace

std::vector<TriangleD> world_triangles(const LatticeMesh& mesh) {
  return in_world(mesh, mesh.triangles);
}

std::vector<TriangleD> drawable_world_triangles(const LatticeMesh& mesh) {
  return in_world(mesh, drawable_triangles(mesh));
}

namespace {

/// Makes the voxels of a mesh as bpvox does. Returns their frame.
GridFrame voxelize_mesh(const LatticeMesh& mesh, double voxel, FillMode fill, const ShelfFactory& make_shelf,
                        const PieceMemory& memory, BrickShelf& shelf) {
  const std::vector<TriangleD> triangles = drawable_world_triangles(mesh);
  TriangleList source("level", triangles);
  ShelfSink sink(&shelf);
  VoxelizeOptions options;
  options.voxel_size = [voxel](const Bounds3d&) { return voxel; };
  options.fill = fill;
  options.up = mesh.frame.up;
  const PieceMemory left =
      memory.without(2 * triangles.size() * sizeof(TriangleD));  // as they are read, there are two copies
  options.context.memory.bytes = left.waiting_bytes;
  options.tile_memory_bytes = left.work_bytes;
  options.context.make_shelf = make_shelf;
  options.context.make_scratch = memory.make_scratch;
  if (!options.context.make_scratch) options.context.make_scratch = [] { return std::make_unique<MemoryScratch>(); };
  GridFrame frame;
  const auto open = [&](const StreamHeader& header, const VoxelizeCounts&) -> BrickSink& {
    frame = header.frame;
    return sink;
  };
  voxelize_stream(source, open, options);
  return frame;
}

void take_away(const BrickShelf& less, BrickShelf& from) {
  BrickBits bits, gone;
  for (const BrickCoord& c : less.coords()) {
    from.get(c, bits);
    less.get(c, gone);
    for (std::size_t i = 0; i < bits.size(); ++i) bits[i] &= ~gone[i];
    from.put(c, classify(bits), bits);
  }
}

/// Returns the surface of the voxels that lie inside the mesh; empty if no voxel of that size does.
LatticeMesh surface_of_voxels_within(const LatticeMesh& mesh, double voxel, const ShelfFactory& make_shelf,
                                     const PieceMemory& memory) {
  const auto shelf = make_shelf(), around = make_shelf(), touched = make_shelf();
  const GridFrame frame = voxelize_mesh(mesh, voxel, FillMode::winding, make_shelf, memory, *shelf);
  voxelize_mesh(mesh, voxel, FillMode::none, make_shelf, memory, *touched);
  take_away(*touched, *shelf);
  check_dense(count_faces(ShelfSurface(*shelf, frame)), memory);
  return inward_surface(*shelf, frame, make_shelf, *around);
}

}  // namespace

GridFrame voxels_around(const LatticeMesh& inner, double voxel, const ShelfFactory& make_shelf,
                        const PieceMemory& memory, BrickShelf& around) {
  const GridFrame frame = voxelize_mesh(inner, voxel, FillMode::flood, make_shelf, memory, around);
  repair_contacts(around);
  return frame;
}

LatticeMesh surface_within(const LatticeMesh& outer, double voxel, const ShelfFactory& make_shelf,
                           const PieceMemory& memory) {
  constexpr int kMostHalvings = 6;
  // A point between the two diagonals of a quad is inside only for some choices, so the innermost choice is used. The
  // filling is by winding numbers: a flood would fill cavities, which are outside.
  const LatticeMesh innermost = innermost_choice(outer);
  for (int halvings = 0; halvings <= kMostHalvings; ++halvings, voxel /= 2) {
    LatticeMesh surface = surface_of_voxels_within(innermost, voxel, make_shelf, memory);
    if (!surface.triangles.empty()) return surface;
  }
  fail(ErrorCode::bad_input, {Remedy::smaller_voxels}, "the inside of the scene is too thin for one more level");
}

std::unique_ptr<BrickShelf> repaired_within(const BrickShelf& solid, const ShelfFactory& make_shelf,
                                            BrickShelf& around) {
  const BrickBox box = bricks_around(solid);
  complement(solid, box, around);
  repair_contacts(around);
  auto left = make_shelf();
  complement(around, box, *left);
  return left;
}

LatticeMesh inward_surface(const BrickShelf& solid, const GridFrame& frame, const ShelfFactory& make_shelf,
                           BrickShelf& around) {
  LatticeMesh surface = dense_surface(*repaired_within(solid, make_shelf, around), frame);
  turn_over(surface);
  return surface;
}

void turn_over(LatticeMesh& mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

}  // namespace bp
