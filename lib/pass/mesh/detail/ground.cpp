#include "lib/pass/mesh/detail/ground.h"

#include "lib/core/error.h"
#include "lib/enclosed/enclosed_scene.h"
#include "lib/enclosed/enclosed_triangles.h"
#include "lib/enclosed/enclosed_voxels.h"
#include "lib/pass/mesh/complement.h"
#include "lib/pass/mesh/scene_check.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/simplify/flatten.h"
#include "lib/simplify/surface_tree.h"
#include "lib/volume/boundary_rects.h"

namespace bp {

namespace {

bool needs_distances(const MeshParams& params) {
  const bool target = params.mode == MeshMode::fit && params.enclose == Enclose::scene;
  return params.error_world > 0 || params.distances || target;
}

/// Returns the triangles of the surface, with flat regions merged.
std::vector<TriangleD> merged_triangles(const SurfaceSource& surface, const PieceMemory& memory) {
  SimplifyParams params;
  params.memory = memory;
  SimplifyCounts counts;
  Piece whole = simplified_surface(surface, params, {}, counts);
  HalfEdgeMesh mesh(std::move(whole.vertices), whole.triangles, kEverywhere);
  merge_flat_regions(mesh);
  return world_triangles(mesh.compact(surface.frame()));
}

/// Returns the triangles of the voxels' surface as rectangles. The voxels may touch along edges, so that
/// merged_triangles() cannot merge their faces.
std::vector<TriangleD> rect_triangles(const BrickShelf& shelf, const GridFrame& frame, const PieceMemory& memory) {
  const std::vector<FaceRect> rects = boundary_rects(shelf);
  const std::uint64_t n = 2 * rects.size();
  const std::uint64_t bytes = rects.size() * sizeof(FaceRect) + TriangleBvh::bytes_with_triangles(n);
  if (bytes > memory.bytes())
    throw NeedsMemory("the surface that distances are measured from", bytes, memory.bytes(), memory.limit_for(bytes),
                      {Remedy::larger_voxels});
  std::vector<TriangleD> triangles;
  triangles.reserve(n);
  for (const FaceRect& r : rects) {
    for (const TriangleD& t : triangles_of(r, frame)) triangles.push_back(t);
  }
  return triangles;
}

/// Makes the test for a scene of few triangles. Returns null for other scenes, and if voxels are filled where no
/// triangle is near.
std::unique_ptr<NearTriangles> near_triangles(const std::vector<TriangleD>& scene, const GridFrame& frame,
                                              FillMode fill) {
  if (fill == FillMode::winding || scene.empty() || scene.size() > MeshParams::kSimpleScene) return nullptr;
  return std::make_unique<NearTriangles>(scene, frame);
}

std::unique_ptr<Enclosed> make_enclosed(const Shelves& shelves, MeshParams& params, const Start& start, FillMode fill,
                                        const ShelfFactory& make_shelf) {
  if (params.enclose == Enclose::scene) {
    const GridFrame& frame = start.surface->frame();
    if (params.mode == MeshMode::bounding && !params.part)
      require_within(params.scene, params.rounding, frame, *shelves.meshed);
    if (params.near_world && params.mode == MeshMode::bounding) {
      auto near = params.part ? nullptr : near_triangles(params.scene, frame, fill);
      return std::make_unique<EnclosedScene>(std::move(params.scene), frame, *shelves.input, params.part,
                                             std::move(near), params.rounding);
    }
    return std::make_unique<EnclosedTriangles>(std::move(params.scene), frame, std::nullopt, params.rounding);
  }
  if (params.enclose == Enclose::closing)
    return std::make_unique<EnclosedVoxels>(start.around ? *start.around : *shelves.meshed);
  if (params.mode == MeshMode::bounding) return std::make_unique<EnclosedVoxels>(*shelves.input);
  const auto around = make_shelf();
  complement(*shelves.input, bricks_around(*shelves.input), *around);
  return std::make_unique<EnclosedVoxels>(*around);
}

}  // namespace

std::unique_ptr<Enclosed> enclosed_scene(std::vector<TriangleD> triangles, const Rounding& rounding,
                                         const StreamHeader& header, const BrickShelf& solid) {
  auto near = near_triangles(triangles, header.frame, header.fill);
  return std::make_unique<EnclosedScene>(std::move(triangles), header.frame, solid, std::nullopt, std::move(near),
                                         rounding);
}

std::uint64_t ground_bytes(const Shelves& shelves, const MeshParams& params, std::uint64_t triangles,
                           std::uint64_t flat_faces) {
  std::uint64_t sum = 0;
  if (needs_distances(params)) {
    const Enclose to = params.distances_to.value_or(params.enclose);
    sum += to == Enclose::scene   ? triangles * sizeof(TriangleD) + TriangleBvh::bytes_with_triangles(triangles)
           : to == Enclose::input ? TriangleBvh::bytes_with_triangles(2 * boundary_rects(*shelves.input).size())
                                  : TriangleBvh::bytes_with_triangles(flat_faces);
  }
  if (!params.tighten) return sum;
  if (params.enclosed != nullptr) return sum + params.enclosed->bytes();
  if (params.enclose == Enclose::scene && params.mode != MeshMode::fit)
    sum += triangles * EnclosedTriangles::kBytesEach;
  const bool by_voxels = params.enclose != Enclose::scene || params.near_world || params.mode == MeshMode::fit;
  return by_voxels ? sum + EnclosedVoxels(shelves.input ? *shelves.input : *shelves.meshed).bytes() : sum;
}

Ground make_ground(const Shelves& shelves, MeshParams& params, const Start& start, FillMode fill,
                   const PassContext& context) {
  Ground ground;
  if (needs_distances(params)) {
    const Enclose to = params.distances_to.value_or(params.enclose);
    ground.surface = to == Enclose::scene   ? params.scene
                     : to == Enclose::input ? rect_triangles(*shelves.input, start.surface->frame(), context.pieces)
                                            : merged_triangles(*start.surface, context.pieces);
    ground.tree = std::make_unique<TriangleBvh>(ground.surface);
  }
  ground.enclosed = params.tighten && params.mode != MeshMode::fit ? params.enclosed : nullptr;
  if (params.tighten && params.mode != MeshMode::fit && ground.enclosed == nullptr) {
    ground.made = make_enclosed(shelves, params, start, fill, context.make_shelf);
    ground.enclosed = ground.made.get();
  }
  return ground;
}

}  // namespace bp
