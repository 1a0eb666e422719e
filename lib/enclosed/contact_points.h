#pragma once
#include <set>
#include <span>
#include <vector>

#include "lib/core/vec3.h"
#include "lib/enclosed/enclosed.h"
#include "lib/enclosed/face_target.h"
#include "lib/mesh/face_tree.h"

/// Points of the enclosed set, each listed with the face of the proxy that is nearest to it. They guide where vertices
/// go; they prove nothing. If a face has many, only the points that it meets first are kept: at most 720.
namespace bp {

class ContactPoints {
 public:
  /// Parallel. Cost: a search in the tree for each point.
  ContactPoints(const Enclosed& enclosed, const HalfEdgeMesh& mesh, const FaceTree& tree);

  [[nodiscard]] const std::vector<std::uint32_t>& of(FaceId f) const { return of_face_[f]; }
  [[nodiscard]] const Vec3d& operator[](std::uint32_t i) const { return points_[i]; }  ///< relative to origin()
  [[nodiscard]] const LatticeCoord& origin() const { return origin_; }
  /// Exactly the points that are listed with a face.
  [[nodiscard]] std::span<const Vec3d> points() const { return points_; }

  /// Buffers for hand_over().
  struct Scratch {
    std::vector<std::pair<std::uint32_t, std::size_t>> moving;  // points, each with its old face as a target
    std::vector<FaceTarget> targets;
  };
  /// Lists the points of the faces `from` with the nearest of the faces `to`. Uses the mesh as it is now. Thread-safe
  /// for different faces.
  void hand_over(std::span<const FaceId> from, std::span<const FaceId> to, Scratch& scratch);

  /// Lists the points of `faces`, each face once, with the nearest of the faces at their corners. For use after many
  /// changes. Parallel; builds a target for each face of the mesh.
  void hand_over_around(std::span<const FaceId> faces);

  /// Adds points, given relative to origin() + `shift`, to the nearest of the faces `near`. Points that are there
  /// already, to a lattice unit, are not added again.
  void add(std::span<const Vec3d> points, const Vec3d& shift, std::span<const FaceId> near);

 private:
  [[nodiscard]] std::array<Vec3d, 3> corners(FaceId f) const;
  /// A point that a face gives to another one.
  struct Move {
    std::uint32_t point;
    FaceId to;
  };
  void set_targets();
  void give_away(FaceId from, std::vector<FaceId>& around, std::vector<Move>& moves);
  void keep_outermost(FaceId f);
  void drop_unlisted();

  const HalfEdgeMesh& mesh_;
  LatticeCoord origin_{};
  std::vector<Vec3d> points_;
  std::vector<std::vector<std::uint32_t>> of_face_;
  Scratch scratch_;
  std::vector<FaceTarget> targets_;  // per face: its target, for hand_over_around()
  std::set<LatticeCoord> added_;
};

}  // namespace bp
