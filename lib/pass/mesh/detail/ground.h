#pragma once
#include <memory>

#include "lib/enclosed/enclosed.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/pass/context.h"
#include "lib/pass/mesh/mesh_params.h"
#include "lib/surface/surface.h"

namespace bp {

/// The voxels of a stream.
struct Shelves {
  std::unique_ptr<BrickShelf> meshed;  // the closing; the solid if the stream has no closing
  std::unique_ptr<BrickShelf> input;   // the solid; null if nothing needs it
};

/// The surface that simplification begins with. A proxy inside a solid is a proxy around its complement, turned over;
/// it must then enclose the complement.
struct Start {
  std::unique_ptr<BrickShelf> around;  // mode inside: the complement of the layer that is meshed
  std::unique_ptr<LatticeMesh> mesh;   // mode inside: its surface
  std::unique_ptr<SurfaceSource> surface;
};

/// Everything that a proxy must enclose, and the surface to which distances are measured, if they are needed.
struct Ground {
  std::unique_ptr<Enclosed> made;      // made for this ground alone
  const Enclosed* enclosed = nullptr;  // the one above, or one that many grounds share; null: nothing is tightened
  std::vector<TriangleD> surface;
  std::unique_ptr<TriangleBvh> tree;

  [[nodiscard]] std::uint64_t bytes() const {
    return (enclosed != nullptr ? enclosed->bytes() : 0) + surface.capacity() * sizeof(TriangleD) +
           (tree ? tree->bytes() : 0);
  }
};

/// Makes the ground. It moves `params.scene` out of `params`. `fill`: the stream's. Throws bad_input if the scene does
/// not lie inside the voxels, and out_of_resource if the surface that distances are measured to does not fit in
/// context.pieces.
[[nodiscard]] Ground make_ground(const Shelves& shelves, MeshParams& params, const Start& start, FillMode fill,
                                 const PassContext& context);

/// Returns about the most bytes that make_ground() takes and keeps, without making it. `triangles`: number of the
/// scene's triangles, which need not be in `params`. flat_faces: faces of the meshed surface after flat regions are
/// merged.
[[nodiscard]] std::uint64_t ground_bytes(const Shelves& shelves, const MeshParams& params, std::uint64_t triangles,
                                         std::uint64_t flat_faces);

}  // namespace bp
