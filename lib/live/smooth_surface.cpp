#include "lib/live/smooth_surface.h"

#include "lib/core/parallel.h"
#include "lib/live/surface_piece.h"

namespace bp {

namespace {

void append(const SurfacePiece& piece, double cell, const Vec3d& origin, SmoothSurface& out) {
  const VoxelCoord first = first_voxel(piece.brick);
  std::vector<Vec3d> places;
  std::vector<PackedNormal> normals;
  for (const SurfacePiece::Vertex& v : piece.vertices) {
    Vec3d p{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double moved = double(v.position[i]) / SurfacePiece::kPerVoxel - SurfacePiece::kOrigin;
      p[i] = origin[i] + (double(first[int(i)]) + moved) * cell;
    }
    places.push_back(p);
    normals.push_back(pack_normal({double(v.normal[0]), double(v.normal[1]), double(v.normal[2])}));
  }
  for (const auto& t : piece.triangles) {
    out.triangles.push_back({places[t[0]], places[t[1]], places[t[2]]});
    out.normals.push_back({normals[t[0]], normals[t[1]], normals[t[2]]});
  }
}

}  // namespace

SmoothSurface smooth_surface(const BitBox& cells, std::int32_t cell_voxels, const GridFrame& frame) {
  std::vector<BrickCoord> bricks;
  if (!cells.box().empty()) for_each(bricks_of(cells.box()), [&](BrickCoord c) { bricks.push_back(c); });
  std::vector<SurfacePiece> pieces(bricks.size());
  parallel_for(std::int64_t(bricks.size()),
               [&](std::int64_t i) { pieces[std::size_t(i)] = piece_of(cells, bricks[std::size_t(i)]); });
  SmoothSurface out;
  for (SurfacePiece& piece : pieces) {
    append(piece, cell_voxels * frame.voxel, frame.world_origin(), out);
    piece = {};
  }
  return out;
}

}  // namespace bp
