#pragma once
#include "lib/check/check_report.h"
#include "lib/check/detail/cells/inside_cells.h"
#include "lib/check/detail/surface.h"
#include "lib/core/triangle_source.h"
#include "lib/geometry/triangle_bvh.h"

/// How near triangles are to each other: decided by doubles with bounds on their rounding.
namespace bp {

/// No point of one triangle is nearer than `margin`, above 0, to a point of the other. proven: a plane between them
/// shows it. refuted: two points of them are nearer. Rounding leaves distances undecided that are nearer to the margin
/// than some 1e-12 of the triangles' size.
[[nodiscard]] Answer keeps_gap(const TriangleD& a, const TriangleD& b, double margin);

struct GapAnswer {
  Answer answer = Answer::proven;
  std::uint32_t item = 0;  ///< Item::id of a triangle that is too near; else, the lowest of those that perhaps are
};
/// The same of all triangles of `surface`.
[[nodiscard]] GapAnswer keeps_gap(const TriangleD& t, const TriangleBvh& surface, double margin);

/// The distance between t and the surface, which is not empty, or `most` if that is less. In floating point.
[[nodiscard]] double gap_within(const TriangleD& t, const TriangleBvh& surface, double most);

// Does a proxy keep clear of a scene by as much as coordinates were rounded when both were read?

struct ClearanceQuestion {
  Rounding scene;        ///< SceneCounts::rounding, of all of the scene
  double proxy_off = 0;  ///< a point of the proxy may be off by so much, scene units
  double margin = 0;     ///< CheckOptions::margin_world
  std::size_t max_examples = 0;

  [[nodiscard]] bool any() const { return scene.any() || proxy_off > 0; }
  /// How far a triangle of the scene and one of the proxy may have come nearer to each other, or apart.
  [[nodiscard]] double off(const TriangleD& t) const { return scene.of(t) + proxy_off; }
};

struct ClearanceReport {
  Finding within;         ///< as CheckReport::within_rounding
  Finding within_margin;  ///< the same of the margin and the rounding together
};

/// Reads the scene once from its start. A triangle that meets nothing as read, and whose distance from each triangle of
/// the surface is no less than both may be off, lies on the same side in the file. Memory does not grow with the scene.
/// `cells`: those of the surface, or null. The report does not depend on them.
[[nodiscard]] ClearanceReport check_clearance(const WeldedMesh& mesh, const Surface& surface, const InsideCells* cells,
                                              TriangleSource& scene, const ClearanceQuestion& question);

/// Whether a corner of the scene lies on the wrong side of the surface, outside of it or, with `inside`, within it, and
/// farther from it than both may be off: so it is in the file, too. Reads the scene from its start.
[[nodiscard]] bool any_misplaced(const Surface& surface, TriangleSource& scene, const ClearanceQuestion& question,
                                 bool inside);

/// The largest distance that a point of the mesh may be off by.
[[nodiscard]] double most_off(const std::vector<Vec3d>& points, const Rounding& rounding);

}  // namespace bp
