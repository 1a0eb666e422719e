#pragma once
#include <set>
#include <span>
#include <vector>

#include "lib/core/vec3.h"
#include "lib/enclosed/enclosed.h"
#include "lib/enclosed/face_target.h"

/// Points of what must stay inside, each listed with the face of the proxy that it is nearest to. They guide where
/// vertices go; nothing is proved by them. Of many with one face, those are kept that it meets first: at most 720.
namespace bp {

class ContactPoints {
 public:
  /// Parallel. Cost: a search in the tree for each point.
  ContactPoints(const Enclosed& enclosed, const HalfEdgeMesh& mesh, const FaceTree& tree);

  [[nodiscard]] const std::vector<std::uint32_t>& of(FaceId f) const { return of_face_[f]; }
  [[nodiscard]] const Vec3d& operator[](std::uint32_t i) const { return points_[i]; }  ///< relative to origin()
  [[nodiscard]] const LatticeCoord& origin() const { return origin_; }
  [[nodiscard]] std::span<const Vec3d> points() const { return points_; }  ///< all that are listed, and no others

  /// What handing over needs meanwhile.
  struct Scratch {
    std::vector<std::pair<std::uint32_t, std::size_t>> moving;  // points, each with the face it had, as a target
    std::vector<FaceTarget> targets;
  };
  /// Lists the points of the faces `from` with the nearest of the faces `to`, which are as they are in the mesh now.
  /// At the same time for different faces.
  void hand_over(std::span<const FaceId> from, std::span<const FaceId> to, Scratch& scratch);

  /// Lists the points of `faces`, each once, with the nearest of the faces at their corners: after many changes around
  /// them. Parallel; builds a target for each face of the mesh.
  void hand_over_around(std::span<const FaceId> faces);

  /// More points, relative to origin() + `shift`, each for the nearest of the faces `near`; not those that are there
  /// already, to a unit.
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
  std::vector<FaceTarget> targets_;  // of hand_over_around(), by face
  std::set<LatticeCoord> added_;
};

}  // namespace bp
