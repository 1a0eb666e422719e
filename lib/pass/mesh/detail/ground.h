#pragma once
#include <memory>

#include "lib/enclosed/enclosed.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/pass/mesh/mesh_pass.h"

namespace bp {

/// The voxels of a stream.
struct Shelves {
  std::unique_ptr<BrickShelf> meshed;  // the closing, or the solid of a stream without one
  std::unique_ptr<BrickShelf> input;   // the solid; null if nobody asks for it
};

/// The surface that simplification begins with. A proxy inside is one around the complement, turned over: what must
/// stay "inside" is then what surrounds it.
struct Start {
  std::unique_ptr<BrickShelf> around;  // inside: the complement of the layer that is meshed
  std::unique_ptr<LatticeMesh> mesh;   // inside: its surface
  std::unique_ptr<SurfaceSource> surface;
};

/// What must stay inside, and its surface where distances to it are asked for.
struct Ground {
  std::unique_ptr<Enclosed> made;      // for this ground
  const Enclosed* enclosed = nullptr;  // that, or what many grounds share; null: nothing is tightened
  std::vector<TriangleD> surface;
  std::unique_ptr<TriangleBvh> tree;

  [[nodiscard]] std::uint64_t bytes() const {
    return (enclosed != nullptr ? enclosed->bytes() : 0) + surface.capacity() * sizeof(TriangleD) +
           (tree ? tree->bytes() : 0);
  }
};

/// `params.scene` is moved out of it. `fill`: of the stream. Throws bad_input if the scene does not lie inside the
/// voxels, out_of_resource if the surface that distances are measured to does not fit in context.pieces.
[[nodiscard]] Ground make_ground(const Shelves& shelves, MeshParams& params, const Start& start, FillMode fill,
                                 const PassContext& context);

/// Returns the bytes that make_ground() takes and keeps, at most about, in place of making it. `triangles`: of the
/// scene, which need not be in `params`. flat_faces: of the surface of what is meshed, with flat regions merged.
[[nodiscard]] std::uint64_t ground_bytes(const Shelves& shelves, const MeshParams& params, std::uint64_t triangles,
                                         std::uint64_t flat_faces);

}  // namespace bp
