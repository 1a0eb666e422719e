#pragma once
#include <cmath>
#include <optional>

#include "lib/check/detail/cells/inside_cells.h"
#include "lib/check/detail/distance.h"
#include "lib/check/detail/surface.h"
#include "lib/core/triangle_source.h"

/// Checks whether a surface strictly encloses a scene.
namespace bp {

struct EnclosureReport {
  std::uint64_t triangles = 0;
  Bounds3d bounds;                         ///< of all triangles
  Finding touching, outside, undecidable;  ///< as in CheckReport
  Finding too_near, perhaps_near;          ///< as in CheckReport
  double least_gap = HUGE_VAL;             ///< as in CheckReport
  std::optional<double> volume;            ///< of the scene; none if it is open (SignedVolume)
  std::uint64_t bent = 0, bent_open = 0;   ///< as in CheckReport
};

struct EnclosureQuestion {
  bool decide_sides = false;  ///< the proxy is closed
  double margin = 0;          ///< CheckOptions::margin_world
  std::size_t max_examples = 0;
};

/// Tests every triangle of `scene` from its start, in parallel, in bounded memory. A triangle that touches nothing lies
/// on one side as a whole, so one of its corners decides; sides are tested only if the question asks for them. `cells`:
/// cells of the surface, if the question asks for sides, or null; the report does not depend on them. `memory` gets the
/// scene's triangles.
[[nodiscard]] EnclosureReport check_enclosure(const WeldedMesh& mesh, const Surface& surface, const InsideCells* cells,
                                              TriangleSource& scene, const EnclosureQuestion& question,
                                              SceneMemory& memory);

}  // namespace bp
