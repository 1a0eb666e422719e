#pragma once
#include <span>
#include <vector>

#include "lib/meshing/face_tree.h"
#include "lib/meshing/half_edge_mesh.h"
#include "lib/meshing/lattice_geometry.h"

/// The guard: a change of the mesh is taken only if the new faces keep it embedded, decided exactly in integers.
/// Together with the local constraints it proves that the new proxy contains the old one (docs/bounding.md,
/// "Simplification").
namespace bp {

/// A face that would replace others.
struct NewFace {
  std::array<VertexId, 3> ids;  ///< counter-clockwise; ids[0] is the apex of a star
  std::array<LatticeCoord, 3> corners;
};

class Guard {
 public:
  Guard(const HalfEdgeMesh& mesh, const FaceTree& tree) : mesh_(mesh), tree_(tree), removed_(mesh.face_capacity(), 0) {}

  /// True if the faces of `star`, a closed fan around one apex, meet each other only in the apex and in the edges they
  /// share, and meet the rest of the mesh, less `replaced`, only in shared corners and edges. Exact. No face may have
  /// zero area.
  [[nodiscard]] bool star_is_free(std::span<const NewFace> star, std::span<const FaceId> replaced);

  /// The same for any few faces, e.g. the two of a flipped edge.
  [[nodiscard]] bool faces_are_free(std::span<const NewFace> faces, std::span<const FaceId> replaced);

 private:
  [[nodiscard]] bool clear_of_mesh(std::span<const NewFace> faces, std::span<const FaceId> replaced);

  [[nodiscard]] bool clear_of_face(std::span<const NewFace> faces, const LatticeBox& all, FaceId other) const;

  const HalfEdgeMesh& mesh_;
  const FaceTree& tree_;
  std::vector<LatticeBox> boxes_;       // of the new faces
  std::vector<std::uint32_t> removed_;  // stamp per face
  std::uint32_t stamp_ = 0;
};

}  // namespace bp
