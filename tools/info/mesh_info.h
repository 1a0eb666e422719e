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

/// What bpinfo says of a mesh or scene.
namespace bp {

struct MeshInfo {
  SceneCounts counts;
  TriangleTotals totals;
  FaceCounts faces;
  std::optional<std::uint64_t> vertices;  ///< distinct positions; unknown for scenes above kMaxKept triangles
  std::vector<TriangleD> triangles;       ///< all of them, or none if there are more than kMaxKept
  std::vector<TriangleColors> colors;     ///< of these, if the source has any
  std::vector<std::uint8_t> inner_edges;  ///< of these, as TriangleSource::read_faces()
  MeshExtras extras;
  std::size_t level = 0;  ///< that was measured
  PartNames names;        ///< as rules of bpscale name parts

  static constexpr std::size_t kMaxKept = 1000000;
};

/// Streams `source` once; memory is bounded by kMaxKept. Colours are looked for if the source was opened with them.
[[nodiscard]] MeshInfo measure(TriangleSource& source);

/// "finest of 3 levels"; empty if there is one.
[[nodiscard]] std::string level_text(std::size_t level, std::size_t levels);
[[nodiscard]] std::string mesh_text(const MeshInfo& info, const std::string& name);
[[nodiscard]] Json mesh_json(const MeshInfo& info);

}  // namespace bp
