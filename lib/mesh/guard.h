#pragma once
#include <span>
#include <vector>

#include "lib/mesh/face_tree.h"
#include "lib/mesh/half_edge_mesh.h"
#include "lib/mesh/lattice_geometry.h"

/// The guard: a change of the mesh is taken only if the new faces keep it embedded, decided exactly in integers.
/// Together with the local constraints it proves that the new proxy contains the old one (docs/bounding.md,
/// "Simplification").
namespace bp {

/// A face that would replace others.
struct NewFace {
  std::array<VertexId, 3> ids;  ///< counter-clockwise; ids[0] is the apex of a star
  std::array<LatticeCoord, 3> corners;
};

class FaceProbe;

class Guard {
 public:
  Guard(const HalfEdgeMesh& mesh, const FaceTree& tree);
  ~Guard();

  /// True if the faces of `star`, a closed fan around one apex, meet each other only in the apex and in the edges they
  /// share, and meet the rest of the mesh, less `replaced`, only in shared corners and edges. Exact. No face may have
  /// zero area.
  [[nodiscard]] bool star_is_free(std::span<const NewFace> star, std::span<const FaceId> replaced);

  /// The same for a star that only grows the solid, of a mesh that bounds a solid from outside (its winding number is 0
  /// or 1 everywhere). It mostly tests only the few faces beside the star that look the other way. True then holds
  /// under the condition that no face of near() lies between the old faces and the new ones. If one may lie there, ask
  /// rest_is_free(), too. `before`: the normals of the faces replaced and a box around them.
  struct Before {
    std::span<const LatticeCoord> normals;
    LatticeBox box;
  };
  [[nodiscard]] bool grown_star_is_free(std::span<const NewFace> star, std::span<const FaceId> replaced,
                                        const Before& before);
  /// The faces that may be between the old faces and the new ones now, if any are.
  [[nodiscard]] std::span<const FaceId> near() const { return {near_.data(), near_count_}; }
  [[nodiscard]] const LatticeBox& box_of_both() const { return both_; }  ///< around old faces and new ones
  [[nodiscard]] bool rest_is_free(std::span<const NewFace> star);

  /// The same for any few faces, e.g. the two of a flipped edge.
  [[nodiscard]] bool faces_are_free(std::span<const NewFace> faces, std::span<const FaceId> replaced);

 private:
  void prepare(std::span<const NewFace> faces);
  void prepare_probes(std::span<const NewFace> faces);
  void gather_near(const LatticeBox& box, std::span<const FaceId> replaced);
  [[nodiscard]] bool look_one_way(std::span<const NewFace> star, std::span<const LatticeCoord> normals_before);
  [[nodiscard]] bool clear_of_mesh(std::span<const NewFace> faces, std::span<const FaceId> replaced);
  [[nodiscard]] bool clear_of_face(std::span<const NewFace> faces, FaceId other) const;

  const HalfEdgeMesh& mesh_;
  const FaceTree& tree_;
  LatticeCoord origin_;           // a corner of the new faces
  std::vector<FaceId> near_;      // faces whose boxes meet the one of the question
  std::size_t near_count_ = 0;    // the first of them need a test
  LatticeBox box_, both_;         // of all new faces; of the old ones too
  std::vector<BoxGroup> groups_;  // boxes of the new faces, relative to origin_
  std::vector<LatticeCoord> normals_;
  std::vector<FaceProbe> probes_;
  std::vector<std::uint32_t> removed_;  // stamp per face
  std::uint32_t stamp_ = 0;
};

}  // namespace bp
