#pragma once
#include "lib/check/check_report.h"
#include "lib/check/detail/cells/inside_cells.h"
#include "lib/check/detail/surface.h"
#include "lib/core/triangle_source.h"
#include "lib/geometry/triangle_bvh.h"

/// Distances between triangles, decided by doubles with bounds on their rounding.
namespace bp {

/// Decides whether each point of one triangle is at least `margin`, above 0, from each point of the other. proven: a
/// plane between them shows it. refuted: two points are nearer. Distances nearer to the margin than some 1e-12 of the
/// triangles' size remain undecided.
[[nodiscard]] Answer keeps_gap(const TriangleD& a, const TriangleD& b, double margin);

struct GapAnswer {
  Answer answer = Answer::proven;
  std::uint32_t item = 0;  ///< Item::id of a triangle that is too near; without one, the lowest of those that may be
};
/// As above, for all triangles of `surface`.
[[nodiscard]] GapAnswer keeps_gap(const TriangleD& t, const TriangleBvh& surface, double margin);

/// Returns the distance between t and the surface, which is not empty, or `most` if that is less. In floating point.
[[nodiscard]] double gap_within(const TriangleD& t, const TriangleBvh& surface, double most);

// The question whether a proxy keeps clear of a scene by the rounding of coordinates when both were read.

struct ClearanceQuestion {
  Rounding scene;        ///< SceneCounts::rounding of the whole scene
  double proxy_off = 0;  ///< error of a point of the proxy, scene units, at most
  double margin = 0;     ///< CheckOptions::margin_world
  std::size_t max_examples = 0;

  [[nodiscard]] bool any() const { return scene.any() || proxy_off > 0; }
  /// Returns the most by which a triangle of the scene and one of the proxy may be nearer to each other, or farther,
  /// than they were read.
  [[nodiscard]] double off(const TriangleD& t) const { return scene.of(t) + proxy_off; }
};

struct ClearanceReport {
  Finding within;         ///< as CheckReport::within_rounding
  Finding within_margin;  ///< the same for the margin and the rounding together
};

/// Reads the scene once from its start. A triangle that meets nothing as read, and whose distance from each triangle of
/// the surface is no less than the errors of both, lies on the same side in the file. Memory does not grow with the
/// scene. `cells`: cells of the surface, or null. The report does not depend on them.
[[nodiscard]] ClearanceReport check_clearance(const WeldedMesh& mesh, const Surface& surface, const InsideCells* cells,
                                              TriangleSource& scene, const ClearanceQuestion& question);

/// Returns whether a corner of the scene lies on the wrong side of the surface (outside of it or, with `inside`, within
/// it), and farther from it than the errors of both: then it does in the file, too. Reads the scene from its start.
[[nodiscard]] bool any_misplaced(const Surface& surface, TriangleSource& scene, const ClearanceQuestion& question,
                                 bool inside);

/// Returns the largest error of a point of the mesh.
[[nodiscard]] double most_off(const std::vector<Vec3d>& points, const Rounding& rounding);

}  // namespace bp
