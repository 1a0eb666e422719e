#pragma once
#include "lib/check/check_report.h"
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

}  // namespace bp
