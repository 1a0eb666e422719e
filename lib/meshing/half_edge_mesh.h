#pragma once
#include <cstdint>
#include <vector>

#include "lib/meshing/lattice_mesh.h"

/// A closed triangle mesh one can collapse edges, flip edges and move vertices of. Half-edge h = 3 f + k of face f runs
/// from corner k to corner k + 1; 28 bytes a face, 36 a vertex (docs/decisions/0002-half-edges.md says why not OpenMesh
/// here).
namespace bp {

using VertexId = std::uint32_t;
using FaceId = std::uint32_t;
using HalfEdgeId = std::uint32_t;
constexpr std::uint32_t kNoId = ~std::uint32_t(0);

class HalfEdgeMesh {
 public:
  /// Throws `failed` if the mesh is not closed, oriented and 2-manifold.
  explicit HalfEdgeMesh(const LatticeMesh& mesh);

  [[nodiscard]] std::size_t vertex_capacity() const { return position_.size(); }  ///< ids below it, dead ones included
  [[nodiscard]] std::size_t face_capacity() const { return from_.size() / 3; }
  [[nodiscard]] std::size_t face_count() const { return face_count_; }
  [[nodiscard]] bool alive(FaceId f) const { return from_[3 * f] != kNoId; }
  [[nodiscard]] bool vertex_alive(VertexId v) const { return out_[v] != kNoId; }

  [[nodiscard]] static HalfEdgeId next(HalfEdgeId h) { return h % 3 == 2 ? h - 2 : h + 1; }
  [[nodiscard]] static HalfEdgeId prev(HalfEdgeId h) { return h % 3 == 0 ? h + 2 : h - 1; }
  [[nodiscard]] static FaceId face(HalfEdgeId h) { return h / 3; }
  [[nodiscard]] HalfEdgeId twin(HalfEdgeId h) const { return twin_[h]; }
  [[nodiscard]] VertexId from(HalfEdgeId h) const { return from_[h]; }
  [[nodiscard]] VertexId to(HalfEdgeId h) const { return from_[next(h)]; }
  [[nodiscard]] VertexId opposite(HalfEdgeId h) const { return from_[prev(h)]; }
  [[nodiscard]] HalfEdgeId edge(HalfEdgeId h) const {
    return h < twin_[h] ? h : twin_[h];
  }  ///< one name for both halves
  [[nodiscard]] HalfEdgeId outgoing(VertexId v) const { return out_[v]; }
  [[nodiscard]] HalfEdgeId rotate(HalfEdgeId h) const {
    return twin_[prev(h)];
  }  ///< next outgoing one, counter-clockwise

  [[nodiscard]] const LatticeCoord& position(VertexId v) const { return position_[v]; }
  [[nodiscard]] const LatticeCoord& corner(FaceId f, int k) const { return position_[from_[3 * f + std::uint32_t(k)]]; }
  void move(VertexId v, const LatticeCoord& p) { position_[v] = p; }

  /// visit(h) for each outgoing half-edge of v, counter-clockwise.
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

  /// The link condition: collapsing h leaves a closed 2-manifold of the same genus.
  [[nodiscard]] bool can_collapse(HalfEdgeId h) const;
  /// Merges to(h) into from(h), which moves to `p`. Needs can_collapse(h).
  void collapse(HalfEdgeId h, const LatticeCoord& p);

  /// The edge between the two opposite corners does not exist yet.
  [[nodiscard]] bool can_flip(HalfEdgeId h) const;
  /// Turns the edge inside its two faces; h becomes the new edge. Needs can_flip(h).
  void flip(HalfEdgeId h);

  /// Live vertices and faces, in id order.
  [[nodiscard]] LatticeMesh compact(const GridFrame& frame) const;

 private:
  void glue(HalfEdgeId a, HalfEdgeId b) {
    twin_[a] = b;
    twin_[b] = a;
  }
  std::vector<LatticeCoord> position_;
  std::vector<HalfEdgeId> out_;  // per vertex, kNoId when dead
  std::vector<VertexId> from_;   // per half-edge, kNoId when dead
  std::vector<HalfEdgeId> twin_;
  std::size_t face_count_ = 0;
};

}  // namespace bp
