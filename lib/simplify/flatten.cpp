#include "lib/simplify/flatten.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

/// Returns the direction of an axis-aligned normal: 0..5 for +x -x +y -y +z -z.
std::uint8_t direction_of(const LatticeCoord& n) {
  for (int axis = 0; axis < 2; ++axis) {
    if (n[axis] != 0) return std::uint8_t(2 * axis + (n[axis] < 0));
  }
  return std::uint8_t(4 + (n.z < 0));
}

/// Returns the component of a x b along a direction: twice the area of the triangle 0 a b if it faces that way.
std::int64_t area_along(std::uint8_t direction, const LatticeCoord& a, const LatticeCoord& b) {
  const int axis = direction / 2, u = (axis + 1) % 3, w = (axis + 2) % 3;
  const std::int64_t area = a[u] * b[w] - a[w] * b[u];
  return direction % 2 == 0 ? area : -area;
}

double squared(const LatticeCoord& d) {
  return double(d.x * d.x + d.y * d.y + d.z * d.z);
}

class Flattener {
 public:
  Flattener(HalfEdgeMesh& mesh, const EdgeLimit& edge_limit)
      : mesh_(mesh),
        edge_limit_(edge_limit),
        direction_(mesh.face_capacity()),
        queue_(mesh.vertex_capacity()),
        queued_(mesh.vertex_capacity(), 1) {
    for (FaceId f = 0; f < mesh.face_capacity(); ++f)
      direction_[f] = direction_of(normal_of(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)));
    std::iota(queue_.begin(), queue_.end(), VertexId(0));
  }

  std::uint64_t run() {
    std::uint64_t collapses = 0;
    while (!queue_.empty()) {  // first come, first served
      for (std::size_t i = 0; i < queue_.size(); ++i) {
        const VertexId v = queue_[i];
        queued_[v] = 0;
        if (mesh_.vertex_alive(v) && !mesh_.locked(v)) collapses += try_vertex(v);
      }
      queue_.swap(later_);
      later_.clear();
    }
    return collapses;
  }

 private:
  /// A half-edge that leaves the vertex that is tested.
  struct Spoke {
    HalfEdgeId edge;
    VertexId to;
    std::uint8_t direction;  // direction of the face to its left
    LatticeCoord end;        // relative to the vertex
  };

  void gather(VertexId v) {
    fan_.clear();
    const LatticeCoord p = mesh_.position(v);
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      const VertexId to = mesh_.to(h);
      fan_.push_back({h, to, direction_[HalfEdgeMesh::face(h)], mesh_.position(to) - p});
    });
  }

  bool try_vertex(VertexId v) {
    gather(v);
    // The spokes along which the direction changes: none inside a flat region, two on a crease.
    std::size_t creases[2] = {};
    int count = 0;
    for (std::size_t i = 0, before = fan_.size() - 1; i < fan_.size(); before = i++) {
      if (fan_[i].direction == fan_[before].direction) continue;
      if (count == 2) return false;
      creases[count++] = i;
    }
    std::size_t best = fan_.size();
    double best_quality = QualityFloor::kFlat;
    const auto consider = [&](std::size_t i) {
      const double quality = quality_after(i, best_quality);
      if (quality > best_quality) {
        best = i;
        best_quality = quality;
      }
    };
    if (count == 0) {
      for (std::size_t i = 0; i < fan_.size(); ++i) consider(i);
    } else {
      const LatticeCoord &a = fan_[creases[0]].end, &b = fan_[creases[1]].end;
      if (a.y * b.z != a.z * b.y || a.z * b.x != a.x * b.z || a.x * b.y != a.y * b.x) return false;
      consider(creases[0]);
      consider(creases[1]);
    }
    if (best == fan_.size() || too_long(v, fan_[best])) return false;
    // The vertex merges into the end, which stays.
    mesh_.collapse(mesh_.twin(fan_[best].edge), mesh_.position(fan_[best].to));
    for (const Spoke& s : fan_) enqueue(s.to);
    return true;
  }

  /// Returns the least quality of the faces around the vertex if it moved to the end of spoke `to`; 0 if that is not
  /// above `enough`, or if a face would flip or vanish.
  [[nodiscard]] double quality_after(std::size_t to, double enough) const {
    const LatticeCoord& p = fan_[to].end;
    double least = 1;
    for (std::size_t i = 0; i < fan_.size(); ++i) {
      const std::size_t after = i + 1 < fan_.size() ? i + 1 : 0;
      if (i == to || after == to) continue;
      const LatticeCoord a = fan_[i].end - p, b = fan_[after].end - p;
      const std::int64_t area = area_along(fan_[i].direction, a, b);
      if (area <= 0) return 0;
      const double quality = kPerTwiceArea * double(area) / (squared(a) + squared(b) + squared(b - a));
      if (quality <= enough) return 0;
      least = std::min(least, quality);
    }
    return least;
  }

  [[nodiscard]] bool too_long(VertexId v, const Spoke& to) const {
    if (!edge_limit_) return false;
    const LatticeCoord p = mesh_.position(v);
    return std::any_of(fan_.begin(), fan_.end(), [&](const Spoke& s) { return !edge_limit_(p + to.end, p + s.end); });
  }

  void enqueue(VertexId v) {
    if (queued_[v]) return;
    queued_[v] = 1;
    later_.push_back(v);
  }

  HalfEdgeMesh& mesh_;
  const EdgeLimit& edge_limit_;
  std::vector<std::uint8_t> direction_;  // per face; merging keeps it
  std::vector<VertexId> queue_, later_;
  std::vector<char> queued_;
  std::vector<Spoke> fan_;  // spokes of the vertex that was tested last
};

}  // namespace

std::uint64_t merge_flat_regions(HalfEdgeMesh& mesh, const EdgeLimit& edge_limit) {
  return Flattener(mesh, edge_limit).run();
}

void merge_flat_regions(Piece& piece, const EdgeLimit& edge_limit) {
  HalfEdgeMesh mesh(std::move(piece.vertices), piece.triangles, piece.cell);
  merge_flat_regions(mesh, edge_limit);
  piece.vertices = {};
  piece.triangles = mesh.live_faces([&](VertexId v, VertexId) { piece.vertices.push_back(mesh.position(v)); });
}

}  // namespace bp
