#pragma once
#include <span>

#include "lib/mesh/half_edge_mesh.h"

/// Shells: the connected parts of a closed surface. Where collapses grow one over another that it does not touch, the
/// other stays inside as a shell that bounds nothing.
namespace bp {

/// Of an embedded mesh that bounds a solid: true if the solid is what surrounds its outermost shells.
[[nodiscard]] inline bool faces_inwards(const HalfEdgeMesh& mesh) {
  return mesh.face_count() > 0 && mesh.volume6() < 0;
}

/// What each shell of a mesh bounds, a solid or a cavity, while the mesh is edited. Edits keep shells apart and each
/// embedded; but a small one may step through itself, and so out of its own solid, with every face free of all others:
/// six times its volume, kept in integers, tells. In a cell, shells with a rim are left out: what they hold at the
/// cell's side does not change (docs/bounding.md). 4 bytes a face; set up in time linear in the faces.
class ShellSense {
 public:
  explicit ShellSense(const HalfEdgeMesh& mesh);

  /// True if the shell of face f turns inside out where six times its volume changes by `gain6`.
  [[nodiscard]] bool turns(FaceId f, int128 gain6) const;
  /// Such a change is made.
  void add(FaceId f, int128 gain6);
  /// The shell of face f has turned, if only for a time.
  [[nodiscard]] bool has_turned(FaceId f) const { return shells_[shell_[f]].turned; }

 private:
  struct Shell {
    int128 volume6 = 0;
    bool rim = false, turned = false;
  };
  std::vector<std::uint32_t> shell_;  // per face
  std::vector<Shell> shells_;
};

/// What six times the volume gains where the faces `replaced` give way to a fan with the same rim around `apex`.
[[nodiscard]] int128 fan_gain6(const HalfEdgeMesh& mesh, std::span<const FaceId> replaced, const LatticeCoord& apex);

/// Erases the shells that have turned: they keep nothing inside any more, even if they have turned back.
std::uint64_t erase_turned_shells(HalfEdgeMesh& mesh, const ShellSense& sense);

/// Erases the shells that have turned, then those across which the winding number W does not change between 0 and 1:
/// those left bound the same solid W >= 1 (docs/bounding.md, "Tightening" and "Simplification"). `inwards`:
/// faces_inwards() of the mesh before it was changed; `sense`: of the mesh since then; null if only growing was
/// possible. Exact. Needs an embedded mesh that is closed. Returns the number of faces erased. Cost: linear in the
/// faces, and for each further shell a query of a tree.
std::uint64_t erase_inner_shells(HalfEdgeMesh& mesh, bool inwards = false, const ShellSense* sense = nullptr);

}  // namespace bp
