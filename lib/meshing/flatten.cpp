#include "lib/meshing/flatten.h"

#include <cmath>
#include <deque>

#include "lib/meshing/guard.h"

namespace bp {

namespace {

/// Direction of an axis-aligned normal: 0..5 for +x -x +y -y +z -z.
int direction_of(const LatticeCoord& n) {
  for (int axis = 0; axis < 3; ++axis) {
    if (n[axis] != 0) return 2 * axis + (n[axis] < 0);
  }
  return -1;
}

class Flattener {
 public:
  explicit Flattener(HalfEdgeMesh& mesh) : mesh_(mesh), queued_(mesh.vertex_capacity(), 1) {
    for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) queue_.push_back(v);
  }

  std::uint64_t run() {
    std::uint64_t collapses = 0;
    while (!queue_.empty()) {
      const VertexId v = queue_.front();
      queue_.pop_front();
      queued_[v] = 0;
      if (mesh_.vertex_alive(v)) collapses += try_vertex(v);
    }
    return collapses;
  }

 private:
  [[nodiscard]] int direction(FaceId f) const {
    return direction_of(normal_of(mesh_.corner(f, 0), mesh_.corner(f, 1), mesh_.corner(f, 2)));
  }

  bool try_vertex(VertexId v) {
    // Edges along which the direction changes: none inside a flat region, two on a crease.
    HalfEdgeId creases[2] = {};
    int count = 0;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      if (direction(HalfEdgeMesh::face(h)) == direction(HalfEdgeMesh::face(mesh_.twin(h)))) return;
      if (count < 2) creases[count] = h;
      ++count;
    });
    HalfEdgeId best = kNoId;
    double best_quality = 0.02;  // slivers make the later steps harder than a vertex more
    const auto consider = [&](HalfEdgeId h) {
      const double quality = quality_after(h);
      if (quality > best_quality && mesh_.can_collapse(mesh_.twin(h))) {
        best = h;
        best_quality = quality;
      }
    };
    if (count == 0) {
      mesh_.for_each_outgoing(v, consider);
    } else if (count == 2) {
      const LatticeCoord a = mesh_.position(mesh_.to(creases[0])) - mesh_.position(v);
      const LatticeCoord b = mesh_.position(mesh_.to(creases[1])) - mesh_.position(v);
      if (a.y * b.z != a.z * b.y || a.z * b.x != a.x * b.z || a.x * b.y != a.y * b.x) return false;
      consider(creases[0]);
      consider(creases[1]);
    }
    if (best == kNoId) return false;
    const VertexId target = mesh_.to(best);
    mesh_.collapse(mesh_.twin(best), mesh_.position(target));  // v merges into target, which stays where it is
    mesh_.for_each_outgoing(target, [&](HalfEdgeId h) { enqueue(mesh_.to(h)); });
    enqueue(target);
    return true;
  }

  /// Least quality of the faces around v if it moved to to(h); 0 if one would flip or vanish.
  [[nodiscard]] double quality_after(HalfEdgeId h) const {
    const VertexId v = mesh_.from(h), target = mesh_.to(h);
    const LatticeCoord p = mesh_.position(target);
    double least = 1;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId g) {
      const VertexId a = mesh_.to(g), b = mesh_.opposite(g);
      if (a == target || b == target || least == 0) return;
      const LatticeCoord pa = mesh_.position(a), pb = mesh_.position(b);
      const LatticeCoord n = normal_of(p, pa, pb);
      if (direction_of(n) != direction(HalfEdgeMesh::face(g))) {
        least = 0;
        return;
      }
      least = std::min(least, triangle_quality(p, pa, pb));
    });
    return least;
  }

  void enqueue(VertexId v) {
    if (queued_[v]) return;
    queued_[v] = 1;
    queue_.push_back(v);
  }

  HalfEdgeMesh& mesh_;
  std::deque<VertexId> queue_;
  std::vector<char> queued_;
};

}  // namespace

std::uint64_t merge_flat_regions(HalfEdgeMesh& mesh) {
  return Flattener(mesh).run();
}

}  // namespace bp
