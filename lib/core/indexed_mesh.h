#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/core/triangle_source.h"

/// A whole mesh in memory, scene units: what bpcheck and bpinfo read (proxies; scenes are streamed instead).
namespace bp {

struct IndexedMesh {
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint8_t> inner_edges;  ///< as TriangleSource::read_faces(), by triangle; fewer: the rest has none
  std::optional<UpAxis> up;               ///< if its file tells
  std::uint64_t bad_faces = 0;            ///< faces of its file that are no triangles here: SceneCounts::bad_faces
  std::uint64_t differing = 0;            ///< SceneCounts::differing
  Unfollowed unfollowed;                  ///< SceneCounts::unfollowed
  Rounding rounding;                      ///< of the vertices, against those of its file
};

}  // namespace bp
