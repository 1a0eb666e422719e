#pragma once
#include <memory>
#include <optional>

#include "lib/geometry/triangle_bvh.h"
#include "lib/levels/lod_level.h"
#include "lib/levels/voxel_choice.h"
#include "lib/volume/boundary_rects.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

/// Trees and enclosed sets are kept if they take at most this part of the memory.
constexpr std::uint64_t kSmallShare = 16;

/// The scene that a ruler measures against: its triangles if they are known, else its voxels.
struct RulerScene {
  /// The scene's voxels, in `frame`; even if the inside is filled, the scene touches each voxel of their boundary.
  const BrickShelf& solid;
  const BrickShelf* surface = nullptr;                ///< as LodOptions has it
  const std::vector<TriangleD>* triangles = nullptr;  ///< must outlive the ruler; null: not known
  GridFrame frame;
  MeshMode mode = MeshMode::bounding;  ///< the mode of the levels that are measured
};

/// Bytes of memory that a ruler takes.
struct RulerBytes {
  std::uint64_t needed = 0;  ///< while it measures
  std::uint64_t kept = 0;    ///< while it lives, without trees that may be kept
};

/// Measures the error of levels: how far they are from what their scene shows to the outside. Bounding levels around
/// triangles are measured to these triangles; for others the voxels of the scene's surface are needed, too. Trees are
/// kept if they are small compared with the memory. Large ones are made anew for each measurement, since levels need
/// the memory in between.
class Ruler {
 public:
  const std::uint64_t dense_faces;  ///< triangles of the dense surface of the solid
  const VoxelBox box;               ///< around the voxels of the solid's boundary

  /// Throws out_of_resource, before it takes anything, if it would take more than `memory`.
  Ruler(const RulerScene& scene, const MemoryShare& memory);

  /// has_triangles: the scene's triangles are known, although `scene` does not have them.
  [[nodiscard]] static RulerBytes bytes_needed(const RulerScene& scene, bool has_triangles);

  [[nodiscard]] double voxel() const { return frame_.voxel; }
  /// Returns the box around all voxels of the solid, scene units.
  [[nodiscard]] Bounds3d bounds() const { return bounds_of(box, frame_); }
  /// Returns the bytes that the ruler takes while it lives.
  [[nodiscard]] std::uint64_t bytes() const;

  /// Returns the bytes of one measurement, without the mesh; trees that are kept are not counted.
  [[nodiscard]] std::uint64_t bytes_of_measure() const;

  /// Returns LodLevel::error_world of a mesh. Returns nothing if it surely exceeds `limit`; only for bounding levels
  /// around triangles does this end the measurement early.
  [[nodiscard]] std::optional<double> error(const LatticeMesh& mesh, double limit) const;

 private:
  /// Triangles with a tree over them. The tree is kept, or made for each use.
  class Surface {
   public:
    Surface() = default;
    Surface(const std::vector<TriangleD>* triangles, bool keep) : triangles_(triangles) {
      if (keep) kept_ = std::make_unique<TriangleBvh>(*triangles);
    }
    template <class Use>
    decltype(auto) with_tree(Use&& use) const {
      return kept_ ? use(*kept_) : use(TriangleBvh(*triangles_));
    }
    [[nodiscard]] std::uint64_t bytes() const { return kept_ ? kept_->bytes() : 0; }

   private:
    const std::vector<TriangleD>* triangles_ = nullptr;
    std::unique_ptr<TriangleBvh> kept_;
  };

  Ruler(const RulerScene& scene, const BoundarySize& size, const MemoryShare& memory);
  void take_surface(const RulerScene& scene, const BoundarySize& size, const MemoryShare& memory);
  /// Calls use(segments of the runs, scene units).
  template <class Use>
  decltype(auto) with_segments(Use&& use) const;
  /// Calls use(segments, a tree over them).
  template <class Use>
  decltype(auto) with_segment_tree(Use&& use) const;
  [[nodiscard]] double error_around_voxels(const std::vector<TriangleD>& mesh) const;
  /// Returns nothing if the triangles of the scene are not those of the voxels.
  [[nodiscard]] std::optional<double> error_of_fit(const std::vector<TriangleD>& mesh) const;
  [[nodiscard]] double error_of_fit_to_voxels(const std::vector<TriangleD>& mesh) const;

  GridFrame frame_;
  MeshMode mode_;
  const std::vector<TriangleD>* triangles_;  // null: not known
  Surface scene_;                            // of *triangles_
  std::vector<VoxelRun> runs_;
  std::vector<FaceRect> faces_;      // between voxels and empty ones; only for fits that are measured against triangles
  std::vector<TriangleD> segments_;  // of the runs, if they are kept
  Surface kept_segments_;            // of segments_
};

}  // namespace bp
