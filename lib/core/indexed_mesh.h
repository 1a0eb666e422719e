#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/core/triangle_source.h"

/// A whole mesh in memory, in scene units: bpcheck and bpinfo read proxies like this. Scenes are streamed instead.
namespace bp {

struct IndexedMesh {
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint8_t> inner_edges;  ///< by triangle, as TriangleSource::read_faces() has them; missing ones are 0
  std::optional<UpAxis> up;               ///< if the file tells it
  std::uint64_t bad_faces = 0;            ///< faces of the file that are left out: SceneCounts::bad_faces
  std::uint64_t differing = 0;            ///< SceneCounts::differing
  Unfollowed unfollowed;                  ///< SceneCounts::unfollowed
  Rounding rounding;                      ///< of the vertices, compared with the file's numbers
};

}  // namespace bp
