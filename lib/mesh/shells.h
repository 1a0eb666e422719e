#pragma once
#include <span>

#include "lib/mesh/half_edge_mesh.h"

/// Shells are the connected parts of a closed surface. If collapses grow one shell over another without touching it,
/// the other stays inside as a shell that bounds nothing.
namespace bp {

/// Returns whether the solid of an embedded mesh is what surrounds its outermost shells.
[[nodiscard]] inline bool faces_inwards(const HalfEdgeMesh& mesh) {
  return mesh.face_count() > 0 && mesh.volume6() < 0;
}

/// Knows what each shell of a mesh bounds, a solid or a cavity, while the mesh is edited. Edits keep shells apart, and
/// each embedded. But a small shell may step through itself, and so out of its own solid, with every face free of all
/// others. Six times its volume, kept in integers, tells this. Shells with a rim in a cell are left out: what they hold
/// at the cell's side does not change (docs/bounding.md). 4 bytes a face; setting it up takes time linear in the faces.
class ShellSense {
 public:
  explicit ShellSense(const HalfEdgeMesh& mesh);

  /// Returns true if the shell of face f turns inside out when six times its volume changes by `gain6`.
  [[nodiscard]] bool turns(FaceId f, int128 gain6) const;
  /// Records such a change.
  void add(FaceId f, int128 gain6);
  /// Returns whether the shell of face f has ever turned inside out.
  [[nodiscard]] bool has_turned(FaceId f) const { return shells_[shell_[f]].turned; }

 private:
  struct Shell {
    int128 volume6 = 0;
    bool rim = false, turned = false;
  };
  std::vector<std::uint32_t> shell_;  // by face
  std::vector<Shell> shells_;
};

/// Returns by how much six times the volume grows if a fan around `apex`, with the same rim, replaces the faces
/// `replaced`.
[[nodiscard]] int128 fan_gain6(const HalfEdgeMesh& mesh, std::span<const FaceId> replaced, const LatticeCoord& apex);

/// Erases the shells that have ever turned. They keep nothing inside any more, even if they have turned back. Returns
/// the faces erased.
std::uint64_t erase_turned_shells(HalfEdgeMesh& mesh, const ShellSense& sense);

/// Erases the shells that have turned, then those across which the winding number W does not change between 0 and 1.
/// The remaining shells bound the same solid W >= 1 (docs/bounding.md, "Tightening" and "Simplification"). `inwards`:
/// faces_inwards() of the mesh before it was changed. `sense`: of the mesh since then; null if only growing was
/// possible. Exact. The mesh must be embedded and closed. Returns the number of faces erased. Cost: linear in the
/// faces, and a query of a tree for each further shell.
std::uint64_t erase_inner_shells(HalfEdgeMesh& mesh, bool inwards = false, const ShellSense* sense = nullptr);

}  // namespace bp
