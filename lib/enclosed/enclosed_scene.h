#pragma once
#include <utility>

#include "lib/enclosed/enclosed_triangles.h"
#include "lib/enclosed/enclosed_voxels.h"

namespace bp {

/// The triangles of a scene, and its voxels: the triangles stay inside, exactly; the voxels tell what is near, which is
/// quick and needs no more than a guess.
class EnclosedScene final : public EnclosedTriangles {
 public:
  /// `voxels`: of the scene, in the voxels of `frame`.
  EnclosedScene(std::vector<TriangleD> triangles, const GridFrame& frame, const BrickShelf& voxels)
      : EnclosedTriangles(std::move(triangles), frame), voxels_(voxels) {}
  [[nodiscard]] bool is_near(std::span<const NewFace> faces, double distance) const override {
    return voxels_.is_near(faces, distance);
  }
  [[nodiscard]] std::uint64_t bytes() const override { return EnclosedTriangles::bytes() + voxels_.bytes(); }

 private:
  EnclosedVoxels voxels_;
};

}  // namespace bp
