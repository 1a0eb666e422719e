#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/scene/part_names.h"
#include "lib/check/face_counts.h"
#include "lib/core/triangle_source.h"
#include "lib/geometry/triangle_totals.h"
#include "tools/cli/report.h"
#include "tools/run/mesh_extras.h"

/// The facts that bpinfo prints about a mesh or scene.
namespace bp {

struct MeshInfo {
  SceneCounts counts;
  TriangleTotals totals;
  FaceCounts faces;
  std::optional<std::uint64_t> vertices;  ///< distinct positions; unknown for scenes above kMaxKept triangles
  std::vector<TriangleD> triangles;       ///< all of them, or none if there are more than kMaxKept
  std::vector<TriangleColors> colors;     ///< colours of these triangles, if the source has any
  std::vector<std::uint8_t> inner_edges;  ///< inner edges of these triangles, as in TriangleSource::read_faces()
  MeshExtras extras;
  std::size_t level = 0;  ///< the level that was measured
  PartNames names;        ///< the names by which rules of bpscale find parts

  static constexpr std::size_t kMaxKept = 1000000;
};

/// Measures a mesh or scene in one pass over `source`; memory is bounded by kMaxKept. Colours are kept if the source
/// was opened with them.
[[nodiscard]] MeshInfo measure(TriangleSource& source);

/// Returns "finest of 3 levels"; empty if there is one level.
[[nodiscard]] std::string level_text(std::size_t level, std::size_t levels);
[[nodiscard]] std::string mesh_text(const MeshInfo& info, const std::string& name);
[[nodiscard]] Json mesh_json(const MeshInfo& info);

}  // namespace bp
