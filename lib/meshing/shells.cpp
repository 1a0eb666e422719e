#include "lib/meshing/shells.h"

#include "lib/core/predicates.h"
#include "lib/meshing/face_tree.h"

namespace bp {

namespace {

/// Crossings of a face by the ray from p towards +z, signed: 1 where it leaves the solid. Edges count half-open, as if
/// p were moved by infinitesimals in x and y, so no ray meets an edge or a corner; p is not on the face.
int crossings(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c, const LatticeCoord& p) {
  const LatticeCoord* corner[4] = {&a, &b, &c, &a};
  int turn = 0;  // of the face's shadow around p
  for (int i = 0; i < 3; ++i) {
    const LatticeCoord &s = *corner[i], &e = *corner[i + 1];
    if ((s.y <= p.y) == (e.y <= p.y)) continue;
    const int sense = s.y <= p.y ? 1 : -1;
    if (orient2d(s, e, p, 2) == sense) turn += sense;
  }
  return turn != 0 && orient3d(a, b, c, p) * turn < 0 ? turn : 0;
}

class Shells {
 public:
  explicit Shells(HalfEdgeMesh& mesh) : mesh_(mesh), shell_(mesh.face_capacity(), kNoId) {
    for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
      if (mesh.alive(f) && shell_[f] == kNoId) gather(f);
    }
  }

  std::uint64_t erase_inner(bool inwards) {
    const FaceTree tree(mesh_);
    std::vector<int> outside(first_.size());  // winding number on each one's outer side; on the inner one more, or less
    for (std::uint32_t s = 0; s < first_.size(); ++s) outside[s] = winding(tree, s) + (inwards ? 1 : 0);
    std::vector<bool> inner(first_.size());
    for (std::uint32_t s = 0; s < first_.size(); ++s) inner[s] = outside[s] != (volume6_[s] > 0 ? 0 : 1);
    std::uint64_t erased = 0;
    for (FaceId f = 0; f < mesh_.face_capacity(); ++f) {
      if (shell_[f] == kNoId || !inner[shell_[f]]) continue;
      mesh_.erase(f);
      ++erased;
    }
    return erased;
  }

 private:
  void gather(FaceId first) {
    const auto shell = std::uint32_t(first_.size());
    const LatticeCoord origin = mesh_.corner(first, 0);
    int128 volume6 = 0;
    stack_.assign(1, first);
    shell_[first] = shell;
    while (!stack_.empty()) {
      const FaceId f = stack_.back();
      stack_.pop_back();
      volume6 += orient3d_value(origin, mesh_.corner(f, 0), mesh_.corner(f, 1), mesh_.corner(f, 2));
      for (HalfEdgeId h = 3 * f; h < 3 * f + 3; ++h) {
        const FaceId beside = HalfEdgeMesh::face(mesh_.twin(h));
        if (shell_[beside] != kNoId) continue;
        shell_[beside] = shell;
        stack_.push_back(beside);
      }
    }
    first_.push_back(first);
    volume6_.push_back(volume6);
  }

  /// Of the other shells, around a vertex of this one.
  [[nodiscard]] int winding(const FaceTree& tree, std::uint32_t shell) const {
    const LatticeCoord p = mesh_.corner(first_[shell], 0);
    int sum = 0;
    tree.query({p, {p.x, p.y, kEverywhere.max.z}}, [&](FaceId f) {
      if (shell_[f] != shell) sum += crossings(mesh_.corner(f, 0), mesh_.corner(f, 1), mesh_.corner(f, 2), p);
      return true;
    });
    return sum;
  }

  HalfEdgeMesh& mesh_;
  std::vector<std::uint32_t> shell_;  // per face
  std::vector<FaceId> first_;         // per shell
  std::vector<int128> volume6_;       // per shell: positive if it bounds a solid from outside, negative for a cavity
  std::vector<FaceId> stack_;
};

}  // namespace

std::uint64_t erase_inner_shells(HalfEdgeMesh& mesh, bool inwards) {
  return Shells(mesh).erase_inner(inwards);
}

}  // namespace bp
