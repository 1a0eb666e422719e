#pragma once
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/core/color.h"
#include "lib/core/grid_frame.h"
#include "lib/exact/predicates.h"
#include "lib/grid/provenance.h"

/// A triangle mesh with integer vertices, which bpmesh works on and writes. Vertices are lattice points (1/64 voxel) of
/// `frame`; frame.world() gives their exact scene coordinates as doubles. Triangles are counter-clockwise seen from
/// outside.
namespace bp {

/// An image as a file holds it. The type is "image/jpeg" or "image/png".
struct ImageFile {
  std::string bytes, type;
  [[nodiscard]] bool is_there() const { return !bytes.empty(); }
};

/// An image that lies on a mesh.
struct MeshTexture {
  using Corners = std::array<std::array<float, 2>, 3>;
  std::vector<Corners> uv;           ///< of each triangle's corners: (0, 0) is the image's upper left corner
  std::vector<std::uint32_t> chart;  ///< of each triangle; a vertex has one place in the image for each of its charts
  std::string image, type;           ///< as a file holds it: "image/jpeg" or "image/png"
  bool has_holes = false;            ///< the image's alpha is below a half somewhere
  /// Further images, as glTF has them, empty if there are none: directions in the tangent space of tangents_of(),
  /// roughness and metal, emitted light.
  ImageFile normal, roughness, emission;
  double roughness_factor = 1, metal_factor = 0;  ///< factors, if no image has them
};

struct LatticeMesh {
  GridFrame frame;
  std::vector<LatticeCoord> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Triangles that a file joins to quads (lib/quads/quads.h); mostly empty.
  std::vector<std::array<std::uint32_t, 2>> quads;
  std::vector<TriangleColors> colors;  ///< at each triangle's corners; empty: none
  std::vector<Provenance> provenance;
  std::shared_ptr<const MeshTexture> texture;  ///< null: none
};

/// Six times the volume of a voxel, lattice units cubed.
constexpr std::int64_t kVolume6OfVoxel = std::int64_t(6) * kLatticePerVoxel * kLatticePerVoxel * kLatticePerVoxel;
/// Returns six times the volume that a closed surface encloses, lattice units cubed; exact.
[[nodiscard]] int128 volume6_of(std::span<const LatticeCoord> vertices,
                                std::span<const std::array<std::uint32_t, 3>> triangles);
[[nodiscard]] inline int128 volume6_of(const LatticeMesh& mesh) {
  return volume6_of(mesh.vertices, mesh.triangles);
}

/// Drops the vertices that no triangle has. The others keep their order; their old numbers are returned.
std::vector<std::uint32_t> drop_unused_vertices(std::vector<LatticeCoord>& vertices,
                                                std::span<std::array<std::uint32_t, 3>> triangles);

}  // namespace bp
