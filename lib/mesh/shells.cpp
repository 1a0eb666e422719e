#include "lib/mesh/shells.h"

#include "lib/exact/predicates.h"
#include "lib/mesh/face_tree.h"

namespace bp {

namespace {

/// Returns the crossing of a face by the ray from p towards +z: 1 if the ray leaves the solid there, -1 if it enters, 0
/// if it misses. Edges count half-open, as if p were moved by infinitesimals in x and y, so no ray meets an edge or a
/// corner. p is not on the face.
int crossings(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c, const LatticeCoord& p) {
  const LatticeCoord* corner[4] = {&a, &b, &c, &a};
  int turn = 0;  // winding of the face's shadow around p
  for (int i = 0; i < 3; ++i) {
    const LatticeCoord &s = *corner[i], &e = *corner[i + 1];
    if ((s.y <= p.y) == (e.y <= p.y)) continue;
    const int sense = s.y <= p.y ? 1 : -1;
    if (orient2d(s, e, p, 2) == sense) turn += sense;
  }
  return turn != 0 && orient3d(a, b, c, p) * turn < 0 ? turn : 0;
}

/// The shells of a mesh, numbered in the order of their first faces.
struct Numbered {
  struct Shell {
    FaceId first;
    int128 volume6;  // positive if the shell bounds a solid from outside, negative for a cavity
    bool rim;        // the shell goes on in other cells
  };
  explicit Numbered(const HalfEdgeMesh& mesh) : shell_of(mesh.face_capacity(), kNoId) {
    for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
      if (mesh.alive(f) && shell_of[f] == kNoId) gather(mesh, f);
    }
  }

  std::vector<std::uint32_t> shell_of;  // by face
  std::vector<Shell> shells;

 private:
  void gather(const HalfEdgeMesh& mesh, FaceId first) {
    const auto number = std::uint32_t(shells.size());
    const LatticeCoord origin = mesh.corner(first, 0);
    Shell shell{first, 0, false};
    stack_.assign(1, first);
    shell_of[first] = number;
    while (!stack_.empty()) {
      const FaceId f = stack_.back();
      stack_.pop_back();
      shell.volume6 += orient3d_value(origin, mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2));
      for (HalfEdgeId h = 3 * f; h < 3 * f + 3; ++h) {
        if (mesh.twin(h) == kNoId) {
          shell.rim = true;
          continue;
        }
        const FaceId beside = HalfEdgeMesh::face(mesh.twin(h));
        if (shell_of[beside] != kNoId) continue;
        shell_of[beside] = number;
        stack_.push_back(beside);
      }
    }
    shells.push_back(shell);
  }

  std::vector<FaceId> stack_;
};

template <class Inner>
std::uint64_t erase_faces(HalfEdgeMesh& mesh, const Inner& inner) {
  std::uint64_t erased = 0;
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
    if (!mesh.alive(f) || !inner(f)) continue;
    mesh.erase(f);
    ++erased;
  }
  return erased;
}

/// Returns the winding number of the other shells around a vertex of this one.
int winding(const HalfEdgeMesh& mesh, const FaceTree& tree, const Numbered& numbered, std::uint32_t shell) {
  const LatticeCoord p = mesh.corner(numbered.shells[shell].first, 0);
  int sum = 0;
  tree.query({p, {p.x, p.y, kEverywhere.max.z}}, [&](FaceId f) {
    if (numbered.shell_of[f] != shell) sum += crossings(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2), p);
    return true;
  });
  return sum;
}

}  // namespace

ShellSense::ShellSense(const HalfEdgeMesh& mesh) {
  Numbered numbered(mesh);
  shell_ = std::move(numbered.shell_of);
  for (const Numbered::Shell& s : numbered.shells) shells_.push_back({s.volume6, s.rim, false});
}

bool ShellSense::turns(FaceId f, int128 gain6) const {
  const Shell& shell = shells_[shell_[f]];
  return !shell.rim && (shell.volume6 > 0) != (shell.volume6 + gain6 > 0);
}

void ShellSense::add(FaceId f, int128 gain6) {
  Shell& shell = shells_[shell_[f]];
  shell.turned = shell.turned || turns(f, gain6);
  shell.volume6 += gain6;
}

int128 fan_gain6(const HalfEdgeMesh& mesh, std::span<const FaceId> replaced, const LatticeCoord& apex) {
  int128 sum = 0;
  for (const FaceId f : replaced) sum += orient3d_value(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2), apex);
  return sum;
}

std::uint64_t erase_turned_shells(HalfEdgeMesh& mesh, const ShellSense& sense) {
  return erase_faces(mesh, [&](FaceId f) { return sense.has_turned(f); });
}

std::uint64_t erase_inner_shells(HalfEdgeMesh& mesh, bool inwards, const ShellSense* sense) {
  const std::uint64_t turned = sense == nullptr ? 0 : erase_turned_shells(mesh, *sense);
  const Numbered numbered(mesh);
  const FaceTree tree(mesh);
  std::vector<bool> inner(numbered.shells.size());
  for (std::uint32_t s = 0; s < inner.size(); ++s) {
    // The winding number just around the shell. Within it, it is one more, or one less.
    const int outside = winding(mesh, tree, numbered, s) + (inwards ? 1 : 0);
    inner[s] = outside != (numbered.shells[s].volume6 > 0 ? 0 : 1);
  }
  return turned + erase_faces(mesh, [&](FaceId f) { return bool(inner[numbered.shell_of[f]]); });
}

}  // namespace bp
