#pragma once
#include <span>
#include <vector>

#include "lib/mesh/face_tree.h"
#include "lib/mesh/half_edge_mesh.h"
#include "lib/mesh/lattice_geometry.h"

/// The guard refuses a change of the mesh unless the new faces keep it embedded. It decides exactly, in integers.
/// Together with the local constraints this proves that the new proxy contains the old one (docs/bounding.md,
/// "Simplification").
namespace bp {

class FaceProbe;

class Guard {
 public:
  Guard(const HalfEdgeMesh& mesh, const FaceTree& tree);
  ~Guard();

  /// Returns true if the faces of `star`, a closed fan around one apex, meet each other only in the apex and in the
  /// edges that they share, and meet the rest of the mesh, without `replaced`, only in shared corners and edges. Exact.
  /// No face may have zero area.
  [[nodiscard]] bool star_is_free(std::span<const NewFace> star, std::span<const FaceId> replaced);

  /// Answers the same for a star that only grows the solid. The mesh must bound a solid from outside: its winding
  /// number is 0 or 1 everywhere. As a rule only the few nearby faces that look the other way are tested. True then
  /// holds under the condition that no face of near() lies between the old and the new faces. If one may lie there, ask
  /// rest_is_free(), too. `before`: the normals of the replaced faces and a box around them.
  struct Before {
    std::span<const LatticeCoord> normals;
    LatticeBox box;
  };
  [[nodiscard]] bool grown_star_is_free(std::span<const NewFace> star, std::span<const FaceId> replaced,
                                        const Before& before);
  /// Returns the faces that may lie between the old and the new faces now, if any do.
  [[nodiscard]] std::span<const FaceId> near() const { return {near_.data(), near_count_}; }
  [[nodiscard]] const LatticeBox& box_of_both() const { return both_; }  ///< around the old and the new faces
  [[nodiscard]] bool rest_is_free(std::span<const NewFace> star);

  /// Answers the same for any few faces, for example the two faces of a flipped edge.
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
  std::vector<FaceId> near_;      // faces whose boxes meet the box of the question
  std::size_t near_count_ = 0;    // so many of them, the first ones, need a test
  LatticeBox box_, both_;         // of all new faces; both_: of the old faces, too
  std::vector<BoxGroup> groups_;  // boxes of the new faces, relative to origin_
  std::vector<LatticeCoord> normals_;
  std::vector<FaceProbe> probes_;
  std::vector<std::uint32_t> removed_;  // stamp of each face
  std::uint32_t stamp_ = 0;
};

}  // namespace bp
