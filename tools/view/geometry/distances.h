#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "lib/core/triangle_source.h"
#include "lib/geometry/triangle_bvh.h"
#include "tools/view/geometry/shown_mesh.h"

/// Distances of meshes from the scene, as colours for the page. They are to look at: bpcheck bounds the largest one.
namespace bp {

/// A search tree over the triangles of a scene, made when it is first asked for. Thread-safe.
class SceneDistances {
 public:
  /// `open` opens the scene; `middle` is subtracted from its positions. The tree takes at most so many bytes.
  SceneDistances(std::function<std::unique_ptr<TriangleSource>()> open, const Vec3d& middle, std::uint64_t bytes);

  /// Gives each position of a mesh its distance from the scene. A mesh without normals is refined before, so that
  /// colours between positions are right: edges are halved until none is longer than `step`, or than what half a
  /// million triangles allow. Throws out_of_resource if the tree does not fit.
  void add_to(ShownMesh& mesh, double step);

 private:
  [[nodiscard]] const TriangleBvh& tree();
  const std::function<std::unique_ptr<TriangleSource>()> open_;
  const Vec3d middle_;
  const std::uint64_t bytes_;
  std::mutex mutex_;
  std::unique_ptr<const TriangleBvh> tree_;
};

/// Halves edges of a mesh until none is longer than `longest`; neighbours agree, so that no crack opens. Stops early
/// with more than `most` triangles. Edges that are drawn stay as they are. The mesh has no normals.
void refine(ShownMesh& mesh, double longest, std::size_t most);

}  // namespace bp
