#pragma once
#include <optional>
#include <span>
#include <string>

#include "io/gltf/glb_file.h"
#include "lib/mesh/lattice_mesh.h"

/// The three ways in which the vertices of a glTF file become 32-bit floats without rounding; nodes undo them. The
/// first way that holds every vertex of the file is taken (docs/decisions/0001-exact-frame.md):
///   plain   scene units, turned to y up; the node has no transform
///   moved   scene units less a point of few bits, which is the node's translation
///   scaled  whole numbers of lattice steps from the middle of the mesh; the node has a scale and a translation
namespace bp {

constexpr std::int64_t kFloatInteger = std::int64_t(1) << 24;  ///< float32 holds integers up to this

/// Returns the point, scene units, to subtract from all vertices of `meshes` after `origin` was subtracted: zero is
/// plain. Empty if no such point makes them floats. Throws bad_argument if subtracting `origin` rounds.
[[nodiscard]] std::optional<Vec3d> gltf_offset(std::span<const LatticeMesh* const> meshes, const Vec3d& origin);

/// A mesh of a file with that offset.
class GltfPlace {
 public:
  /// Throws bad_argument if the mesh must be scaled, and spans more lattice steps than floats hold exactly; `file`: its
  /// name for the message.
  GltfPlace(const LatticeMesh& mesh, const Vec3d& origin, const std::optional<Vec3d>& offset, const std::string& file);

  /// Returns the numbers of POSITION for a vertex: exact, turned to y up.
  [[nodiscard]] std::array<float, 3> operator()(LatticeCoord v) const;
  /// Gives `node` the transform from these numbers to scene units less the origin.
  void place(GltfOutJson& node) const;

 private:
  const GridFrame frame_;
  const Vec3d origin_;
  const std::optional<Vec3d> offset_;
  LatticeCoord centre_;  // used without an offset
};

}  // namespace bp
