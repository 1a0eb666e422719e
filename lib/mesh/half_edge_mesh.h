#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "lib/exact/predicates.h"
#include "lib/mesh/box_tree.h"
#include "lib/mesh/lattice_mesh.h"

/// A closed triangle mesh, or the part of one in a cell, whose edges can collapse and flip and whose vertices can move.
/// Half-edge h = 3 f + k of face f runs from corner k to corner k + 1. It takes 24 bytes a face and 29 a vertex
/// (docs/decisions/0002-half-edges.md says why it is not OpenMesh).
namespace bp {

using VertexId = std::uint32_t;
using FaceId = std::uint32_t;
using HalfEdgeId = std::uint32_t;
constexpr std::uint32_t kNoId = ~std::uint32_t(0);

/// A face that would replace old ones.
struct NewFace {
  std::array<VertexId, 3> ids;  ///< counter-clockwise; ids[0] is the apex of a star
  std::array<LatticeCoord, 3> corners;
};

using Triangle = std::array<VertexId, 3>;

class HalfEdgeMesh {
 public:
  /// Differences of coordinates stay below twice this, so that sums of products of two of them fit in 64 bits.
  static constexpr std::int64_t kMaxSpan = std::int64_t(1) << 29;

  /// Throws `failed` if the mesh is not closed, oriented and 2-manifold, or spans kMaxSpan lattice units or more.
  explicit HalfEdgeMesh(const LatticeMesh& mesh) : HalfEdgeMesh(mesh.vertices, mesh.triangles, kEverywhere) {}

  /// Makes the mesh of some faces of a closed surface: all that have a vertex strictly inside of the box `cell`, and
  /// maybe others. A vertex with further faces elsewhere is locked, because its surroundings are unknown. Throws as
  /// above.
  HalfEdgeMesh(std::vector<LatticeCoord> vertices, std::span<const Triangle> triangles, const LatticeBox& cell);

  /// Ids are below it; dead vertices count.
  [[nodiscard]] std::size_t vertex_capacity() const { return position_.size(); }
  [[nodiscard]] std::size_t face_capacity() const { return from_.size() / 3; }
  [[nodiscard]] std::size_t face_count() const { return face_count_; }
  [[nodiscard]] bool alive(FaceId f) const { return from_[HalfEdgeId(3 * f)] != kNoId; }
  [[nodiscard]] bool vertex_alive(VertexId v) const { return out_[v] != kNoId; }

  [[nodiscard]] static HalfEdgeId next(HalfEdgeId h) { return h % 3 == 2 ? h - 2 : h + 1; }
  [[nodiscard]] static HalfEdgeId prev(HalfEdgeId h) { return h % 3 == 0 ? h + 2 : h - 1; }
  [[nodiscard]] static FaceId face(HalfEdgeId h) { return h / 3; }
  [[nodiscard]] HalfEdgeId twin(HalfEdgeId h) const { return twin_[h]; }  ///< kNoId: the edge lies in the rim
  [[nodiscard]] VertexId from(HalfEdgeId h) const { return from_[h]; }
  [[nodiscard]] VertexId to(HalfEdgeId h) const { return from_[next(h)]; }
  [[nodiscard]] VertexId opposite(HalfEdgeId h) const { return from_[prev(h)]; }
  [[nodiscard]] HalfEdgeId edge(HalfEdgeId h) const {
    return h < twin_[h] ? h : twin_[h];
  }  ///< one name for both halves
  [[nodiscard]] HalfEdgeId rotate(HalfEdgeId h) const {
    return twin_[prev(h)];
  }  ///< the next outgoing one, counter-clockwise

  [[nodiscard]] const LatticeBox& cell() const { return cell_; }
  /// Returns the box that new vertices belong strictly inside of. It lies in the cell, and so near to the mesh that
  /// differences of coordinates stay below twice kMaxSpan.
  [[nodiscard]] LatticeBox room() const;
  [[nodiscard]] bool locked(VertexId v) const { return locked_[v] != 0; }
  void lock(VertexId v) { locked_[v] = 1; }

  [[nodiscard]] const LatticeCoord& position(VertexId v) const { return position_[v]; }
  [[nodiscard]] const LatticeCoord& corner(FaceId f, int k) const { return position_[from_[3 * f + std::uint32_t(k)]]; }
  void move(VertexId v, const LatticeCoord& p) { position_[v] = p; }

  /// Calls visit(h) for each outgoing half-edge of v, counter-clockwise. v must not be locked.
  template <class Visit>
  void for_each_outgoing(VertexId v, Visit&& visit) const {
    const HalfEdgeId first = out_[v];
    HalfEdgeId h = first;
    do {
      const HalfEdgeId following = rotate(h);
      visit(h);
      h = following;
    } while (h != first);
  }
  [[nodiscard]] int valence(VertexId v) const;
  [[nodiscard]] bool are_joined(VertexId v, VertexId w) const;  ///< by an edge; v must not be locked

  /// Returns six times the enclosed volume, lattice units cubed; exact. For a cell's part it is the volume of the cones
  /// from some fixed point to the faces, so only its changes have a meaning. O(faces).
  [[nodiscard]] int128 volume6() const;

  /// Returns whether the link condition holds: collapsing h leaves a closed 2-manifold of the same genus. False if an
  /// end is locked.
  [[nodiscard]] bool can_collapse(HalfEdgeId h) const;
  /// Merges to(h) into from(h), and moves from(h) to `p`. Needs the link condition. from(h) may be locked if it does
  /// not move.
  void collapse(HalfEdgeId h, const LatticeCoord& p);
  /// Removes a face. Call it for all faces of a connected part.
  void erase(FaceId f);

  /// Returns whether the edge between the two opposite corners does not exist yet. False if one of the four corners is
  /// locked.
  [[nodiscard]] bool can_flip(HalfEdgeId h) const;
  /// Turns the edge inside its two faces; h becomes the new edge. Needs can_flip(h).
  void flip(HalfEdgeId h);

  /// The former state of some faces and vertices.
  struct Undo {
    struct Half {
      HalfEdgeId h;
      VertexId from;
      HalfEdgeId twin;
    };
    struct Vertex {
      VertexId v;
      LatticeCoord position;
      HalfEdgeId out;
    };
    std::vector<Half> halves;
    std::vector<Vertex> vertices;
    std::size_t face_count = 0;
  };
  /// Adds the faces around v, and their vertices. Before a move it is called for the vertex; before a collapse or a
  /// flip for both ends of the edge.
  void save(VertexId v, Undo& undo) const;
  /// Puts back everything that was saved; `face_count` was set at first.
  void restore(const Undo& undo);

  /// Calls visit(v, i) for each live vertex in the order of ids, with i = 0, 1, 2, ... Returns the live faces in the
  /// order of ids, by these i.
  template <class Visit>
  [[nodiscard]] std::vector<Triangle> live_faces(Visit&& visit) const;
  /// Returns the live vertices and faces, in the order of ids.
  [[nodiscard]] LatticeMesh compact(const GridFrame& frame) const;

 private:
  void check_span() const;
  void connect();
  void check_fans();
  void glue(HalfEdgeId a, HalfEdgeId b) {
    if (a != kNoId) twin_[a] = b;
    if (b != kNoId) twin_[b] = a;
  }
  std::vector<LatticeCoord> position_;
  std::vector<HalfEdgeId> out_;  // by vertex, kNoId when dead
  std::vector<VertexId> from_;   // by half-edge, kNoId when dead
  std::vector<HalfEdgeId> twin_;
  std::vector<char> locked_;  // by vertex
  std::size_t face_count_ = 0;
  LatticeBox cell_;
  LatticeCoord origin_{};  // apex of the cones of volume6()
};

template <class Visit>
std::vector<Triangle> HalfEdgeMesh::live_faces(Visit&& visit) const {
  std::vector<VertexId> id(position_.size(), kNoId);
  VertexId n = 0;
  for (VertexId v = 0; v < position_.size(); ++v) {
    if (vertex_alive(v)) visit(v, id[v] = n++);
  }
  std::vector<Triangle> triangles;
  triangles.reserve(face_count_);
  for (FaceId f = 0; f < face_capacity(); ++f) {
    const HalfEdgeId h = 3 * f;
    if (alive(f)) triangles.push_back({id[from_[h]], id[from_[h + 1]], id[from_[h + 2]]});
  }
  return triangles;
}

/// Returns the unit normal at v, by the areas of its faces; zero if they cancel.
[[nodiscard]] Vec3d vertex_normal(const HalfEdgeMesh& mesh, VertexId v);

}  // namespace bp
