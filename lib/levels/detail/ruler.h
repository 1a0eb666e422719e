#pragma once
#include <memory>
#include <optional>

#include "lib/geometry/triangle_bvh.h"
#include "lib/levels/lod_level.h"
#include "lib/volume/boundary_rects.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

/// What a ruler measures against: a scene whose triangles are known, or else its voxels.
struct RulerScene {
  const BrickShelf& solid;              ///< its voxels, of `frame`; with the inside filled, the scene touches each
                                        ///< voxel of their boundary
  const BrickShelf* surface = nullptr;  ///< as LodOptions has it
  const std::vector<TriangleD>* triangles = nullptr;  ///< must outlive the ruler; null: not known
  GridFrame frame;
  MeshMode mode = MeshMode::bounding;  ///< of the levels that are measured
};

/// What a ruler takes of the memory.
struct RulerBytes {
  std::uint64_t needed = 0;  ///< while it measures
  std::uint64_t kept = 0;    ///< while it lives, trees that may be kept aside
};

/// Measures how far levels are from what their scene shows to the outside. Levels around triangles are measured to
/// these; others need the voxels of the scene's surface, too. The trees are kept where they are small against the
/// memory; else they are made for each measurement, since levels need the memory meanwhile.
class Ruler {
 public:
  const std::uint64_t dense_faces;  ///< triangles of the dense surface of the solid
  const VoxelBox box;               ///< around the voxels of its boundary

  /// Throws out_of_resource, before it takes anything, if it takes more than `memory`.
  Ruler(const RulerScene& scene, const MemoryShare& memory);

  /// has_triangles: the scene's are known, though `scene` has none.
  [[nodiscard]] static RulerBytes bytes_needed(const RulerScene& scene, bool has_triangles);

  [[nodiscard]] double voxel() const { return frame_.voxel; }
  /// Around all of the solid's voxels, scene units.
  [[nodiscard]] Bounds3d bounds() const;
  /// What the ruler takes of the memory while it lives.
  [[nodiscard]] std::uint64_t bytes() const;

  /// Returns what one measurement takes, beside the mesh, where trees are not kept.
  [[nodiscard]] std::uint64_t bytes_of_measure() const;

  /// LodLevel::error_world of a mesh; nothing if it surely exceeds `limit`. Around triangles that is found early; else
  /// all is measured.
  [[nodiscard]] std::optional<double> error(const LatticeMesh& mesh, double limit) const;

 private:
  /// Triangles with a tree over them, which is kept, or made for each use.
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
  /// Nothing if the triangles of the scene are not those of the voxels.
  [[nodiscard]] std::optional<double> error_of_fit(const std::vector<TriangleD>& mesh) const;
  [[nodiscard]] double error_of_fit_to_voxels(const std::vector<TriangleD>& mesh) const;

  GridFrame frame_;
  MeshMode mode_;
  const std::vector<TriangleD>* triangles_;  // null: not known
  Surface scene_;                            // of these
  std::vector<VoxelRun> runs_;
  std::vector<FaceRect> faces_;      // between its voxels and empty ones, if fits are measured against triangles
  std::vector<TriangleD> segments_;  // of the runs, where they are kept
  Surface kept_segments_;            // of these
};

}  // namespace bp
