#pragma once
#include "lib/check/check_report.h"
#include "lib/core/indexed_mesh.h"
#include "lib/core/length.h"
#include "lib/core/triangle_source.h"
#include "tools/cli/report.h"

/// The steps of bpcheck.
namespace bp {

/// Undoes --origin of bpmesh and bplod. Throws bad_argument if a sum is not exact, because the answer for rounded
/// vertices would be one for another proxy.
void add_origin(IndexedMesh& mesh, const Vec3d& by);

/// Returns scene units. For a percentage it reads the scene, from its start.
[[nodiscard]] double margin_world(const Length& margin, TriangleSource& scene);

/// Returns the counts for --report.
[[nodiscard]] Json counts_of(const CheckReport& verdict);

/// Throws bad_input if the scene has no triangle: an export that went wrong must not prove a proxy.
void refuse_empty_scene(const CheckReport& verdict);

}  // namespace bp
